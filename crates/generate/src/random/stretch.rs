//! Stretches: lanes along a path between lines that may converge or diverge.

use laneweave_maps::drawing::{Crossing, Edge, KMH_PER_MPS, Surroundings};
use laneweave_network::{Id, Pose};

use super::dice::Dice;
use super::mouth::{Knot, Mouth, Span};
use crate::canvas::Canvas;
use crate::path::Path;

/// Distance between the points of lines that converge [m]. Ours.
const STEP: f64 = 8.0;
/// Their minimum number.
const STEPS: f64 = 8.0;
/// Minimum distance between points along the road [m]. Ours.
const APART: f64 = 0.4;
/// Lines that end nearer to each other end at one point [m].
const SAME: f64 = 1e-6;
/// Maximum lateral acceleration at the limit, on bends that are not meant to be difficult [m/s²]. Ours.
const SIDEWAYS: f64 = 3.5;
/// Limits of bends that are not meant to be difficult [km/h].
const LIMITS: [f64; 4] = [100.0, 70.0, 50.0, 30.0];

/// The state of a drawing.
#[derive(Clone)]
pub(super) struct Pen {
    pub(super) canvas: Canvas,
    pub(super) dice: Dice,
    /// Length of road so far [m].
    pub(super) length: f64,
}

/// The form of a line from its offset at the start to the one at the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ease {
    /// The share of the length to this power; 1 is a straight line.
    Power(f64),
    /// Parallel to the road at both ends.
    Smooth,
}

/// A line between lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) from: Knot,
    /// Offset of its end to the left of the path [m].
    pub(super) to: f64,
    pub(super) ease: Ease,
    pub(super) crossing: Crossing,
}

/// Lanes along a path.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) path: Path,
    pub(super) lines: Vec<Line>,
    pub(super) spans: Vec<Span>,
    /// Where lanelets are cut between the ends of the path [m].
    pub(super) cuts: Vec<f64>,
    pub(super) limit_kmh: f64,
    /// Whether lanes have borders of their own where they could share one.
    pub(super) is_doubled: bool,
}

impl Line {
    fn offset(&self, share: f64) -> f64 {
        let share = match self.ease {
            Ease::Power(power) => libm::pow(share, power),
            Ease::Smooth => share * share * (3.0 - 2.0 * share),
        };
        self.from.offset + (self.to - self.from.offset) * share
    }
}

impl Stretch {
    /// The road with the cross-section of its mouth, with dashed lines between lanes of one direction.
    pub(super) fn onward(mouth: &Mouth, path: Path) -> Stretch {
        let spans = &mouth.spans;
        let divides = |line: usize| {
            let has = |side: fn(&Span) -> usize| spans.iter().any(|it| side(it) == line);
            has(|it| it.left) && has(|it| it.right)
        };
        let line = |(number, from): (usize, &Knot)| Line {
            from: *from,
            to: from.offset,
            ease: Ease::Smooth,
            crossing: if divides(number) { Crossing::BOTH_WAYS } else { Crossing::NEVER },
        };
        let lines = mouth.knots.iter().enumerate().map(line).collect();
        let limit_kmh = mouth.limit_kmh;
        Stretch { path, lines, spans: mouth.spans.clone(), cuts: Vec::new(), limit_kmh, is_doubled: false }
    }

    /// The same, with lines that no vehicle may cross.
    pub(super) fn solid(mut self) -> Stretch {
        self.lines.iter_mut().for_each(|it| it.crossing = Crossing::NEVER);
        self
    }

    /// The same, its lines ending at these offsets [m].
    pub(super) fn to(mut self, offsets: &[f64], ease: Ease) -> Stretch {
        for (line, offset) in self.lines.iter_mut().zip(offsets) {
            (line.to, line.ease) = (*offset, ease);
        }
        self
    }

    /// Stations at which lines have points between their ends.
    fn stations(&self) -> Vec<f64> {
        let length = self.path.length();
        let mut stations = self.path.bends();
        if self.lines.iter().any(|it| it.to != it.from.offset) {
            let steps = (length / STEP).max(STEPS).ceil();
            stations.extend((1..steps as usize).map(|it| length * it as f64 / steps));
        }
        stations.sort_by(f64::total_cmp);
        stations.dedup_by(|after, before| *after - *before < APART);
        let fixed = || self.cuts.iter().chain([&0.0, &length]);
        stations.retain(|it| fixed().all(|fixed| (it - fixed).abs() > APART));
        stations
    }
}

