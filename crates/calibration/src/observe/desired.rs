//! The desired speed of a recorded driver, as far as its speeds show it.
//!
//! Desired speeds are a factor on what the limit and the class allow, lognormal over the drivers. A driver who drives
//! freely shows its own: the one with which its car-following model would accelerate as it does. Any other shows that
//! it wants no less than it drives (a censored observation). The two numbers of the distribution come from all drivers
//! of the recording (EM).

use laneweave_models::change::Driver;
use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_recorded::Replay;
use laneweave_recordings::Matched;
use laneweave_sim::{Spot, driver_of};
use rayon::prelude::*;

use super::in_view::InView;
use crate::waiting::MOST_NODES;

/// Possible desired speeds of each driver.
pub const NODES: usize = MOST_NODES;

/// What is known of the desired speed of a driver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DesiredSpeed {
    /// Possible factors on the allowed speed, with their chances.
    pub nodes: Vec<(f64, f64)>,
    /// Whether the driver was seen driving freely.
    pub is_shown: bool,
}

impl DesiredSpeed {
    /// The expected factor.
    pub fn mean(&self) -> f64 {
        self.nodes.iter().map(|(factor, chance)| factor * chance).sum()
    }
}

/// A driver with a longer time gap, or with nobody ahead, drives freely [s].
pub(crate) const FREE: f64 = 4.0;
/// A driver that accelerates or brakes more has not its desired speed [m/s²].
const STEADY: f64 = 0.3;
/// A driver's speeds are alike for this time [s]: it gives as many independent looks (ours).
const ALIKE: f64 = 10.0;
/// Smallest standard deviation of what free speeds show, and the one of a single look (logarithms; ours).
const LEAST_ERROR: f64 = 0.005;
const USUAL_ERROR: f64 = 0.03;
/// The distribution of a recording without any free driver, and with how many drivers' weight it counts (ours).
const USUAL: (f64, f64) = (0.0, 0.12);
const USUAL_WEIGHT: f64 = 4.0;
/// The standard deviation of that distribution, and that weight.
pub(crate) const USUAL_LOGS: (f64, f64) = (USUAL.1, USUAL_WEIGHT);
/// Smallest and largest standard deviation of the logarithms (ours: free speeds of drivers on one road differ by 10 to
/// 15 %). More comes from places, such as bends and limits that the map has wrong.
const LEAST: f64 = 0.02;
const MOST: f64 = 0.25;
/// Points of the grid over ± 4 standard deviations, and steps of the EM algorithm.
const POINTS: usize = 201;
const STEPS: usize = 30;

/// What a track shows of its driver: logarithms of factors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Shown {
    /// The mean while it drove freely, and its standard error.
    free: Option<(f64, f64)>,
    /// The speed that it did not exceed for nine tenths of the time.
    reached: f64,
}

/// The desired speeds of the drivers of all tracks, and their distribution over all drivers: mean and standard
/// deviation of the logarithms of the factors. Drivers who were held up count in it, too: those who drive freely are
/// often the slower ones.
pub(super) fn desired_speeds(matched: &Matched, replay: &Replay) -> (Vec<DesiredSpeed>, [f64; 2]) {
    let speeds = Speeds::of(matched, replay);
    let shown: Vec<Option<Shown>> =
        (0..speeds.tracks.len()).map(|track| speeds.shown(track, i64::MAX)).collect();
    let known: Vec<&Shown> = shown.iter().flatten().collect();
    let distribution = distribution(&known);
    let of = |it: &Option<Shown>| posterior(it.as_ref(), distribution);
    (shown.iter().map(of).collect(), [distribution.0, distribution.1])
}

/// Drivers are looked at so often [s].
const EVERY: f64 = 1.0;

/// What the speeds of all drivers show, look by look.
pub(crate) struct Speeds {
    /// For each track its looks in the order of time.
    tracks: Vec<Vec<SpeedSeen>>,
}

/// What the speed of a driver shows at one time: logarithms of factors.
struct SpeedSeen {
    frame: i64,
    driven: f64,
    /// The desired speed, if it drives freely.
    free: Option<f64>,
}

