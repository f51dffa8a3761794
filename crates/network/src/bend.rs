//! Bends: where the centre lines of lanes are so curved that drivers slow down.
//!
//! The points of real maps are some decimetres beside the true line. So a centre line is averaged over an arc before
//! its curvature is measured, with the chains that continue it at both ends. In corners this arc is too long: there
//! the line itself is measured, over the length of a car and its way in half a second.

use crate::chain::{Bend, Chain, ChainIndex};
use crate::geometry::{Point, Polyline, turn};

/// Distance between the samples of a centre line [m].
const STEP: f64 = 1.0;
/// The arc over which a line is averaged takes this time at the limit [s], within these bounds [m]; ours.
const ARC_TIME: f64 = 0.8;
const ARC: [f64; 2] = [10.0, 40.0];
/// A corner turns by at least this angle [rad] within this distance [m], between chords of this length [m]; ours.
const CORNER: f64 = 0.35;
const WITHIN: usize = 10;
const CHORD: usize = 4;
/// Nobody slows for less curvature [1/m], nor for less lateral acceleration [m/s²] at the fastest that anyone drives,
/// as a multiple of the limit; ours.
const LEAST_CURVATURE: f64 = 1.0 / 1000.0;
const LEAST_ACCELERATION: f64 = 1.0;
const FASTEST: f64 = 1.3;
/// A bend turns by at least this angle in all [rad]: less is a crooked line, or a lane that moves aside; ours.
const LEAST_TURN: f64 = 0.15;
/// A part of a bend that goes on in the next chain turns by at least this angle [rad]; ours.
const LEAST_PART: f64 = 0.5 * LEAST_TURN;
/// Samples of one bend differ by no more than this factor.
const SAME: f64 = 1.25;

/// A line is prolonged by no more chains than this at either end.
const MOST_CHAINS: usize = 16;
/// Drivers look no further for bends and lower limits on the chains beyond their own [m]; ours.
const SIGHT: f64 = 1000.0;

/// Notes for each chain its bends, and how far beyond it the next place is that drivers slow for.
pub(crate) fn note_slow_places(chains: &mut [Chain]) {
    let bends: Vec<Vec<Bend>> = chains.iter().map(|it| bends_of(chains, it)).collect();
    for (chain, bends) in chains.iter_mut().zip(bends) {
        chain.has_slow_places =
            !bends.is_empty() || chain.limits.windows(2).any(|it| it[1].speed < it[0].speed);
        chain.bends = bends;
    }
    let mut changes = true;
    while changes {
        changes = false;
        for index in 0..chains.len() {
            let chain = &chains[index];
            let beyond = chain.following.iter().map(|it| slow_from(chain, &chains[it.at()]));
            let nearest = beyond.fold(f64::INFINITY, f64::min);
            if nearest < SIGHT && nearest < chain.slow_beyond {
                chains[index].slow_beyond = nearest;
                changes = true;
            }
        }
    }
}

/// From the end of `chain` to the first slow place on `next` or beyond it [m].
fn slow_from(chain: &Chain, next: &Chain) -> f64 {
    if chain.limits.last().is_some_and(|it| next.limits[0].speed < it.speed) {
        return 0.0;
    }
    let bend = next.bends.first().map_or(f64::INFINITY, |it| it.start);
    let lower = next.limits.windows(2).find(|it| it[1].speed < it[0].speed);
    let lower = lower.map_or(f64::INFINITY, |it| it[1].start);
    bend.min(lower).min(next.length + next.slow_beyond)
}

