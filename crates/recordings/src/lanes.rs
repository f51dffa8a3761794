//! Lanelets near a point, by a grid over their centre lines.

use std::collections::HashMap;

use laneweave_network::{Lanelet, LaneletIndex, Point};

/// Size of a cell [m]. The search covers the neighbouring cells, so that lanes may be up to twice as wide.
const CELL: f64 = 10.0;

/// The position of a point relative to a lanelet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Along the centre line [m], not beyond its ends.
    pub station: f64,
    /// Distance to the left of the centre line, which is prolonged at its ends [m].
    pub offset: f64,
    /// Beyond its ends [m].
    pub beyond: f64,
}

/// The segments of all centre lines in a grid.
pub(crate) struct Lanes<'a> {
    lanelets: &'a [Lanelet],
    cells: HashMap<(i64, i64), Vec<(LaneletIndex, Segment)>>,
}

/// A segment of a centre line.
#[derive(Clone, Copy, PartialEq)]
struct Segment {
    /// Index of its first point in the centre line.
    number: u32,
    /// Station of its beginning along the centre line [m].
    start: f64,
}

impl<'a> Lanes<'a> {
    pub(crate) fn new(lanelets: &'a [Lanelet]) -> Lanes<'a> {
        let mut cells: HashMap<(i64, i64), Vec<(LaneletIndex, Segment)>> = HashMap::new();
        for (index, lanelet) in lanelets.iter().enumerate() {
            for (segment, from, to) in segments(lanelet) {
                let entry = (LaneletIndex(index as u32), segment);
                let pieces = (2.0 * from.distance(to) / CELL).ceil() as usize;
                for piece in 0..=pieces {
                    let (column, row) = cell(&from.towards(to, piece as f64 / pieces as f64));
                    for near in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy))) {
                        let listed = cells.entry(near).or_default();
                        if listed.last() != Some(&entry) {
                            listed.push(entry);
                        }
                    }
                }
            }
        }
        Lanes { lanelets, cells }
    }

    /// The lanelets around `point`, at most a cell away, and its position relative to them.
    pub(crate) fn around(&self, point: &Point) -> impl Iterator<Item = (LaneletIndex, Foot)> {
        let listed = self.cells.get(&cell(point)).map_or(&[][..], |it| it);
        listed.chunk_by(|a, b| a.0 == b.0).filter_map(|entries| {
            let of = entries.first()?.0;
            Some((of, nearest(&self.lanelets[of.at()], entries.iter().map(|it| it.1), point)?))
        })
    }
}

/// The position of `point` relative to `lanelet`.
pub fn foot(lanelet: &Lanelet, point: &Point) -> Option<Foot> {
    nearest(lanelet, segments(lanelet).map(|(segment, ..)| segment), point)
}

fn cell(point: &Point) -> (i64, i64) {
    ((point.x / CELL).floor() as i64, (point.y / CELL).floor() as i64)
}

fn segments(lanelet: &Lanelet) -> impl Iterator<Item = (Segment, &Point, &Point)> {
    let mut start = 0.0;
    lanelet.centre.points().windows(2).zip(0..).map(move |(pair, number)| {
        let segment = Segment { number, start };
        start += pair[0].distance(&pair[1]);
        (segment, &pair[0], &pair[1])
    })
}

/// The foot of `point` on the nearest of `segments`.
fn nearest(lanelet: &Lanelet, segments: impl Iterator<Item = Segment>, point: &Point) -> Option<Foot> {
    let points = lanelet.centre.points();
    let mut best: Option<(f64, Foot)> = None;
    for segment in segments {
        let at = segment.number as usize;
        let (from, to) = (&points[at], &points[at + 1]);
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let (px, py) = (point.x - from.x, point.y - from.y);
        let length = (dx * dx + dy * dy).sqrt();
        let along = (px * dx + py * dy) / length;
        let aside = (dx * py - dy * px) / length;
        let on = along.clamp(0.0, length);
        let past = along - on;
        let distance = (aside * aside + past * past).sqrt();
        if best.is_none_or(|(least, _)| distance < least) {
            let is_end = (past < 0.0 && at == 0) || (past > 0.0 && at + 2 == points.len());
            let foot = Foot {
                station: segment.start + on,
                offset: if is_end { aside } else { distance.copysign(aside) },
                beyond: if is_end { past.abs() } else { 0.0 },
            };
            best = Some((distance, foot));
        }
    }
    best.map(|(_, foot)| foot)
}

#[cfg(test)]
mod tests {
    use laneweave_network::Polyline;

    use super::*;

    /// A lanelet 4 m wide around a corner: 100 m to the east, then 50 m to the north.
    fn corner() -> Lanelet {
        let line = |aside: f64| {
            let points = [(0.0, -aside), (100.0 + aside, -aside), (100.0 + aside, 50.0)];
            Polyline::new(points.map(|(x, y)| Point::new(x, y, 0.0))).unwrap()
        };
        Lanelet::alone(1, [line(-2.0), line(2.0), line(0.0)], 20.0)
    }

    #[test]
    fn a_foot_has_a_station_and_a_signed_offset() {
        let lanelet = corner();
        let at = |x: f64, y: f64| {
            let found = foot(&lanelet, &Point::new(x, y, 0.0)).unwrap();
            (found.station, found.offset, found.beyond)
        };
        assert_eq!(at(30.0, 1.5), (30.0, 1.5, 0.0));
        assert_eq!(at(101.0, 20.0), (120.0, -1.0, 0.0));
        // Outside of the corner the distance counts, beyond the ends the lane is prolonged.
        assert_eq!(at(103.0, -4.0), (100.0, -5.0, 0.0));
        assert_eq!(at(-3.0, 4.0), (0.0, 4.0, 3.0));
        assert_eq!(at(99.0, 52.0), (150.0, 1.0, 2.0));
    }

    #[test]
    fn the_grid_finds_the_same_foot_near_a_lanelet_and_nothing_far_off() {
        let lanelets = [corner()];
        let lanes = Lanes::new(&lanelets);
        for i in 0..40 {
            for j in 0..40 {
                let point = Point::new(4.0 * i as f64 - 20.0, 3.0 * j as f64 - 30.0, 0.0);
                let found: Vec<_> = lanes.around(&point).map(|(_, it)| it).collect();
                let expected = foot(&lanelets[0], &point).unwrap();
                let distance = expected.offset.hypot(expected.beyond);
                assert!(distance > CELL || found == [expected], "{point:?}: {found:?} {expected:?}");
                assert!(distance < 3.0 * CELL || found.is_empty(), "{point:?}: {found:?}");
            }
        }
    }
}