impl Speeds {
    /// What the drivers of the recording of `matched` show.
    pub(crate) fn of(matched: &Matched, replay: &Replay) -> Speeds {
        let mut tracks: Vec<Vec<SpeedSeen>> = matched.recording.tracks.iter().map(|_| Vec::new()).collect();
        let in_view = InView::of(matched);
        let every = (EVERY / matched.recording.step).round().max(1.0) as i64;
        let frames = matched.recording.frames_by(every);
        let of = |number: &i64| seen_at(matched, replay, &in_view, *number);
        let seen: Vec<Vec<(usize, SpeedSeen)>> = frames.par_iter().map(of).collect();
        seen.into_iter().flatten().for_each(|(track, it)| tracks[track].push(it));
        Speeds { tracks }
    }

    /// What the speeds of a track show up to the frame number `until`.
    pub(crate) fn shown(&self, track: usize, until: i64) -> Option<Shown> {
        let looks = &self.tracks[track];
        let looks = &looks[..looks.partition_point(|it| it.frame <= until)];
        let free: Vec<f64> = looks.iter().filter_map(|it| it.free).collect();
        let mut driven: Vec<f64> = looks.iter().map(|it| it.driven).collect();
        driven.sort_by(f64::total_cmp);
        let reached = *driven.get(driven.len() * 9 / 10)?;
        Some(Shown { free: mean_of(&free), reached })
    }
}

/// What the speeds of all drivers show in one frame, by track.
fn seen_at(matched: &Matched, replay: &Replay, in_view: &InView, number: i64) -> Vec<(usize, SpeedSeen)> {
    let frame = replay.frame(number);
    let scene = frame.scene();
    let of = |spot: Spot| {
        let motion = scene.motion(spot);
        let limit = matched.network.chain(spot.chain).limit(motion.x);
        let allowed = scene.driver(spot).class.allowed(limit, &matched.network.law);
        let factor = motion.speed / allowed;
        if factor.is_nan() || factor <= SLOWEST {
            return None;
        }
        let ahead = scene.ahead(scene.viewpoint(spot));
        let far = FREE * motion.speed;
        // Who has nobody ahead may follow somebody whom the recording does not show.
        let is_free = match ahead {
            Some(it) => it.gap > far,
            None => in_view.shows(spot.chain, motion.x, far),
        };
        let is_shown = is_free && motion.acceleration.abs() < STEADY as f32;
        let desired = || desired_by(&driver_of(&scene, spot), ahead, allowed).map(libm::log);
        let free = if is_shown { desired() } else { None };
        Some((motion.id as usize, SpeedSeen { frame: number, driven: libm::log(factor), free }))
    };
    frame.vehicles().filter_map(|it| frame.spot(it)).filter_map(of).collect()
}

/// The slowest and the fastest that a driver may want, as factors.
const SLOWEST: f64 = 0.1;
const FASTEST: f64 = 3.0;

/// The factor on `allowed` [m/s] with which the car-following model of a driver accelerates as it does. `None` if there
/// is none that would show in its acceleration.
fn desired_by(driver: &Driver, ahead: Option<Ahead>, allowed: f64) -> Option<f64> {
    let excess = |factor: f64| {
        let pace = Pace { desired: factor * allowed, ..driver.pace };
        driver.follow.acceleration(pace, ahead) - driver.acceleration
    };
    let (mut low, mut high) = (SLOWEST, FASTEST);
    if excess(low) > 0.0 || excess(high) < 0.0 {
        return None;
    }
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    // Far below its desired speed a driver accelerates alike, whatever it wants.
    const SHOWS_FROM: f64 = 0.8;
    (driver.pace.speed > SHOWS_FROM * high * allowed).then_some(high)
}

/// The mean of what free seconds show, with its standard error.
fn mean_of(logs: &[f64]) -> Option<(f64, f64)> {
    let count = logs.len() as f64;
    if logs.is_empty() {
        return None;
    }
    let mean = logs.iter().sum::<f64>() / count;
    let looks = (count * EVERY / ALIKE).max(1.0);
    let variance = logs.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / count;
    // Few seconds do not show how much they differ.
    let weight = count / (count + ALIKE);
    let variance = weight * variance + (1.0 - weight) * USUAL_ERROR * USUAL_ERROR;
    Some((mean, (variance / looks + LEAST_ERROR * LEAST_ERROR).sqrt()))
}