fn bends_of(chains: &[Chain], chain: &Chain) -> Vec<Bend> {
    let fastest_limit = chain.limits.iter().map(|it| it.speed).fold(0.0, f64::max);
    let fastest = FASTEST * fastest_limit;
    let least = LEAST_CURVATURE.max(LEAST_ACCELERATION / (fastest * fastest));
    let half_arc = 0.5 * (ARC_TIME * fastest_limit).clamp(ARC[0], ARC[1]);
    let reach = 2.0 * half_arc;
    let (line, before) = prolonged(chains, chain, reach);
    // A line that turns less than that in all has no bend.
    if turn_of(&line) < LEAST_PART {
        return Vec::new();
    }
    let around = (half_arc / STEP).ceil() as usize;
    let line = sampled(&line, before, chain.length, 2 * around);
    let long = curvatures(&averaged(&line, around), around);
    let corners = line[2 * around - (WITHIN + CHORD) / 2..].windows(WITHIN + CHORD + 1).map(in_corner);
    let tighter = |(long, corner): (f64, f64)| if corner.abs() > long.abs() { corner } else { long };
    let curvatures: Vec<f64> = long.into_iter().zip(corners).map(tighter).collect();
    let mut bends = Vec::new();
    let mut from = 0;
    // Runs of samples that are curved in one direction.
    for run in curvatures.chunk_by(|a, b| side(*a, least) == side(*b, least)) {
        let turn: f64 = run.iter().sum::<f64>().abs() * STEP;
        // A bend may go on in the next chain.
        let is_whole = from > 0 && from + run.len() < curvatures.len();
        if side(run[0], least) != 0 && turn >= if is_whole { LEAST_TURN } else { LEAST_PART } {
            add(&mut bends, run, from, chain.length);
        }
        from += run.len();
    }
    bends
}

/// In which direction a line of this curvature bends, if at least by `least`.
fn side(curvature: f64, least: f64) -> i8 {
    if curvature.abs() < least { 0 } else { curvature.signum() as i8 }
}

/// Adds the bends of a `run` of samples, the first of which is number `from` of a chain of this `length` [m].
fn add(bends: &mut Vec<Bend>, run: &[f64], from: usize, length: f64) {
    let mut open: Option<([f64; 2], Bend)> = None;
    for (number, curvature) in run.iter().map(|it| it.abs()).enumerate() {
        let station = (from + number) as f64 * STEP;
        let end = (station + STEP).min(length);
        match &mut open {
            Some((range, bend)) if range[1].max(curvature) <= SAME * range[0].min(curvature) => {
                *range = [range[0].min(curvature), range[1].max(curvature)];
                *bend = Bend { end, curvature: range[1], ..*bend };
            }
            _ => {
                bends.extend(open.map(|it| it.1));
                open = Some(([curvature; 2], Bend { start: station, end, curvature }));
            }
        }
    }
    bends.extend(open.map(|it| it.1));
}

/// The centre line of `chain`, with `reach` [m] of those before and beyond that continue it most straightly, and the
/// length before the chain's own start [m].
fn prolonged(chains: &[Chain], chain: &Chain, reach: f64) -> (Polyline, f64) {
    let (mut before, mut length) = (vec![], 0.0);
    let mut at = chain;
    while length < reach
        && before.len() < MOST_CHAINS
        && let Some(back) = straightest(chains, &at.previous, |it| turn_between(it, at))
    {
        length += back.length;
        before.push(back);
        at = back;
    }
    let mut all: Vec<&Chain> = before.into_iter().rev().collect();
    all.push(chain);
    let (mut beyond, mut at) = (0.0, chain);
    while beyond < reach
        && all.len() < 2 * MOST_CHAINS
        && let Some(next) = straightest(chains, &at.following, |it| turn_between(at, it))
    {
        beyond += next.length;
        all.push(next);
        at = next;
    }
    let mut line = all[0].centre.clone();
    all[1..].iter().for_each(|it| line.append(&it.centre));
    (line, length)
}

/// The chain of `among` with the least angle.
fn straightest<'a>(
    chains: &'a [Chain],
    among: &[ChainIndex],
    angle: impl Fn(&Chain) -> f64,
) -> Option<&'a Chain> {
    among.iter().map(|it| &chains[it.at()]).min_by(|a, b| angle(a).total_cmp(&angle(b)))
}

/// The angle between the end of `one` and the beginning of `next` [rad].
fn turn_between(one: &Chain, next: &Chain) -> f64 {
    turn(one.centre.heading(one.length), next.centre.heading(0.0)).abs()
}

/// Points of `line` every [`STEP`] along a chain of this `length`, and this number `more` at both ends. The chain
/// starts at `before` on it [m].
fn sampled(line: &Polyline, before: f64, length: f64, more: usize) -> Vec<Point> {
    let count = (length / STEP).ceil() as usize + 1 + 2 * more;
    let first = before - more as f64 * STEP;
    (0..count).map(|number| line.at(first + number as f64 * STEP)).collect()
}

