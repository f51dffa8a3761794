//! What the façade tells, sets and begins anew.

use std::path::{Path, PathBuf};

use laneweave::sim::Command;
use laneweave::{
    Class, Columns, Control, Decision, Event, FaultKind, Lateral, LightState, Longitudinal, NewVehicle,
    Parameter, Simulation,
};

fn map(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps").join(name)
}

fn simulation(name: &str, vehicles_per_hour: f64, seed: u64) -> Simulation {
    let builder = Simulation::builder(map(name)).vehicles_per_hour(vehicles_per_hour).seed(seed).threads(1);
    builder.build().expect("the map is sound")
}

#[test]
fn a_simulation_that_is_reset_drives_as_a_new_one_with_that_seed() {
    for name in ["ramps.osm", "grid.osm"] {
        let mut again = simulation(name, 3000.0, 1);
        let hash = |it: &mut Simulation| {
            it.run(90.0).expect("a time to come");
            it.state_hash()
        };
        let first = hash(&mut again);
        for seed in [2, 3, 1] {
            again.reset(seed).expect("the seed is a number");
            assert_eq!(again.time_s(), 0.0);
            let fresh = hash(&mut simulation(name, 3000.0, seed));
            assert_eq!(hash(&mut again), fresh, "{name} with seed {seed}");
            assert_eq!(seed == 1, fresh == first, "{name} with seed {seed}");
        }
    }
}

#[test]
fn what_users_have_set_is_gone_after_a_reset() {
    let mut simulation = simulation("grid.osm", 2000.0, 4);
    let (origin, before) = simulation.origins()[0];
    let light = simulation.lights()[0].id;
    let time_gap = simulation.parameter("aggressive", Parameter::TimeGap).expect("it has one");
    simulation.set_demand(origin, 10.0).expect("an entrance");
    simulation.set_light(light, Some(LightState::Red)).expect("a light");
    simulation.set_parameter("aggressive", Parameter::TimeGap, 3.0).expect("a number");
    simulation.run(30.0).expect("a time to come");
    simulation.reset(4).expect("a seed");
    assert_eq!(simulation.demand_at(origin), Some(before));
    assert_eq!(simulation.light_override(light), Some(None));
    assert_eq!(simulation.parameter("aggressive", Parameter::TimeGap), Some(time_gap));
}

#[test]
fn what_was_set_is_told_at_once_and_after_the_step_that_carries_it_out() {
    let mut simulation = simulation("grid.osm", 2000.0, 1);
    simulation.run(20.0).expect("a time to come");
    let (origin, _) = simulation.origins()[0];
    let light =
        simulation.lights().into_iter().find(|it| simulation.offset(it.id).is_some()).expect("a plan").id;
    let vehicle = simulation.vehicles()[0].id;
    simulation.set_demand(origin, 321.0).expect("an entrance");
    simulation.set_share("aggressive", 2.5).expect("a style");
    simulation.set_parameter("conservative", Parameter::TimeGap, 1.75).expect("a number");
    simulation.set_light(light, Some(LightState::Red)).expect("a light");
    simulation.set_offset(light, 7.0).expect("a plan");
    simulation.set_style(vehicle, "aggressive").expect("a style");
    for _ in 0..2 {
        assert_eq!(simulation.demand_at(origin), Some(321.0));
        assert_eq!(simulation.share("aggressive"), Some(2.5));
        assert_eq!(simulation.parameter("conservative", Parameter::TimeGap), Some(1.75));
        assert_eq!(simulation.light_override(light), Some(Some(LightState::Red)));
        assert_eq!(simulation.offset(light), Some(7.0));
        assert_eq!(simulation.style_of(vehicle), Some("aggressive"));
        simulation.step();
    }
    assert_eq!(simulation.demand_at(-1), None);
    assert_eq!(simulation.share("nobody"), None);
    assert_eq!(simulation.light_override(-1), None);
}

#[test]
fn a_closed_lanelet_is_told_as_closed() {
    let mut simulation = simulation("motorway_3_lanes.osm", 1000.0, 1);
    let lanelets = simulation.lanelets();
    let lanelet =
        *lanelets.iter().find(|it| simulation.close_lanelet(**it, true).is_ok()).expect("one can be closed");
    assert_eq!(simulation.is_closed(lanelet), Some(true));
    simulation.step();
    assert_eq!(simulation.is_closed(lanelet), Some(true));
    simulation.close_lanelet(lanelet, false).expect("it can be opened");
    assert_eq!((simulation.is_closed(lanelet), simulation.is_closed(-1)), (Some(false), None));
}

