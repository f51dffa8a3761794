//! How well drivers who were not seen are predicted: by the fitted numbers, by those of the prior style, and by a
//! constant speed.
//!
//! A prediction knows nothing that comes after its start: the desired speed of a driver is what its speeds had shown
//! until then, and its own time gap is that of the start.

use laneweave_models::Style;

use super::episode::Followed;
use super::predict::{Follower, Moved};
use super::problem::{Case, PARAMETERS, Parameters, Problem, factor};
use super::stretch::{Stretch, Stretches, stretches};
use crate::held_out::{Difference, Folds, interval};
use crate::resample::{folds, resampled_drivers};

/// How wrong predictions are in the mean.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrong {
    /// Distance along the lane [m].
    pub distance: f64,
    /// Speed [m/s].
    pub speed: f64,
}

/// Predictions of one horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowingScore {
    /// Time after the start [s].
    pub after: f64,
    /// Number of predictions.
    pub count: usize,
    /// By the numbers that were fitted to other drivers.
    pub fitted: Wrong,
    /// By the numbers of the prior style.
    pub prior: Wrong,
    /// By the speed at the start.
    pub constant: Wrong,
    /// By how much the distance is less wrong by the fitted numbers than by a constant speed [m].
    pub over_constant: Difference,
}

/// The looks after the start at which predictions are compared: about 1, 3 and 5 s.
const HORIZONS: [usize; 3] = [1, 3, 5];

/// The errors of one prediction: of the fitted numbers, the prior style's and a constant speed, at each horizon.
struct Scored {
    driver: usize,
    after: [f64; 3],
    wrong: [[Wrong; 3]; 3],
}

/// The scores of all drivers in stretches as long as the last horizon, each predicted by what was fitted to the
/// stretches `cut` of those of other parts, from `start` on; none if nothing can be fitted.
pub(super) fn scores(
    style: &Style,
    drivers: &[Followed],
    cut: &[Stretches],
    start: Parameters,
    asked: &Folds,
) -> Vec<FollowingScore> {
    let folds = folds(drivers.len(), asked.parts, asked.seed, 0);
    let short = stretches(drivers, HORIZONS[HORIZONS.len() - 1]);
    let of = |part: usize| {
        let problem = Problem::of(style, cut, |it| folds[it] != part)?;
        let all: [usize; PARAMETERS] = std::array::from_fn(|it| it);
        let fitted = problem.maximum(start, &all, None)?.at;
        let mut scored = Vec::new();
        for (driver, stretches) in short.iter().enumerate().filter(|it| folds[it.0] == part) {
            for stretch in &stretches.all {
                let desired = factor(stretch.shown.as_ref(), problem.desired) * stretch.allowed;
                let by_fit = problem.predicted(&Case { driver, stretch, desired }, &fitted);
                scored.push(Scored::of(driver, stretch, [by_fit, by_style(style, stretch), steady(stretch)]));
            }
        }
        Some(scored)
    };
    let parts: Option<Vec<Vec<Scored>>> = (0..asked.parts).map(of).collect();
    let scored: Vec<Scored> = parts.into_iter().flatten().flatten().collect();
    let score = |at| FollowingScore::of(&scored, at, drivers.len(), asked);
    if scored.is_empty() { Vec::new() } else { (0..HORIZONS.len()).map(score).collect() }
}

/// As a driver of `style` would go on.
fn by_style(style: &Style, stretch: &Stretch) -> Vec<Moved> {
    let follower = Follower {
        model: style.follow,
        comfortable: style.manner.comfortable_deceleration,
        desired: style.speed_factor * stretch.allowed,
        strength: stretch.strength,
    };
    follower.predicted(stretch)
}

/// At the speed of the start.
fn steady(stretch: &Stretch) -> Vec<Moved> {
    let speed = stretch.own[0].speed;
    let at = |it: usize| Moved { way: speed * stretch.period * it as f64, speed };
    (1..=stretch.length()).map(at).collect()
}

impl Scored {
    fn of(driver: usize, stretch: &Stretch, predicted: [Vec<Moved>; 3]) -> Scored {
        let wrong = |predicted: Vec<Moved>| {
            HORIZONS.map(|it| Wrong {
                distance: (predicted[it - 1].way - stretch.own[it].way).abs(),
                speed: (predicted[it - 1].speed - stretch.own[it].speed).abs(),
            })
        };
        let after = HORIZONS.map(|it| it as f64 * stretch.period);
        Scored { driver, after, wrong: predicted.map(wrong) }
    }
}

impl FollowingScore {
    fn of(scored: &[Scored], at: usize, drivers: usize, asked: &Folds) -> FollowingScore {
        let count = scored.len() as f64;
        let mean = |of: &dyn Fn(&Scored) -> f64| scored.iter().map(of).sum::<f64>() / count;
        let [fitted, prior, constant] = [0, 1, 2].map(|who| Wrong {
            distance: mean(&|it| it.wrong[who][at].distance),
            speed: mean(&|it| it.wrong[who][at].speed),
        });
        let better = |times: &[f64]| {
            let (mut sum, mut all) = (0.0, 0.0);
            for it in scored {
                let [fitted, _, constant] = it.wrong;
                sum += times[it.driver] * (constant[at].distance - fitted[at].distance);
                all += times[it.driver];
            }
            sum / f64::max(all, 1.0)
        };
        let drawn = (0..asked.draws).map(|draw| better(&resampled_drivers(drivers, asked.seed, draw)));
        let over_constant =
            Difference { estimate: better(&vec![1.0; drivers]), interval: interval(drawn.collect()) };
        FollowingScore {
            after: mean(&|it| it.after[at]),
            count: scored.len(),
            fitted,
            prior,
            constant,
            over_constant,
        }
    }
}
