//! What follows from the list of incentives. These tests go through the list, so they hold for an incentive more,
//! wherever it stands.

use crate::incentives::others::between_followers;
use crate::incentives::{IDM, leaving_route};
use crate::situations::{driver, empty_road};
use laneweave_models::Parameter;
use laneweave_models::change::{
    Appraisal, IncentiveName, LaneChangeModel, Lmrs, Mcdm, Mobil, Row, Rule, Toward,
};

/// θ.
const THRESHOLD: f64 = 0.01;

fn model() -> Mcdm {
    Mcdm { rule: Rule::Threshold, theta: THRESHOLD, ..Mcdm::default() }.with_weights(|_| 1.0)
}

/// The appraisal in which each incentive has the yield that `of` gives it.
fn appraisal(of: impl Fn(IncentiveName) -> f64) -> Appraisal {
    let rows = IncentiveName::ALL.map(|it| Row { earning: of(it), weight: 1.0 });
    Appraisal { rows, gain: rows.iter().map(|it| it.earning).sum(), theta: THRESHOLD }
}

fn others_than_keeping() -> impl Iterator<Item = IncentiveName> {
    IncentiveName::ALL.into_iter().filter(|it| *it != IncentiveName::Keeping)
}

#[test]
fn a_change_is_for_the_slow_side_if_no_other_incentive_is_reason_enough() {
    let model = LaneChangeModel::Mcdm(model());
    let situation = empty_road(driver(&IDM, 20.0, 20.0));
    let is_for_it = |it: &Appraisal| model.is_for_the_slow_side(&situation, it);
    let alone = appraisal(|it| if it == IncentiveName::Keeping { 2.0 * THRESHOLD } else { 0.0 });
    assert!(is_for_it(&alone));
    for other in others_than_keeping() {
        let with = |gain: f64| {
            appraisal(|it| match it {
                IncentiveName::Keeping => 2.0 * THRESHOLD,
                it if it == other => gain,
                _ => 0.0,
            })
        };
        assert!(!is_for_it(&with(2.0 * THRESHOLD)), "{other:?} is reason enough");
        assert!(is_for_it(&with(0.5 * THRESHOLD)), "{other:?} is not");
        let without_the_wish = appraisal(|it| if it == other { 2.0 * THRESHOLD } else { 0.0 });
        assert!(!is_for_it(&without_the_wish), "{other:?}");
    }
}

#[test]
fn each_incentive_has_the_weight_that_it_is_given() {
    let number = |it: IncentiveName| it as usize as f64;
    let weighed = model().with_weights(number);
    let rows = weighed.appraise(&between_followers());
    for name in IncentiveName::ALL {
        assert_eq!((weighed.weight(name), rows.row(name).weight), (number(name), number(name)));
        assert_eq!(Parameter::Weight(name).key(), format!("change.{}.weight", name.name()));
    }
}

#[test]
fn who_leaves_its_route_does_it_for_the_route_alone() {
    let appraisal = model().appraise_leaving(200.0, 100.0, 10.0).expect("it is worthwhile");
    for name in IncentiveName::ALL {
        let row = appraisal.row(name);
        assert_eq!(row.weight * row.earning > 0.0, name == IncentiveName::Route, "{name:?}");
    }
}

#[test]
fn a_row_that_counts_has_a_name_in_every_model() {
    let mut situation = leaving_route(between_followers(), 40.0);
    for toward in [Toward::Nearside, Toward::Offside] {
        situation.toward = toward;
        for model in [
            LaneChangeModel::Mcdm(model()),
            LaneChangeModel::Mobil(Mobil::default()),
            LaneChangeModel::Lmrs(Lmrs::default()),
        ] {
            let rows = model.appraise(&situation).rows;
            let counts = |row: &Row| row.weight * row.earning != 0.0;
            assert!(rows.iter().any(counts));
            for (row, name) in rows.iter().zip(model.row_names()) {
                assert!(!counts(row) || !name.is_empty(), "{model:?}: {row:?}");
            }
        }
    }
}