#[test]
fn a_command_replaces_those_that_wait_and_a_refused_one_replaces_nothing() {
    let mut simulation = simulation("ramps.osm", 3000.0, 1);
    simulation.run(60.0).expect("a time to come");
    let vehicle = simulation.vehicles()[0].id;
    let (origin, before) = simulation.origins()[0];
    let demand = |vehicles_per_hour| Command::SetDemand { origin, vehicles_per_hour };
    simulation.replace(demand(100.0)).expect("an entrance");
    simulation.replace(demand(200.0)).expect("an entrance");
    assert_eq!(simulation.give(demand(300.0)).expect_err("there is one").kind, FaultKind::Command);
    simulation.replace(demand(-1.0)).expect_err("nobody can arrive backwards");
    assert_eq!(simulation.demand_at(origin), Some(200.0));
    assert_ne!(before, 200.0);
    let control = Control::Drive { longitudinal: Longitudinal::Speed(3.0), lateral: Lateral::Keep };
    simulation.replace(Command::Control(vehicle, control)).expect("it is on the road");
    simulation.replace(Command::Remove(vehicle)).expect("it is on the road");
    assert!(simulation.is_leaving(vehicle));
    simulation.step();
    assert_eq!(simulation.vehicle(vehicle), None);
}

#[test]
fn an_evaluation_says_what_the_driver_then_does_and_events_tell_its_reasons() {
    let mut simulation = simulation("ramps.osm", 4000.0, 1);
    simulation.run(60.0).expect("a time to come");
    let (mut wants, mut changes) = (0, 0);
    for _ in 0..600 {
        let evaluations: Vec<_> =
            simulation.vehicles().iter().filter_map(|it| simulation.evaluate(it.id)).collect();
        let events = simulation.step();
        for evaluation in evaluations {
            let Decision::Wants { side, .. } = evaluation.decision else { continue };
            let chosen = evaluation.sides.iter().find(|it| it.side == side).expect("it considers the side");
            assert!(evaluation.has_last_chance || chosen.is_considered);
            assert!(chosen.reasons.iter().any(|it| it.incentive == "speed"));
            let view = simulation.view(evaluation.vehicle);
            wants += u32::from(view.is_some_and(|it| it.lane_change.side == side));
        }
        for event in events {
            let Event::LaneChange(change) = event else { continue };
            let names: Vec<&str> = change.reasons.iter().map(|it| &*it.incentive).collect();
            assert_eq!(names, ["speed", "route", "comfort", "courtesy", "urgency", "keeping"]);
            assert!(!change.style.is_empty() && change.reasons.iter().any(|it| it.contribution() != 0.0));
            changes += 1;
        }
    }
    assert!(wants > 10 && changes > 10, "{wants} desires, {changes} changes");
}

#[test]
fn complete_columns_hold_all_that_vehicles_have() {
    let mut simulation = simulation("town.osm", 3000.0, 1);
    simulation.run(120.0).expect("a time to come");
    let (styles, mut columns) = (simulation.styles(), Columns::complete());
    simulation.columns(&mut columns);
    assert!(columns.len() > 50);
    for row in 0..columns.len() {
        let state = simulation.vehicle(columns.id[row]).expect("it is on the road");
        assert_eq!(styles[columns.style[row] as usize].name, state.style);
        assert_eq!((columns.class[row], columns.destination[row]), (state.class, state.destination));
        assert_eq!([columns.length_m[row], columns.width_m[row]], [state.length_m, state.width_m]);
        assert_eq!([columns.z_m[row], columns.offset_m[row]], [state.z_m, state.offset_m]);
        assert_eq!((columns.state[row], columns.is_external[row]), (state.state, state.is_external));
    }
}

#[test]
fn faults_have_kinds_that_a_binding_can_make_exceptions_of() {
    let kind = |it: Result<Simulation, laneweave::Fault>| it.err().expect("it is refused").kind;
    assert_eq!(kind(Simulation::from_file("nowhere.osm")), FaultKind::NotFound);
    assert_eq!(kind(Simulation::from_text("map = ", "")), FaultKind::Syntax);
    let text = |more: &str| format!("map = {:?}\n{more}", map("ramps.osm").display().to_string());
    assert_eq!(kind(Simulation::from_text(&text("[run]\nstep_s = 3.0"), "")), FaultKind::Value);
    assert_eq!(kind(Simulation::from_text(&text("[styles]\nnobody = 1"), "")), FaultKind::Style);
    let mut simulation = Simulation::from_text(&text(""), "").expect("it is a scenario");
    assert_eq!(simulation.run(-1.0).expect_err("time goes on").kind, FaultKind::State);
    assert_eq!(simulation.remove(7).expect_err("nobody is there").kind, FaultKind::NotFound);
    let vehicle = NewVehicle {
        lanelet: simulation.lanelets()[0],
        position_m: 1e6,
        speed_mps: 0.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
    };
    assert_eq!(simulation.insert(vehicle).expect_err("the lanelet is shorter").kind, FaultKind::Command);
}
