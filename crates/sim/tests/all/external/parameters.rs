//! Users change the numbers of a style for all of its drivers.

use laneweave_models::change::IncentiveName;
use laneweave_models::{Parameter, Style};
use laneweave_sim::{Command, CommandError, Event, Setup, World};

use crate::external::worlds::{styles, world};
use crate::roads::{drivers, network};

const STYLE: &str = "conservative";

fn set(world: &mut World, parameter: Parameter, value: f64) {
    let command = Command::SetParameter { style: STYLE.into(), parameter, value };
    world.command(command).expect("the style has this number");
}

fn steps(world: &mut World, count: u32) {
    (0..count).for_each(|_| world.step());
}

/// A world like [`world`] on ramps, whose conservative style has this value from the beginning.
fn world_with(parameter: Parameter, value: f64) -> World {
    let network = network("ramps.osm");
    let demand = drivers::demand(&network, 4000.0, 0.1, &[0.3, 0.7]);
    let mut styles = styles();
    *parameter.place(&mut styles[1]).expect("the style has this number") = value;
    World::new(network, styles, demand, Setup { step: 0.1, seed: 1, threads: 1 }).expect("it makes sense")
}

/// A value in the range of a number that `style` has, other than its own.
fn other_value(parameter: Parameter, style: &Style) -> Option<f64> {
    let own = *parameter.place(&mut style.clone())?;
    let other = if own == 0.0 { 0.5 } else { 1.25 * own };
    Some(if parameter.range().holds(other, other) { other } else { 0.8 * own })
}

#[test]
fn drivers_go_on_as_if_their_style_had_always_had_the_new_value() {
    let mut before = world("ramps.osm", 4000.0, 1, 1);
    steps(&mut before, 1200);
    let saved = before.save().expect("it can be saved");
    let mut usual = world("ramps.osm", 4000.0, 1, 1);
    usual.restore(&saved).expect("it fits");
    steps(&mut usual, 200);
    let (mut tried, mut effective) = (0, 0);
    for parameter in Parameter::ALL {
        // A new desired speed, also in bends and before lower limits, holds at once, and so does a new epoch: not from
        // the next turn on.
        let desires =
            [Parameter::SpeedFactor, Parameter::ComfortableDeceleration, Parameter::LateralAcceleration];
        if parameter.key().contains("epoch") || desires.contains(parameter) {
            continue;
        }
        let Some(value) = other_value(*parameter, &styles()[1]) else { continue };
        let [mut changed, mut other] = [world("ramps.osm", 4000.0, 1, 1), world_with(*parameter, value)];
        [&mut changed, &mut other].into_iter().for_each(|it| it.restore(&saved).expect("it fits"));
        set(&mut changed, *parameter, value);
        steps(&mut changed, 200);
        steps(&mut other, 200);
        assert_eq!(changed.state_hash(), other.state_hash(), "{}", parameter.key());
        tried += 1;
        effective += u32::from(changed.state_hash() != usual.state_hash());
    }
    assert_eq!((tried, effective), (48, 28));
}

#[test]
fn before_the_first_step_a_new_value_is_like_one_from_the_beginning() {
    let mut usual = world("ramps.osm", 4000.0, 1, 1);
    steps(&mut usual, 1200);
    for (parameter, value) in
        [(Parameter::SpeedFactor, 0.8), (Parameter::Epoch, 3.0), (Parameter::InattentiveEpoch, 5.0)]
    {
        let [mut changed, mut other] = [world("ramps.osm", 4000.0, 1, 1), world_with(parameter, value)];
        set(&mut changed, parameter, value);
        steps(&mut changed, 1200);
        steps(&mut other, 1200);
        assert_eq!(changed.state_hash(), other.state_hash(), "{}", parameter.key());
        assert_ne!(changed.state_hash(), usual.state_hash(), "{}", parameter.key());
    }
}

#[test]
fn all_drivers_of_the_style_desire_the_new_speed_at_once_and_no_others() {
    let mut world = world("motorway_3_lanes.osm", 3000.0, 1, 1);
    steps(&mut world, 600);
    let before: Vec<_> = world.vehicles().map(|it| (it.id(), it.driver.limit_desired)).collect();
    set(&mut world, Parameter::SpeedFactor, 0.5);
    world.step();
    let mut halved = 0;
    for (id, before) in before {
        let Some(vehicle) = world.vehicle(id) else { continue };
        let is_of_style = vehicle.style().name == STYLE;
        let expected = if is_of_style { 0.5 * before } else { before };
        assert!((vehicle.driver.limit_desired - expected).abs() < 1e-4, "vehicle {id}");
        halved += u32::from(is_of_style);
    }
    assert!(halved > 10, "{halved}");
    steps(&mut world, 600);
    let of_style =
        world.vehicles().filter(|it| it.style().name == STYLE && it.driver.class.strength() == 3.0);
    let fastest = of_style.map(|it| it.speed()).fold(0.0, f64::max);
    assert!(fastest < 0.5 * 130.0 / 3.6 + 0.1, "{fastest}");
}