/// The greatest usual limit that fits a bend of this radius [km/h, m].
pub(super) fn limit_of_bend(radius: f64) -> f64 {
    let speed = (SIDEWAYS * radius).sqrt() * KMH_PER_MPS;
    LIMITS.into_iter().find(|it| *it <= speed).unwrap_or(LIMITS[3])
}

impl Pen {
    /// Draws a stretch, and returns its end; lanes that have no width there end.
    pub(super) fn draw(&mut self, stretch: &Stretch) -> Mouth {
        let length = stretch.path.length();
        self.length += length;
        let stations = stretch.stations();
        let mut row: Vec<u32> = stretch.lines.iter().map(|it| it.from.point).collect();
        let mut lanelets = Vec::new();
        let mut from = 0.0;
        for to in stretch.cuts.iter().copied().chain([length]) {
            let next = self.row(stretch, to);
            let between: Vec<f64> = stations.iter().copied().filter(|it| (from..to).contains(it)).collect();
            lanelets = self.piece(stretch, [&row, &next], &between);
            (row, from) = (next, to);
        }
        let knots =
            row.iter().zip(&stretch.lines).map(|(point, line)| Knot { point: *point, offset: line.to });
        let pose: Pose = stretch.path.pose(length);
        let (knots, spans) = (knots.collect(), stretch.spans.clone());
        let mouth = Mouth { pose, knots, spans, lanelets, limit_kmh: stretch.limit_kmh };
        mouth.only(0..mouth.lanes())
    }

    /// The points of all lines at a station; lines that meet there have one point.
    fn row(&mut self, stretch: &Stretch, station: f64) -> Vec<u32> {
        let share = station / stretch.path.length();
        let mut row: Vec<(f64, u32)> = Vec::new();
        for line in &stretch.lines {
            let offset = line.offset(share);
            let known = row.iter().find(|it| (it.0 - offset).abs() < SAME).map(|it| it.1);
            let point = known.unwrap_or_else(|| self.canvas.point(stretch.path.beside(station, offset)));
            row.push((offset, point));
        }
        row.into_iter().map(|it| it.1).collect()
    }

    /// Draws the lanelets between two rows of points, and returns them.
    fn piece(&mut self, stretch: &Stretch, [begin, end]: [&[u32]; 2], between: &[f64]) -> Vec<Id> {
        let mut borders: Vec<u32> = Vec::new();
        for (number, line) in stretch.lines.iter().enumerate() {
            let mut before = stretch.lines[..number].iter();
            let known = before.position(|it| it == line && !stretch.is_doubled);
            let border = known.map(|it| borders[it]).unwrap_or_else(|| {
                let mut points = vec![begin[number]];
                let shares = between.iter().map(|it| (it, it / stretch.path.length()));
                let places = shares.map(|(it, share)| stretch.path.beside(*it, line.offset(share)));
                points.extend(places.map(|it| self.canvas.point(it)));
                points.push(end[number]);
                self.canvas.line(points, line.crossing)
            });
            borders.push(border);
        }
        let lane = |span: &Span| {
            let [left, right] =
                [span.left, span.right].map(|it| Edge { border: borders[it], reversed: !span.ahead });
            let edges = if span.ahead { [left, right] } else { [right, left] };
            self.canvas.lane(edges, Surroundings::Country, stretch.limit_kmh)
        };
        stretch.spans.iter().map(lane).collect()
    }

    /// Draws the road with the cross-section of its mouth along a path.
    pub(super) fn go_on(&mut self, mouth: &Mouth, path: Path) -> Mouth {
        self.draw(&Stretch::onward(mouth, path))
    }

    /// Draws the road straight on for a random length in this range [m].
    pub(super) fn straight(&mut self, mouth: &Mouth, [from, to]: [f64; 2]) -> Mouth {
        let length = self.dice.between(from, to);
        self.go_on(mouth, Path::straight(mouth.pose, length))
    }

    /// A straight path from a cross-section, or a bend that can be driven at its limit.
    pub(super) fn gentle(&mut self, mouth: &Mouth, length: f64) -> Path {
        if self.dice.chance(0.5) {
            return Path::straight(mouth.pose, length);
        }
        let speed = mouth.limit_kmh / KMH_PER_MPS;
        let fits = (speed * speed / SIDEWAYS + mouth.breadth()).max(1.5 * length);
        let radius = fits * self.dice.between(1.0, 3.0) * self.dice.sign();
        Path::arc(mouth.pose, radius, length / radius)
    }

    /// The form of a taper: linear, or a curve.
    pub(super) fn taper(&mut self) -> Ease {
        Ease::Power(if self.dice.chance(0.5) { 1.0 } else { self.dice.between(0.7, 2.0) })
    }
}
