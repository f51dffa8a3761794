//! Recovery in small.

use super::drone::{Driven, Seen, WEIGHTS};
use super::exact;
use super::variants::{EXACT, OURS, PLAIN, fits_of};
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
fn what_is_known_of_drivers_whom_a_drone_sees_brings_their_weights_nearer() {
    let driven = Driven::of(1, 0.6).expect("built-in styles");
    let [plain, exact, ours] = fits_of(&[PLAIN, EXACT, OURS], &driven).expect("three fits")[..] else {
        panic!("three fits")
    };
    let off = |it: &Seen, weight: usize| (it.shares[weight] - 1.0).abs();
    for weight in 0..WEIGHTS.len() {
        assert!(off(&exact, weight) < 0.3 * off(&plain, weight), "{plain:?} {exact:?}");
        assert!(off(&ours, weight) < 0.5 * off(&plain, weight), "{plain:?} {ours:?}");
    }
    let [all, used] = ours.changes;
    assert!(used * 10 > all * 7, "{used} of {all}");
}
