//! How well the gaps that drivers accept are predicted who were not seen: with fitted critical gaps, and with those of
//! the prior style.

use super::offered::{GapSpell, OfferedGaps};
use super::problem::{Before, Found, Parameters, Problem};
use crate::held_out::{Difference, Folds, interval};
use crate::resample::resampled_drivers;

/// Log scores of what drivers did who were not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapScore {
    /// With critical gaps that were fitted to other drivers [nats per change].
    pub fitted: f64,
    /// With critical gaps as the prior style has them: all drivers have the same [nats per change].
    pub prior: f64,
    /// By how much better the fitted ones are [nats per change].
    pub over_prior: Difference,
}

/// Drivers who are seen, and what all were offered as far as those tell.
pub(super) struct Seen {
    /// 1 for each driver who is seen, 0 for those who are held out.
    pub(super) seen: Vec<f64>,
    pub(super) offered: OfferedGaps,
    pub(super) before: Before,
}

/// A search for held-out drivers ends where a step promises less than this [nats]: of hundreds of changes (ours).
const ENOUGH: f64 = 0.02;
/// Spread of critical gaps that are the same for all drivers.
const NONE: f64 = 0.02;

/// The scores of all drivers, each predicted by what was fitted to those of the other `parts`, from `start` on: the
/// critical gaps and all else, or all else beside the critical gaps of the prior style.
pub(super) fn score(parts: impl Iterator<Item = Seen>, start: &Parameters, asked: &Folds) -> GapScore {
    let (mut logs, mut changes) = ([Vec::new(), Vec::new()], Vec::new());
    for Seen { seen, offered, before } in parts {
        changes = changes_of(&offered);
        let [lead, lag] = before.medians.map(libm::log);
        let same = libm::log(NONE);
        let as_prior = [(0, lead), (1, same), (2, lag), (3, same)];
        let held_out: Vec<f64> = seen.iter().map(|it| 1.0 - it).collect();
        for (logs, held) in logs.iter_mut().zip([&[][..], &as_prior]) {
            logs.resize(seen.len(), 0.0);
            let seen = Problem::new(&offered, &seen, &before).holding(held);
            let Some(Found { at, .. }) = seen.maximum(start, ENOUGH) else { continue };
            let others = Problem::new(&offered, &held_out, &before);
            let predicted = Problem::logs(&others.tables(&at), &at);
            logs.iter_mut().zip(predicted).for_each(|(log, it)| *log += it);
        }
    }
    GapScore::of(&logs, &changes, asked)
}

/// How often each driver changed.
fn changes_of(offered: &OfferedGaps) -> Vec<f64> {
    let changes = |it: &Vec<GapSpell>| it.iter().filter(|it| it.changed_to.is_some()).count() as f64;
    offered.drivers.iter().map(changes).collect()
}

impl GapScore {
    /// From the log-likelihoods of all drivers.
    fn of([fitted, prior]: &[Vec<f64>; 2], changes: &[f64], asked: &Folds) -> GapScore {
        let per_change = |of: &dyn Fn(usize) -> f64, times: &[f64]| {
            let sum =
                |of: &dyn Fn(usize) -> f64| times.iter().enumerate().map(|it| it.1 * of(it.0)).sum::<f64>();
            sum(of) / sum(&|it| changes[it]).max(1.0)
        };
        let all = vec![1.0; changes.len()];
        let better = |driver: usize| fitted[driver] - prior[driver];
        let drawn = |draw| per_change(&better, &resampled_drivers(all.len(), asked.seed, draw));
        GapScore {
            fitted: per_change(&|it| fitted[it], &all),
            prior: per_change(&|it| prior[it], &all),
            over_prior: Difference {
                estimate: per_change(&better, &all),
                interval: interval((0..asked.draws).map(drawn).collect()),
            },
        }
    }
}