/// The means of each of `points` with this number `around` it on either side.
fn averaged(points: &[Point], around: usize) -> Vec<Point> {
    let mut sums = Vec::with_capacity(points.len() + 1);
    sums.push((0.0, 0.0));
    // Sums of distances from the first point, so that they keep their precision.
    let (mut x, mut y) = (0.0, 0.0);
    for point in points {
        (x, y) = (x + (point.x - points[0].x), y + (point.y - points[0].y));
        sums.push((x, y));
    }
    let width = 2 * around + 1;
    let means = sums.windows(width + 1);
    let mean = |from: f64, to: f64| (to - from) / width as f64;
    means.map(|it| Point::new(mean(it[0].0, it[width].0), mean(it[0].1, it[width].1), 0.0)).collect()
}

/// The angle from the direction between the first two points to that between the last two [rad], to the left positive.
fn angle([from, at]: [&Point; 2], [back, to]: [&Point; 2]) -> f64 {
    let ((ax, ay), (bx, by)) = ((at.x - from.x, at.y - from.y), (to.x - back.x, to.y - back.y));
    (ax * by - ay * bx).atan2(ax * bx + ay * by)
}

/// By how much a line turns in all, to the left and to the right [rad].
fn turn_of(line: &Polyline) -> f64 {
    line.points().windows(3).map(|it| angle([&it[0], &it[1]], [&it[1], &it[2]]).abs()).sum()
}

/// Curvatures between the chords to the points this number `around` each [1/m], to the left positive. Along the way,
/// and not along an averaged line: this cuts corners.
fn curvatures(points: &[Point], around: usize) -> Vec<f64> {
    let way = around as f64 * STEP;
    let curvature = |it: &[Point]| angle([&it[0], &it[around]], [&it[around], &it[2 * around]]) / way;
    points.windows(2 * around + 1).map(curvature).collect()
}

