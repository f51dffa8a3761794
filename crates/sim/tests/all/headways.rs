//! Headway distributions against their formulas, and samples of them against the distributions.

use laneweave_sim::{HeadwayError, Headways, Purpose, Random};

/// 900 veh/h.
const RATE: f64 = 0.25;
const MEAN: f64 = 4.0;

/// Distributions with a mean of 4 s, and their standard deviations [s].
fn laws() -> [(Headways, f64); 6] {
    let free = 0.6_f64;
    [
        (Headways::Exponential, MEAN),
        (Headways::Shifted { minimum: 1.0 }, MEAN - 1.0),
        (Headways::Erlang { stages: 3 }, MEAN / 3.0_f64.sqrt()),
        (Headways::PearsonIii { minimum: 0.5, variation: 0.5 }, 2.0),
        (Headways::Lognormal { variation: 0.5 }, 2.0),
        (Headways::CowanM3 { minimum: 1.5, free }, (MEAN - 1.5) * (2.0 / free - 1.0).sqrt()),
    ]
}

#[test]
fn v26_survival_is_that_of_the_formulas() {
    let gamma = Headways::PearsonIii { minimum: 0.5, variation: 0.5 };
    for (law, t, expected) in [
        (Headways::Exponential, 2.0, 0.606531),
        (Headways::Exponential, 1.0, 1.0 - 0.221199),
        (Headways::Shifted { minimum: 1.0 }, 2.0, 0.716531),
        (Headways::Shifted { minimum: 1.0 }, 5.0, 0.263597),
        (Headways::Shifted { minimum: 1.0 }, 0.9, 1.0),
        (Headways::Erlang { stages: 2 }, 2.0, 0.735759),
        (Headways::Erlang { stages: 3 }, 2.0, 0.808847),
        (gamma, 1.0, 0.991162),
        (gamma, 2.0, 0.863790),
        (gamma, 4.0, 0.423976),
        (gamma, 8.0, 0.044062),
        (Headways::Lognormal { variation: 0.5 }, 2.0, 0.890868),
        (Headways::CowanM3 { minimum: 1.5, free: 0.6 }, 3.0, 0.418606),
        (Headways::CowanM3 { minimum: 1.5, free: 0.6 }, 1.4, 1.0),
    ] {
        let found = law.survival(t, RATE);
        assert!((found - expected).abs() < 1e-6, "{law:?} at {t} s: {found}, not {expected}");
    }
}

#[test]
fn v26_quantiles_are_those_of_the_formulas() {
    for (law, u, expected) in [
        (Headways::Exponential, 0.7, 1.426700),
        (Headways::Shifted { minimum: 1.0 }, 0.7, 2.070025),
        (Headways::Shifted { minimum: 1.0 }, 0.5, 3.079442),
        (Headways::Lognormal { variation: 0.5 }, 0.5, 3.577709),
        (Headways::CowanM3 { minimum: 1.5, free: 0.6 }, 0.8, 1.5),
    ] {
        let found = law.exceeded(u, RATE);
        assert!((found - expected).abs() < 1e-6, "{law:?} at {u}: {found}, not {expected}");
    }
}

#[test]
fn v26_samples_have_the_mean_the_spread_and_the_law() {
    const N: u32 = 100_000;
    let random = Random::new(26);
    for ((law, deviation), subject) in laws().into_iter().zip(0..) {
        let mut sample: Vec<f64> = (0..N)
            .map(|count| law.exceeded(random.uniform(subject, Purpose::Arrival, count), RATE))
            .collect();
        sample.sort_by(f64::total_cmp);
        let n = f64::from(N);
        let mean = sample.iter().sum::<f64>() / n;
        let central = |power: i32| sample.iter().map(|it| (it - mean).powi(power)).sum::<f64>() / n;
        let found = central(2).sqrt();
        assert!((mean - MEAN).abs() < 1.96 * deviation / n.sqrt(), "{law:?}: mean {mean} s");
        // Standard error of a standard deviation: √((m₄ − sd⁴)/n)/(2 sd).
        let error = ((central(4) - found.powi(4)) / n).sqrt() / (2.0 * found);
        assert!((found - deviation).abs() < 1.96 * error, "{law:?}: sd {found} s, not {deviation}");
        // Kolmogorov-Smirnov test, 95 %, on both sides of each step. A distribution may have an atom at its minimum
        // headway.
        let distance = sample
            .iter()
            .enumerate()
            .filter(|(_, it)| **it > law.minimum())
            .map(|(index, it)| {
                let (below, above) = (index as f64 / n, (index + 1) as f64 / n);
                let chance = 1.0 - law.survival(*it, RATE);
                (chance - below).abs().max((chance - above).abs())
            })
            .fold(0.0, f64::max);
        assert!(distance < 1.358 / n.sqrt(), "{law:?}: distance {distance}");
    }
}

#[test]
fn v26_the_spread_of_pearson_iii_is_2_s_and_not_that_of_the_misprint() {
    // K = (mean − a)/sd = 1.75 would give 3.5/√1.75 = 2.65 s.
    let law = Headways::PearsonIii { minimum: 0.5, variation: 0.5 };
    let (n, step) = (400_000, 1e-4);
    // E[(t − a)²] = 2 ∫ (t − a) S dt.
    let second: f64 = (0..n)
        .map(|index| (f64::from(index) + 0.5) * step)
        .map(|beyond| 2.0 * beyond * law.survival(0.5 + beyond, RATE) * step)
        .sum();
    let deviation = (second - 3.5 * 3.5).sqrt();
    assert!((deviation - 2.0).abs() < 1e-4, "{deviation}");
}

#[test]
fn the_headway_exceeded_with_a_chance_is_exceeded_with_that_chance() {
    for (law, _) in laws() {
        for rate in [0.01, 0.25, 0.6] {
            for u in [0.001, 0.1, 0.3, 0.5] {
                let back = law.survival(law.exceeded(u, rate), rate);
                assert!((back - u).abs() < 1e-9, "{law:?} at {rate}: {back}, not {u}");
            }
        }
    }
}

#[test]
fn laws_that_cannot_be_are_refused() {
    let error = |law: Headways, rate: f64| law.check(rate).unwrap_err().to_string();
    assert!(laws().iter().all(|(law, _)| law.check(RATE).is_ok() && law.check(0.0).is_ok()));
    assert_eq!(
        error(Headways::Shifted { minimum: 4.0 }, RATE),
        "the shortest headway is 4 s, where the mean is 4.00 s: it must be shorter"
    );
    assert_eq!(
        error(Headways::Erlang { stages: 0 }, RATE),
        "the stages of the headways is 0: it must lie between 1 and 400"
    );
    let minimum = Headways::CowanM3 { minimum: f64::NAN, free: 0.5 };
    assert!(matches!(minimum.check(RATE), Err(HeadwayError::Parameter { key: "minimum", .. })));
    let free = Headways::CowanM3 { minimum: 1.0, free: 0.0 };
    assert!(matches!(free.check(RATE), Err(HeadwayError::Parameter { key: "free", .. })));
    let variation = Headways::Lognormal { variation: 0.0 };
    assert!(matches!(variation.check(RATE), Err(HeadwayError::Parameter { key: "variation", .. })));
}
