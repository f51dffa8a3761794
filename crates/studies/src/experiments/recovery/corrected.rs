//! What simulation-extrapolation makes of fits to recordings whose errors have a known size.

use laneweave::Fault;

use crate::in_parallel;
use laneweave_calibration::observe::Known;
use laneweave_calibration::{Estimate, MULTIPLES, extrapolated};

use super::drone::{Driven, NOISE};
use super::settings::Setting;
use super::weights::{Process, Seen, WEIGHTS, WeightFit};
use crate::experiments::effort::Effort;

/// Recordings with more errors, for each multiple of the variance.
const REPEATS: u64 = 2;
/// Times at which drivers are looked at in a second.
const PHASES: u32 = 2;

/// A fit, as it is and corrected.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) plain: Seen,
    pub(crate) corrected: Seen,
}

/// Fits to the recordings of so many seeds.
pub(crate) fn fits(setting: &Setting, effort: &Effort, count: u64) -> Result<Vec<Pair>, Fault> {
    let seeds: Vec<u64> = (1..=count).collect();
    in_parallel(&seeds, effort.threads, |seed| pair(&Driven::of(setting, *seed, effort.length)?))
}

fn pair(driven: &Driven) -> Result<Pair, Fault> {
    let plain = of_recording(driven, 0.0, 0, |it| it.whole())?;
    let (rough, similar) = of_recording(driven, 0.0, 0, |it| it.rough(None))?;
    let mut repeated: [Vec<Seen>; MULTIPLES.len()] = Default::default();
    for (number, (all, multiple)) in (0..).zip(repeated.iter_mut().zip(MULTIPLES)) {
        for repeat in 0..REPEATS {
            let seed = 1 + number * REPEATS + repeat;
            let fit = of_recording(driven, NOISE * multiple.sqrt(), seed, |it| it.rough(Some(&similar)))?;
            all.push(fit.0);
        }
    }
    let mut corrected = plain;
    for weight in 0..WEIGHTS.len() {
        let of = |it: &Seen| Estimate { value: it.shares[weight], standard_error: it.errors[weight] };
        let found = extrapolated(of(&rough), &repeated.each_ref().map(|it| it.iter().map(of).collect()));
        corrected.shares[weight] += found.value - rough.shares[weight];
        corrected.errors[weight] *= found.standard_error / rough.errors[weight];
    }
    Ok(Pair { plain, corrected })
}

/// A fit of the full estimator to positions with `more` errors [m].
fn of_recording<R>(
    driven: &Driven,
    more: f64,
    seed: u64,
    fit: impl FnOnce(&WeightFit) -> R,
) -> Result<R, Fault> {
    let recording = driven.recorded_worse(more, seed);
    let matched = driven.matched(&recording);
    let observations = driven.observations(&matched, Known::default(), PHASES)?;
    Ok(fit(&WeightFit::of(driven, &observations, Process::Waits)?))
}
