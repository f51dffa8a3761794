//! Keeping to the slow side.

use crate::incentives::{IDM, chances, leaving_route};
use crate::near::assert_near;
use crate::situations::{driver, empty_road};
use crate::weights::mcdm;
use laneweave_models::Reading::Repaired;
use laneweave_models::change::{Incentive, Keeping, LaneRule, Mcdm, Situation, Toward};
use laneweave_models::follow::Ahead;

#[test]
fn keeping_to_the_slow_side_grows_with_the_time_that_one_could_stay_there() {
    let keeping = Keeping { weight: 1.0, stay: 20.0 };
    let wish = |ahead| keeping.wish(ahead, f64::INFINITY, 30.0);
    // 100 m behind a leader 10 m/s slower than desired: 10 s of 20 s.
    assert_near(wish(Some(Ahead::steady(100.0, 20.0))), 0.25, 1e-12);
    assert_eq!(wish(Some(Ahead::steady(200.0, 20.0))), 1.0);
    assert_eq!(wish(Some(Ahead::steady(5.0, 31.0))), 1.0);
    assert_eq!(wish(None), 1.0);
    assert_eq!(wish(Some(Ahead::steady(-1.0, 0.0))), 0.0);
    // 150 m to the last place for the change back at 30 m/s: 5 s.
    assert_near(keeping.wish(None, 150.0, 30.0), 0.0625, 1e-12);
    assert_near(keeping.wish(Some(Ahead::steady(100.0, 20.0)), 150.0, 30.0), 0.0625, 1e-12);
    assert_eq!(keeping.wish(None, -1.0, 30.0), 0.0);
}

#[test]
fn keeping_asks_a_driver_to_the_slow_side_and_holds_it_there_where_the_law_has_it() {
    let keeping = Keeping { weight: 1.0, stay: 20.0 };
    let mut situation = empty_road(driver(&IDM, 30.0, 30.0));
    situation.there.ahead = Some(Ahead::steady(100.0, 20.0));
    let earns = |toward, lane_rule, situation: &Situation<'static>| {
        let situation = Situation { toward, lane_rule, ..*situation };
        keeping.earning(&situation, chances(1.0))
    };
    let sides = [Toward::Nearside, Toward::Offside];
    for rule in [LaneRule::SlowSide, LaneRule::NoPassingThere] {
        let mut situation = situation;
        for expected in [[0.25, -1.0], [1.0, -0.25]] {
            sides.into_iter().zip(expected).for_each(|(toward, earning)| {
                assert_near(earns(toward, rule, &situation), earning, 1e-12);
            });
            std::mem::swap(&mut situation.here, &mut situation.there);
        }
    }
    for toward in sides {
        assert_eq!(earns(toward, LaneRule::Free, &situation), 0.0);
    }
}

#[test]
fn keeping_asks_nobody_to_a_lane_that_it_would_have_to_leave_at_once_and_holds_nobody_in_one() {
    let keeping = Keeping { weight: 1.0, stay: 20.0 };
    let law = Situation { lane_rule: LaneRule::NoPassingThere, ..empty_road(driver(&IDM, 30.0, 30.0)) };
    let mut situation = leaving_route(Situation { toward: Toward::Nearside, ..law }, 300.0);
    assert_near(keeping.earning(&situation, chances(1.0)), 0.25, 1e-12);
    situation.toward = Toward::Offside;
    std::mem::swap(&mut situation.here, &mut situation.there);
    assert_near(keeping.earning(&situation, chances(1.0)), -0.25, 1e-12);
}

#[test]
fn nobody_counts_on_passing_on_the_slow_side_in_free_traffic() {
    let model =
        Mcdm { keeping: Keeping { weight: 0.1, stay: 20.0 }, ..mcdm(Repaired, [1.0, 0.0, 0.0, 0.0], 1.1) };
    let speeds = |toward, speed, leader| {
        let leader = Some(Ahead::steady(50.0, leader));
        let ahead = if toward == Toward::Offside { [None, leader] } else { [leader, None] };
        model.without_passing(toward, speed, ahead, [26.0, 30.0])
    };
    assert_eq!(speeds(Toward::Nearside, 28.0, 25.0), [26.0, 26.0]);
    assert_eq!(speeds(Toward::Offside, 28.0, 25.0), [26.0, 30.0]);
    // The leader in the overtaking lane is faster, or traffic is congested.
    assert_eq!(speeds(Toward::Nearside, 24.0, 25.0), [26.0, 30.0]);
    assert_eq!(speeds(Toward::Nearside, 28.0, 16.0), [26.0, 30.0]);
    let leader = Some(Ahead::steady(50.0, 25.0));
    assert_eq!(model.without_passing(Toward::Offside, 28.0, [None, leader], [30.0, 26.0]), [26.0, 26.0]);
}