/// Mean and standard deviation of the logarithms over all drivers.
pub(crate) fn distribution(known: &[&Shown]) -> (f64, f64) {
    let free: Vec<f64> = known.iter().filter_map(|it| Some(it.free?.0)).collect();
    let mut now = USUAL;
    if !free.is_empty() {
        now.0 = free.iter().sum::<f64>() / free.len() as f64;
    }
    for _ in 0..STEPS {
        let (mut sum, mut squares, mut weight) = (USUAL_WEIGHT * now.0, 0.0, USUAL_WEIGHT);
        for it in known {
            let (mean, square) = moments(it, now);
            (sum, squares, weight) = (sum + mean, squares + square, weight + 1.0);
        }
        let mean = sum / weight;
        squares += USUAL_WEIGHT * (mean * mean + USUAL.1 * USUAL.1);
        now = (mean, (squares / weight - mean * mean).max(0.0).sqrt().clamp(LEAST, MOST));
    }
    now
}

/// Points with their weights, which are not normalised: over ± 4 standard deviations of the distribution, or of what
/// free speeds show of this driver.
fn grid(shown: Option<&Shown>, (mean, deviation): (f64, f64)) -> impl Iterator<Item = (f64, f64)> {
    let shown = shown.copied();
    let square = |off: f64, error: f64| -0.5 * (off / error) * (off / error);
    // Where speeds are known better than the distribution says, the grid is finer.
    let (middle, width) = match shown.and_then(|it| it.free) {
        Some((free, error)) => {
            let precision = 1.0 / (deviation * deviation) + 1.0 / (error * error);
            let mean = (mean / (deviation * deviation) + free / (error * error)) / precision;
            (mean, 1.0 / precision.sqrt())
        }
        None => (mean, deviation),
    };
    (0..POINTS).map(move |it| {
        let log = middle + width * (8.0 * it as f64 / (POINTS - 1) as f64 - 4.0);
        let seen = shown.map_or(0.0, |it| match it.free {
            Some((free, error)) => square(log - free, error),
            None => square((it.reached - log).max(0.0), USUAL_ERROR),
        });
        (log, libm::exp(square(log - mean, deviation) + seen))
    })
}

