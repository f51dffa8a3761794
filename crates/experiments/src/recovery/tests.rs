//! Recovery in small.

use super::{drone, exact};
use crate::effort::Effort;

#[test]
fn weights_observed_exactly_come_back() {
    let fits = exact::fits(&Effort { seeds: 1, length: 0.4, threads: 2 }, 4).expect("built-in styles");
    for (at, name) in exact::TERMS.iter().enumerate() {
        let off = |it: &exact::Exact| (it.fit.estimates[at] - it.truth[at]) / it.fit.standard_errors()[at];
        let off: Vec<f64> = fits.iter().map(off).collect();
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        // The mean of four has a standard deviation of one half.
        assert!(mean.abs() < 2.0 && off.iter().all(|it| it.abs() < 4.0), "{name}: {off:?}");
    }
    assert!(fits.iter().all(|it| it.desires > 100));
}

#[test]
fn weights_seen_by_a_drone_come_back_far_better_than_a_plain_logit_has_them() {
    let fits = drone::fits(&Effort { seeds: 1, length: 0.6, threads: 2 }, 1).expect("built-in styles");
    let drone::Seen { changes: [all, used], shares, .. } = fits[0];
    assert!(used * 10 > all * 7, "{used} of {all}");
    // A plain logit has .38, .36 and .10 of the truth.
    assert!(shares.iter().all(|it| (0.6..1.8).contains(it)), "{shares:?}");
}
