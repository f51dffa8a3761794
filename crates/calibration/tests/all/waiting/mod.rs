//! The hidden process: its gradient, its limits, and weights that come back from simulated drivers.

mod classes;
mod made;

use laneweave_calibration::measures::Prediction;
use laneweave_calibration::waiting::{GAP_TERMS, Layout, NO_STRATUM};
use made::{Random, TRUTH, Truth, assumptions, simulated};

#[test]
fn the_gradient_is_that_of_the_likelihood() {
    let mut random = Random(5);
    let mut design = simulated(&TRUTH, 20, 12, &mut random);
    // Two possible desired speeds, two phases, places, spells without a side, and a second spell.
    design.nodes = 2;
    design.strata = 3;
    design.values = design.values.chunks(2).flat_map(|it| [it[0], it[1], 0.7 * it[0] + 0.1, it[1]]).collect();
    for (row, places) in design.places.iter_mut().enumerate() {
        *places = [(row % 2) as u32, if row % 3 == 0 { 2 } else { NO_STRATUM }];
    }
    for driver in &mut design.drivers {
        driver.chances = vec![0.3, 0.7];
        let mut other = driver.phases[0].clone();
        other[0].seconds.remove(0);
        let mut later = other[0].clone();
        later.changed_to = None;
        if let Some(middle) = later.seconds.get_mut(1) {
            middle[0] = None;
        }
        other.push(later);
        driver.phases.push(other);
    }
    let layout = Layout::of(&design);
    let (assumptions, weights) = (assumptions(layout), vec![1.0; 20]);
    let at: Vec<f64> =
        (0..layout.count()).map(|it| [-2.0, 0.5, -0.3, -4.0, -2.0, -3.0, -0.7][it % 7]).collect();
    let value = |at: &[f64]| design.log_likelihoods(at, assumptions.has_spread, &weights).iter().sum::<f64>();
    let gradient = design.gradient(&assumptions, &weights, &at);
    for parameter in 0..layout.count() {
        let step = 1e-5;
        let [above, below] = [step, -step].map(|step| {
            let mut at = at.clone();
            at[parameter] += step;
            value(&at)
        });
        let difference = (above - below) / (2.0 * step);
        let error = (gradient[parameter] - difference).abs();
        assert!(error < 1e-6 * (1.0 + difference.abs()), "{parameter}: {} {difference}", gradient[parameter]);
    }
}

#[test]
fn weights_of_drivers_who_wait_for_gaps_come_back() {
    let mut random = Random(11);
    let design = simulated(&TRUTH, 3000, 60, &mut random);
    let layout = Layout::of(&design);
    let fit = design.fit(&assumptions(layout), &vec![1.0; 3000]);
    assert!(fit.is_converged);
    let expected = [
        (layout.intercept(), TRUTH.intercept),
        (layout.slopes().start, 1.2),
        (layout.slopes().start + 1, -0.6),
    ];
    for (parameter, truth) in expected {
        let (estimate, error) = (fit.estimates[parameter], fit.standard_error(parameter));
        assert!(
            (estimate - truth).abs() < 3.5 * error,
            "{parameter}: {estimate} ± {error} instead of {truth}"
        );
        assert!(error < 0.3, "{parameter}: {error}");
    }
    assert_eq!(GAP_TERMS, 4);
}