/// Drivers who let a vehicle in, summed over steps.
fn letting_in(world: &mut World, count: u32) -> usize {
    let one = |_| {
        world.step();
        world.vehicles().filter(|it| it.style().name == STYLE && it.lane_change.lets_in.0.is_finite()).count()
    };
    (0..count).map(one).sum()
}

#[test]
fn drivers_who_no_longer_brake_for_others_let_nobody_in() {
    let mut world = world("on_ramp.osm", 5000.0, 1, 1);
    steps(&mut world, 1800);
    assert!(letting_in(&mut world, 1200) > 100);
    set(&mut world, Parameter::YieldDeceleration, 0.0);
    world.step();
    assert_eq!(letting_in(&mut world, 1200), 0);
}

/// Lane changes for which courtesy spoke most, within so many steps.
fn out_of_courtesy(world: &mut World, count: u32) -> usize {
    let mut found = 0;
    for _ in 0..count {
        world.step();
        let is_polite =
            |it: &&Event| matches!(it, Event::LaneChange(it) if it.appraisal.leading() == Some(3));
        found += world.events().iter().filter(is_polite).count();
    }
    found
}

#[test]
fn drivers_with_more_courtesy_change_lanes_for_others_more_often() {
    let mut worlds = [1, 1].map(|threads| world("on_ramp.osm", 5000.0, 1, threads));
    let [usual, polite] = &mut worlds;
    [&mut *usual, &mut *polite].into_iter().for_each(|it| steps(it, 1800));
    set(polite, Parameter::Weight(IncentiveName::Courtesy), 10.0);
    let [usual, polite] = worlds.each_mut().map(|it| out_of_courtesy(it, 3000));
    assert!(polite > 2 * usual, "{polite} changes out of courtesy, {usual} with the usual weight");
}

#[test]
fn a_checkpoint_keeps_what_was_changed_and_threads_do_not_matter() {
    let mut hashes = Vec::new();
    for threads in [1, 2, 4] {
        let mut first = world("ramps.osm", 4000.0, 1, threads);
        steps(&mut first, 600);
        set(&mut first, Parameter::Weight(IncentiveName::Courtesy), 5.0);
        set(&mut first, Parameter::SpeedFactor, 0.8);
        steps(&mut first, 100);
        // A command that still waits is kept, too.
        set(&mut first, Parameter::TimeGap, 2.0);
        let saved = first.save().expect("it can be saved");
        let mut second = world("ramps.osm", 4000.0, 1, threads);
        second.restore(&saved).expect("it fits");
        [&mut first, &mut second].into_iter().for_each(|it| steps(it, 400));
        assert_eq!(first.driver_parameters(), second.driver_parameters());
        hashes.extend([first.state_hash(), second.state_hash()]);
    }
    assert!(hashes.iter().all(|it| *it == hashes[0]), "{hashes:?}");
}

#[test]
fn an_older_checkpoint_takes_a_change_back() {
    let mut world = world("ramps.osm", 4000.0, 1, 1);
    steps(&mut world, 300);
    let saved = world.save().expect("it can be saved");
    steps(&mut world, 300);
    let expected = world.state_hash();
    set(&mut world, Parameter::SpeedFactor, 0.5);
    world.step();
    world.restore(&saved).expect("it fits");
    assert_eq!(world.driver_parameters(), styles());
    steps(&mut world, 300);
    assert_eq!(world.state_hash(), expected);
}

#[test]
fn a_number_that_the_style_cannot_have_is_refused_with_a_remedy() {
    let mut world = world("ramps.osm", 0.0, 1, 1);
    let refused = [
        ("nobody", Parameter::Theta, 1.0, "there is no style nobody; known are aggressive, conservative"),
        (
            STYLE,
            Parameter::TimeGap,
            0.0,
            "follow.time_gap of style conservative cannot be 0: choose 0.1 to 10 s",
        ),
        (STYLE, Parameter::Theta, f64::NAN, "cannot be NaN: choose a finite number"),
        (
            STYLE,
            Parameter::Coolness,
            0.5,
            "its model has no such number; choose one of follow.acceleration, follow",
        ),
        (STYLE, Parameter::Politeness, 0.5, "choose one of change.speed.weight, change.route.weight"),
        (STYLE, Parameter::Sigma, 0.0, "a logit rule without choice noise; give sigma a value above 0"),
    ];
    for (style, parameter, value, part) in refused {
        let command = Command::SetParameter { style: style.into(), parameter, value };
        let text = world.command(command).expect_err(part).to_string();
        assert!(text.contains(part), "{text}");
    }
    set(&mut world, Parameter::Theta, 0.3);
    let again = Command::SetParameter { style: STYLE.into(), parameter: Parameter::Theta, value: 0.4 };
    assert!(matches!(world.command(again), Err(CommandError::Twice(_))));
}