/// The first two moments of a driver's logarithm.
pub(crate) fn moments(shown: &Shown, distribution: (f64, f64)) -> (f64, f64) {
    let (mut all, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for (log, weight) in grid(Some(shown), distribution) {
        (all, sum, squares) = (all + weight, sum + weight * log, squares + weight * log * log);
    }
    if all > 0.0 {
        return (sum / all, squares / all);
    }
    let log = shown.free.map_or(shown.reached, |it| it.0);
    (log, log * log)
}

/// The possible desired speeds of a driver: the means of parts of equal chance.
fn posterior(shown: Option<&Shown>, distribution: (f64, f64)) -> DesiredSpeed {
    let is_shown = shown.is_some_and(|it| it.free.is_some());
    let all: f64 = grid(shown, distribution).map(|it| it.1).sum();
    if all <= 0.0 || all.is_nan() {
        let log = shown.map_or(distribution.0, |it| it.free.map_or(it.reached, |it| it.0));
        return DesiredSpeed { nodes: vec![(libm::exp(log), 1.0 / NODES as f64); NODES], is_shown };
    }
    let mut parts = [(0.0, 0.0); NODES];
    let mut before = 0.0;
    for (log, weight) in grid(shown, distribution) {
        // A point may lie in several parts.
        let (mut share, mut left) = (before / all * NODES as f64, weight / all * NODES as f64);
        while left > 0.0 {
            let part = (share as usize).min(NODES - 1);
            let here = if part == NODES - 1 { left } else { left.min((part + 1) as f64 - share) };
            parts[part] = (parts[part].0 + here * log, parts[part].1 + here);
            (share, left) = (share + here, left - here);
            if here <= 0.0 {
                break;
            }
        }
        before += weight;
    }
    let node =
        |(sum, weight): (f64, f64)| (libm::exp(sum / weight.max(f64::MIN_POSITIVE)), 1.0 / NODES as f64);
    DesiredSpeed { nodes: parts.map(node).to_vec(), is_shown }
}

#[cfg(test)]
mod tests {
    use laneweave_models::follow::{FollowingModel, Idm};

    use super::*;

    #[test]
    fn who_speeds_up_on_a_free_road_wants_more_than_who_keeps_its_speed() {
        const SPEED: f64 = 20.0;
        let follow = FollowingModel::Idm(Idm { acceleration: 1.4, ..Idm::default() });
        for acceleration in [-0.1, 0.0, 0.1, 0.25_f64] {
            let pace = Pace::new(SPEED, SPEED);
            let driver = Driver { pace, acceleration, follow: &follow, comfortable: 0.0, length: 4.5 };
            let factor = desired_by(&driver, None, SPEED).expect("it shows");
            // The acceleration is a (1 − (v/v₀)⁴).
            let expected = (1.0 - acceleration / 1.4).powf(-0.25);
            assert!((factor - expected).abs() < 1e-6, "{acceleration} m/s²: {factor} is not {expected}");
        }
    }

    #[test]
    fn many_free_seconds_show_more_than_one_and_none_show_nothing() {
        let assert_shows = |logs: &[f64], mean: f64, error: f64| {
            let (found, its_error) = mean_of(logs).expect("they show it");
            assert!(
                (found - mean).abs() < 1e-12 && (its_error - error).abs() < 1e-12,
                "{found} ± {its_error}"
            );
        };
        assert_eq!(mean_of(&[]), None);
        // One second: ten elevenths of the usual variance.
        assert_shows(&[0.1], 0.1, (10.0 / 11.0 * 0.03 * 0.03 + 0.005 * 0.005_f64).sqrt());
        // A thousand are a hundred looks.
        let logs: Vec<f64> = (0..1000).map(|it| if it % 2 == 0 { 0.05 } else { 0.15 }).collect();
        let variance = (1000.0 * 0.05 * 0.05 + 10.0 * 0.03 * 0.03) / 1010.0;
        assert_shows(&logs, 0.1, (variance / 100.0 + 0.005 * 0.005_f64).sqrt());
    }

    #[test]
    fn a_free_driver_shows_its_desired_speed() {
        let shown = Shown { free: Some((0.1, 0.03)), reached: 0.1 };
        let desired = posterior(Some(&shown), (0.0, 0.1));
        // Between 0 ± .1 and .1 ± .03: .1/(1 + .09).
        assert!((libm::log(desired.mean()) - 0.0917).abs() < 2e-3, "{}", desired.mean());
        let spread = desired.nodes[NODES - 1].0 - desired.nodes[0].0;
        assert!(spread > 0.06 && spread < 0.12, "{spread}");
    }

    #[test]
    fn a_driver_who_was_held_up_wants_no_less_than_it_drives() {
        let shown = Shown { free: None, reached: 0.0 };
        let desired = posterior(Some(&shown), (0.0, 0.1));
        // The mean of the upper half of a normal distribution: .1 √(2/π), a little less for the noise.
        assert!((libm::log(desired.mean()) - 0.07).abs() < 0.012, "{}", desired.mean());
        assert!(desired.nodes[0].0 > 0.96);
        let slow = Shown { free: None, reached: -1.0 };
        assert!((posterior(Some(&slow), (0.0, 0.1)).mean() - 1.0).abs() < 0.02);
    }

    #[test]
    fn the_distribution_of_free_drivers_comes_back() {
        let free: Vec<Shown> = (0..500)
            .map(|it| {
                let z = laneweave_sim::normal_quantile((f64::from(it) + 0.5) / 500.0);
                Shown { free: Some((-0.05 + 0.08 * z, 0.03)), reached: 0.0 }
            })
            .collect();
        let (mean, deviation) = distribution(&free.iter().collect::<Vec<_>>());
        assert!((mean + 0.05).abs() < 2e-3, "{mean}");
        assert!((deviation - (0.08_f64 * 0.08 - 0.03 * 0.03).sqrt()).abs() < 5e-3, "{deviation}");
    }
}