#[test]
fn who_takes_a_blocked_gap_for_no_desire_finds_too_small_weights() {
    // Most gaps are refused: a plain logit sees few changes where the desire is strong.
    let truth = Truth { acceptance: [-1.5, 2.0], spread: 0.0, ..TRUTH };
    let design = simulated(&truth, 3000, 40, &mut Random(3));
    let layout = Layout::of(&design);
    let (weights, mut joint) = (vec![1.0; 3000], assumptions(layout));
    joint.has_spread = false;
    joint.is_fixed[layout.spread()] = true;
    let mut naive = joint.clone();
    // A plain logit: every gap is accepted, nobody waits, everything is explained.
    let acceptance = layout.acceptance();
    let certain = [(layout.background(), -30.0), (layout.waiting(), -30.0), (acceptance.start, 30.0)];
    for (at, value) in certain.into_iter().chain((acceptance.start + 1..acceptance.end).map(|it| (it, 0.0))) {
        naive.is_fixed[at] = true;
        naive.prior.means[at] = value;
    }
    let of = |assumptions| {
        let fit = design.fit(assumptions, &weights);
        let slope = layout.slopes().start;
        (fit.estimates[slope], fit.standard_error(slope))
    };
    let ((joint, error), (naive, naive_error)) = (of(&joint), of(&naive));
    assert!((joint - 1.2).abs() < 3.0 * error, "{joint} ± {error}");
    assert!(1.2 - naive > 5.0 * naive_error, "{naive} ± {naive_error}");
}

#[test]
fn threads_change_nothing() {
    let design = simulated(&TRUTH, 200, 30, &mut Random(7));
    let assumptions = assumptions(Layout::of(&design));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| design.fit(&assumptions, &vec![1.0; 200]))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn predictions_second_by_second_are_the_likelihood() {
    let mut design = simulated(&TRUTH, 30, 15, &mut Random(9));
    // With one side the chance of a change is that of a change to it.
    for spell in design.drivers.iter_mut().flat_map(|it| it.phases.iter_mut().flatten()) {
        spell.seconds.iter_mut().for_each(|it| it[1] = None);
        spell.changed_to = spell.changed_to.map(|_| 0);
    }
    let layout = Layout::of(&design);
    let at = assumptions(layout).prior.means;
    let weights = vec![1.0; 30];
    let predictions = design.predictions(&at, &weights);
    let log = |it: &Prediction| (if it.came { it.probability } else { 1.0 - it.probability }).ln();
    let by_seconds: f64 = predictions.iter().map(log).sum();
    let whole: f64 = design.log_likelihoods(&at, false, &weights).iter().sum();
    assert!((by_seconds - whole).abs() < 1e-9 * whole.abs(), "{by_seconds} {whole}");
    assert_eq!(predictions.iter().filter(|it| it.came).count(), design.changes());
}

#[test]
fn draws_by_one_step_are_those_of_whole_fits() {
    let design = simulated(&TRUTH, 600, 40, &mut Random(23));
    let layout = Layout::of(&design);
    let assumptions = assumptions(layout).without_spread(&design);
    let all = vec![1.0; 600];
    let fit = design.fit(&assumptions, &all);
    // Drivers of whom every third counts twice, and every fourth not at all.
    let draw = |number: usize| -> Vec<f64> {
        let times = |it: usize| match (it + number) % 12 {
            0 | 4 | 8 => 0.0,
            3 | 6 | 9 => 2.0,
            _ => 1.0,
        };
        (0..600).map(times).collect()
    };
    let draws: Vec<Vec<f64>> = (0..4).map(draw).collect();
    let stepped = design.redrawn(&assumptions, &all, (&fit.estimates, Some(&fit.covariance)), &draws);
    for (draw, stepped) in draws.iter().zip(&stepped) {
        let whole = design.refit(&assumptions, draw, &fit.estimates, &fit.covariance);
        for at in layout.slopes().chain([layout.intercept()]) {
            let error = fit.standard_error(at);
            let off = (stepped[at] - whole[at]).abs();
            assert!(off < 0.35 * error, "{at}: {} or {} ± {error}", stepped[at], whole[at]);
        }
        assert_ne!(stepped[layout.intercept()], fit.estimates[layout.intercept()]);
    }
    // Who counts once is the fit itself.
    let same = design.redrawn(&assumptions, &all, (&fit.estimates, None), std::slice::from_ref(&all));
    assert_eq!(same, [fit.estimates]);
}
