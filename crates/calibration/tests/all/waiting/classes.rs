//! Classes of drivers.

use laneweave_calibration::Mixture;
use laneweave_calibration::waiting::{Design, Layout};

use crate::waiting::made::{Random, TRUTH, Truth, assumptions, simulated};

/// The paper's share of aggressive drivers: 1 to 7.4.
const SHARE: f64 = 1.0 / 8.4;

/// Drivers of two styles, the first of which has the share of the paper.
fn two_styles(drivers: usize, seconds: usize, random: &mut Random) -> (Design, [Truth; 2]) {
    let often = Truth { intercept: -1.5, slopes: [2.0, -0.2], spread: 0.0, ..TRUTH };
    let seldom = Truth { intercept: -5.0, slopes: [0.5, -1.5], spread: 0.0, ..TRUTH };
    let first = (SHARE * drivers as f64).round() as usize;
    let mut design = simulated(&often, first, seconds, random);
    let other = simulated(&seldom, drivers - first, seconds, random);
    let rows = design.gaps.len();
    design.values.extend(other.values);
    design.gaps.extend(other.gaps);
    design.places.extend(other.places);
    design.drivers.extend(other.drivers.into_iter().map(|mut driver| {
        driver.rows = driver.rows.start + rows..driver.rows.end + rows;
        let spells = driver.phases.iter_mut().flatten();
        let sides = spells.flat_map(|it| &mut it.seconds).flat_map(|it| it.iter_mut().flatten());
        sides.for_each(|it| *it += rows as u32);
        driver
    }));
    (design, [often, seldom])
}

/// All parameters of a style.
fn parameters(truth: &Truth, layout: Layout) -> Vec<f64> {
    let mut all = assumptions(layout).prior.means;
    all[layout.intercept()] = truth.intercept;
    layout.slopes().zip(truth.slopes).for_each(|(at, slope)| all[at] = slope);
    all[layout.acceptance().start] = truth.acceptance[0];
    all[layout.acceptance().start + 1] = truth.acceptance[1];
    all
}

#[test]
fn shares_of_known_styles_come_back() {
    let (design, styles) = two_styles(800, 100, &mut Random(21));
    let layout = Layout::of(&design);
    let mut assumptions = assumptions(layout);
    assumptions.has_spread = false;
    let known = styles.iter().map(|it| parameters(it, layout)).collect();
    let mixture = Mixture::of_known(&design, &assumptions, known, &vec![1.0; 800]);
    assert!((mixture.shares[0] - SHARE).abs() < 0.02, "{:?}", mixture.shares);
    assert!((mixture.shares[0] - SHARE).abs() < 3.0 * mixture.share_errors[0]);
}

#[test]
fn two_styles_far_apart_are_told_apart_and_the_larger_class_comes_first() {
    let (design, _) = two_styles(800, 100, &mut Random(22));
    let layout = Layout::of(&design);
    let mut assumptions = assumptions(layout);
    assumptions.has_spread = false;
    assumptions.is_fixed[layout.spread()] = true;
    let weights = vec![1.0; 800];
    let fit = design.fit(&assumptions, &weights);
    let mixture = Mixture::fit(&design, &assumptions, &fit, 2, &weights);
    assert!((mixture.shares[1] - SHARE).abs() < 0.03, "{:?}", mixture.shares);
    let intercepts = [0, 1].map(|it: usize| mixture.parameters[it][layout.intercept()]);
    // Who changes at once is seen for a few seconds only.
    assert!((intercepts[0] + 5.0).abs() < 0.4 && (intercepts[1] + 1.5).abs() < 1.2, "{intercepts:?}");
}