/// The curvature in the middle of points every [`STEP`] between the chords at both ends of them [1/m], to the left
/// positive; 0 outside corners.
fn in_corner(points: &[Point]) -> f64 {
    let turn = angle([&points[0], &points[CHORD]], [&points[WITHIN], &points[WITHIN + CHORD]]);
    if turn.abs() >= CORNER { turn / (WITHIN as f64 * STEP) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanelet::{DrivingSide, Lanelet, LaneletIndex};
    use crate::network::Network;

    /// The network of one chain for each of `lines`, one after the other, under `limit` [m/s]. A lane from aside
    /// merges where the next line begins, so that it is another chain.
    fn network(lines: &[Vec<Point>], limit: f64) -> Network {
        let line = |points: &[Point]| Polyline::new(points.iter().copied()).unwrap();
        let mut all: Vec<Lanelet> = Vec::new();
        for (number, points) in lines.iter().enumerate() {
            let centre = line(points);
            all.push(Lanelet::alone(number as i64, [centre.clone(), centre.clone(), centre], limit));
        }
        let count = lines.len();
        for number in 1..count {
            let start = lines[number][0];
            let aside = line(&[Point::new(start.x, start.y - 50.0, 0.0), start]);
            let mut lane = Lanelet::alone(100 + number as i64, [aside.clone(), aside.clone(), aside], limit);
            lane.following = vec![LaneletIndex(number as u32)];
            all.push(lane);
            all[number - 1].following = vec![LaneletIndex(number as u32)];
        }
        Network::new(all, DrivingSide::Right).unwrap()
    }

    /// Points from `from` to `to` [m] along a line that is straight for 100 m, turns left by 90° with `radius`, and is
    /// straight again.
    fn turning(radius: f64, [from, to]: [f64; 2]) -> Vec<Point> {
        let arc = radius * std::f64::consts::FRAC_PI_2;
        let count = ((to - from) / 2.0).ceil() as usize;
        let at = |s: f64| match s - 100.0 {
            way if way < 0.0 => Point::new(s, 0.0, 0.0),
            way if way < arc => {
                let (sin, cos) = (way / radius).sin_cos();
                Point::new(100.0 + radius * sin, radius * (1.0 - cos), 0.0)
            }
            way => Point::new(100.0 + radius, radius + way - arc, 0.0),
        };
        (0..=count).map(|it| at(from + (to - from) * it as f64 / count as f64)).collect()
    }

    #[test]
    fn a_bend_is_found_where_it_is_with_its_radius() {
        for radius in [25.0, 50.0, 100.0] {
            let network = network(&[turning(radius, [0.0, 400.0])], 50.0 / 3.6);
            let bends = &network.chains[0].bends;
            let tightest = bends.iter().map(|it| it.curvature).fold(0.0, f64::max);
            assert!((0.9..1.02).contains(&(radius * tightest)), "{radius}: {}", 1.0 / tightest);
            let arc = radius * std::f64::consts::FRAC_PI_2;
            let tight = bends.iter().filter(|it| it.curvature > 0.7 / radius);
            let (start, end) = tight.fold((f64::MAX, 0.0_f64), |it, b| (it.0.min(b.start), it.1.max(b.end)));
            assert!(
                (start - 100.0).abs() < 6.0 && (end - 100.0 - arc).abs() < 6.0,
                "{radius}: {start} {end}"
            );
        }
    }

    #[test]
    fn a_corner_is_as_tight_as_the_line_turns_within_ten_metres() {
        /// A line that turns left by this angle, in so many equal kinks within so many metres.
        fn corner(angle: f64, kinks: u32, within: f64) -> Vec<Point> {
            let piece = within / f64::from(kinks.max(2) - 1);
            let mut at = Point::new(60.0, 0.0, 0.0);
            let mut points = vec![Point::new(0.0, 0.0, 0.0), at];
            for kink in 1..=kinks {
                let (sin, cos) = (angle * f64::from(kink) / f64::from(kinks)).sin_cos();
                let way = if kink == kinks { 60.0 } else { piece };
                at = Point::new(at.x + way * cos, at.y + way * sin, 0.0);
                points.push(at);
            }
            points
        }
        for limit in [30.0, 50.0, 100.0] {
            for (degrees, kinks, within) in
                [(90.0_f64, 1, 0.0), (90.0, 4, 4.0), (60.0, 1, 0.0), (120.0, 6, 6.0)]
            {
                let angle = degrees.to_radians();
                let network = network(&[corner(angle, kinks, within)], limit / 3.6);
                let bends = &network.chains[0].bends;
                let tightest = bends.iter().max_by(|a, b| a.curvature.total_cmp(&b.curvature)).unwrap();
                let turn = 10.0 * tightest.curvature;
                assert!((0.93..1.1).contains(&(turn / angle)), "{limit} {degrees} {kinks}: {turn}");
                let middle = 60.0 + 0.5 * within;
                assert!(tightest.start < middle && middle < tightest.end, "{limit} {degrees}: {tightest:?}");
            }
        }
    }

    #[test]
    fn a_bend_over_several_chains_is_as_tight_as_in_one() {
        let pieces = [[0.0, 110.0], [110.0, 122.0], [122.0, 130.0], [130.0, 300.0]];
        let network = network(&pieces.map(|it| turning(20.0, it)), 50.0 / 3.6);
        let tightest =
            |chain: usize| network.chains[chain].bends.iter().map(|it| it.curvature).fold(0.0, f64::max);
        assert!((0.85..1.05).contains(&(20.0 * tightest(1))), "{}", tightest(1));
        assert!(tightest(0) > 0.0 && tightest(2) > 0.0);
        assert!(network.chains[0].has_slow_places);
    }

    #[test]
    fn a_crooked_straight_line_and_a_motorway_have_no_bends() {
        let crooked = |aside: f64| -> Vec<Point> {
            let y = |it: usize| aside * [0.0, 1.0, -0.4, 0.7, -1.0, 0.2][it % 6];
            (0..100).map(|it| Point::new(5.0 * it as f64, y(it), 0.0)).collect()
        };
        for limit in [30.0, 50.0, 100.0, 130.0] {
            assert_eq!(network(&[crooked(0.15)], limit / 3.6).chains[0].bends, [], "{limit}");
        }
        let wide = network(&[turning(1200.0, [0.0, 3000.0])], 120.0 / 3.6);
        assert_eq!(wide.chains[0].bends, []);
        assert!(!wide.chains[0].has_slow_places && wide.chains[0].slow_beyond == f64::INFINITY);
    }

    #[test]
    fn a_chain_knows_how_far_beyond_it_the_next_bend_is() {
        let network =
            network(&[[0.0, 20.0], [20.0, 80.0], [80.0, 300.0]].map(|it| turning(20.0, it)), 50.0 / 3.6);
        let bend = network.chains[2].bends[0].start;
        // The arc begins at 20 m; an averaged line is curved half an arc before.
        assert!((9.0..20.0).contains(&bend), "{bend}");
        assert_eq!(network.chains[1].slow_beyond, bend);
        assert_eq!(network.chains[0].slow_beyond, 60.0 + bend);
    }
}
