//! Commands of users: what they do, and which are refused.

use laneweave_network::{Id, LightState};
use laneweave_sim::{
    Class, Command, CommandError, Control, Event, FIRST_INSERTED, Headways, Lateral, Longitudinal,
    NewVehicle, Setup, VehicleId, World,
};

use crate::external::lanes::{alone, insert};
use crate::external::worlds::world;

fn accelerate(id: VehicleId, value: f64) -> Command {
    let longitudinal = Longitudinal::Acceleration(value);
    Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Driver })
}

#[test]
fn an_inserted_vehicle_is_on_the_road_at_once_and_a_removed_one_after_the_next_step() {
    let (mut world, id) = alone();
    assert_eq!(world.vehicle(id).map(|it| it.x()), Some(150.0));
    assert_eq!((world.counts().entered, world.on_road()), (1, 1));
    world.step();
    assert_eq!((world.counts().inserted, world.events()), (1, &[Event::Entered(id)][..]));
    world.command(Command::Remove(id)).expect("it is possible");
    assert!(world.vehicle(id).is_some());
    world.step();
    assert!(world.vehicle(id).is_none());
    assert!(matches!(world.events(), [Event::Removed { vehicle, .. }] if *vehicle == id));
    assert_eq!((world.counts().removed, world.counts().left, world.on_road()), (1, 0, 0));
}

#[test]
fn the_order_of_commands_between_two_steps_changes_nothing() {
    let run = |is_reversed: bool| {
        let mut world = world("ramps.osm", 4000.0, 5, 1);
        (0..600).for_each(|_| world.step());
        let ids: Vec<VehicleId> = world.vehicles().map(|it| it.id()).collect();
        let mut commands: Vec<Command> = ids.iter().map(|it| accelerate(*it, -1.0)).collect();
        commands.extend(ids.iter().map(|it| Command::SetStyle(*it, "aggressive".into())));
        if is_reversed {
            commands.reverse();
        }
        for command in commands {
            world.command(command).expect("it is possible");
        }
        world.step();
        let done = world.commands().to_vec();
        (0..600).for_each(|_| world.step());
        (done, world.state_hash())
    };
    assert_eq!(run(false), run(true));
}

#[test]
fn a_driver_takes_another_style_and_another_destination() {
    let mut world = world("ramps.osm", 0.0, 1, 1);
    let id = insert(&mut world, 1, 150.0, 20.0);
    let exits: Vec<Id> = world.demand().destinations.iter().map(|it| it.id()).collect();
    assert!(exits.len() > 1);
    world.command(Command::SetStyle(id, "aggressive".into())).expect("it is possible");
    world.step();
    assert_eq!(world.vehicle(id).map(|it| it.style().name.clone()), Some("aggressive".into()));
    let before = world.state_hash();
    for exit in exits {
        let mut copy = crate::external::worlds::world("ramps.osm", 0.0, 1, 1);
        copy.restore(&world.save().expect("it can be saved")).expect("it fits");
        assert_eq!(copy.state_hash(), before);
        copy.command(Command::SetDestination(id, Some(exit))).expect("a route leads there");
        let last = loop {
            copy.step();
            let left = copy.events().iter().find_map(|it| match it {
                Event::Left { vehicle, chain, .. } if *vehicle == id => Some(*chain),
                _ => None,
            });
            if let Some(chain) = left {
                break chain;
            }
        };
        let gate = copy.network().exits.iter().find(|it| it.id == exit).expect("there is one");
        assert!(gate.chains.contains(&last), "it left by exit {exit}");
    }
}

#[test]
fn a_demand_holds_from_the_command_on() {
    let mut world = world("motorway_3_lanes.osm", 3600.0, 1, 1);
    let origin = world.demand().origins[0].place.id();
    let mut arrived = |per_hour: Option<f64>| {
        if let Some(vehicles_per_hour) = per_hour {
            world.command(Command::SetDemand { origin, vehicles_per_hour }).expect("it is possible");
        }
        let before = world.arrived();
        (0..6000).for_each(|_| world.step());
        world.arrived() - before
    };
    let [usual, none, half] = [None, Some(0.0), Some(1800.0)].map(&mut arrived);
    assert!((540..660).contains(&usual) && none == 0 && (250..350).contains(&half), "{usual} {none} {half}");
}

#[test]
fn a_share_holds_for_those_who_arrive_from_the_command_on() {
    let mut world = world("motorway_3_lanes.osm", 3600.0, 1, 1);
    let mut share = |style: &str, weight| {
        world.command(Command::SetShare { style: style.into(), weight }).expect("it is possible");
        let begin = world.clock().time();
        let (mut named, mut all) = (0, 0);
        for _ in 0..6000 {
            world.step();
            for event in world.events() {
                if let Event::Entered(id) = event
                    && world.trip(*id).is_none_or(|it| it.arrived >= begin)
                {
                    all += 1;
                    named += usize::from(world.vehicle(*id).is_some_and(|it| it.style().name == style));
                }
            }
        }
        named as f64 / all as f64
    };
    // The other style has the weight 0.7.
    assert!(share("aggressive", 0.0) < 0.01);
    let more = share("aggressive", 2.1);
    assert!((0.69..0.81).contains(&more), "{more}");
}

#[test]
fn the_last_style_keeps_a_weight() {
    let mut world = world("motorway_3_lanes.osm", 3600.0, 1, 1);
    let mut none = |style: &str| world.command(Command::SetShare { style: style.into(), weight: 0.0 });
    assert_eq!(none("aggressive"), Ok(None));
    assert_eq!(none("conservative"), Err(CommandError::NoStyle));
    let saved = {
        world.step();
        world.save().expect("a state")
    };
    world.restore(&saved).expect("its own state");
    assert_eq!(world.style_weights(), [0.0, 0.7]);
}

#[test]
fn a_demand_that_the_headways_cannot_have_is_refused() {
    let network = crate::roads::network("motorway_3_lanes.osm");
    let mut demand = crate::roads::drivers::demand(&network, 1000.0, 0.1, &[1.0, 1.0]);
    demand.headways = Headways::Shifted { minimum: 1.5 };
    let origin = demand.origins[0].place.id();
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    let mut world =
        World::new(network, crate::external::worlds::styles(), demand, setup).expect("it makes sense");
    let mut set = |vehicles_per_hour| world.command(Command::SetDemand { origin, vehicles_per_hour });
    // Three lanes take at most 3 × 3600 / 1.5 = 7200 vehicles per hour.
    assert_eq!(set(7300.0).map_err(|it| matches!(it, CommandError::Headways(_))), Err(true));
    assert_eq!(set(7000.0), Ok(None));
    (0..600).for_each(|_| world.step());
}

#[test]
fn a_light_shows_what_the_user_says() {
    let mut world = world("grid.osm", 0.0, 1, 1);
    let lights = world.network().junctions.lights.clone();
    let light = lights[0].id;
    for shows in [LightState::Red, LightState::Green] {
        world.command(Command::SetLight { light, shows: Some(shows) }).expect("it is possible");
        for _ in 0..900 {
            world.step();
            assert_eq!(world.scene().light(laneweave_network::LightIndex(0)), shows);
        }
    }
    world.command(Command::SetLight { light, shows: None }).expect("it is possible");
    let mut seen = Vec::new();
    for _ in 0..900 {
        world.step();
        seen.push(world.scene().light(laneweave_network::LightIndex(0)));
    }
    assert!(seen.contains(&LightState::Red) && seen.contains(&LightState::Green));
}

#[test]
fn a_plan_comes_to_another_offset_by_longer_phases() {
    let mut world = world("grid.osm", 0.0, 1, 1);
    let lights = world.network().junctions.lights.clone();
    let first = lights[0].plan.expect("it has a plan").first;
    let of_plan = |it: &laneweave_network::Light| it.plan.is_some_and(|it| it.first == first);
    let light = lights[0].id;
    (0..73).for_each(|_| world.step());
    world.command(Command::SetOffset { light, offset_s: 25.0 }).expect("it is possible");
    assert!(matches!(
        world.command(Command::SetOffset { light, offset_s: 5.0 }),
        Err(CommandError::Twice(_))
    ));
    let cycle = lights[0].program.cycle;
    // By 25 s at a fifth of a second a second.
    let arrives = 7.3 + 25.0 / 0.2;
    let shown = |world: &World, at| world.scene().light(laneweave_network::LightIndex(at as u32));
    let mut lasted: Vec<_> = (0..lights.len()).map(|at| (shown(&world, at), f64::INFINITY)).collect();
    while world.clock().time() < arrives + 2.0 * cycle {
        world.step();
        let time = world.clock().time();
        for (at, light) in lights.iter().enumerate() {
            let shows = shown(&world, at);
            let expected = if of_plan(light) { time - 25.0 } else { time };
            // Sums of steps are not exact where a light switches.
            let is_near = [-0.11, 0.11].iter().any(|it| light.program.state(expected + it) == shows);
            assert!(is_near || (of_plan(light) && time < arrives + 0.2), "{} at {time} s", light.id);
            let (before, since) = &mut lasted[at];
            if *before != shows {
                assert!(*before != LightState::Green || shows == LightState::Yellow);
                assert!(*before != LightState::Yellow || *since > 2.85, "yellow of {since} s");
                (*before, *since) = (shows, 0.0);
            }
            *since += 0.1;
        }
    }
}

#[test]
fn impossible_commands_are_refused_with_a_remedy_and_change_nothing() {
    let (mut world, id) = alone();
    let lanelet = world.network().lanelets[0].id;
    let vehicle = NewVehicle {
        lanelet,
        position_m: 50.0,
        speed_mps: 20.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
    };
    let insert = |change: fn(&mut NewVehicle)| {
        let mut changed = vehicle.clone();
        change(&mut changed);
        Command::Insert(changed)
    };
    let refused = [
        (Command::Remove(77), "vehicle 77 is not on the road"),
        (accelerate(id, f64::NAN), "an acceleration of NaN: choose -8 to 8 m/s²"),
        (accelerate(id, 20.0), "an acceleration of 20: choose -8 to 8 m/s²"),
        (
            Command::SetStyle(id, "agressive".into()),
            "there is no style agressive; known are aggressive, conservative",
        ),
        (Command::SetDestination(id, Some(Id::from(-5))), "there is no destination -5; known are"),
        (Command::SetLight { light: 3.into(), shows: None }, "there is no light 3; this world has no light"),
        (
            Command::SetOffset { light: 3.into(), offset_s: 1.0 },
            "there is no light 3; this world has no light",
        ),
        (
            Command::SetDemand { origin: Id::from(-5), vehicles_per_hour: 3.0 },
            "there is no origin -5; known are",
        ),
        (insert(|it| it.lanelet = Id::from(-7)), "there is no lanelet -7"),
        (insert(|it| it.position_m = 1e6), "choose 0 to"),
        (insert(|it| it.position_m = f64::NAN), "choose 0 to"),
        (insert(|it| it.speed_mps = -1.0), "a speed of -1: choose 0 to"),
        (insert(|it| it.style = "nobody".into()), "there is no style nobody"),
    ];
    for (command, part) in refused {
        let text = world.command(command).expect_err(part).to_string();
        assert!(text.contains(part), "{text}");
    }
    world.command(accelerate(id, 1.0)).expect("it is possible");
    assert!(matches!(world.command(accelerate(id, 2.0)), Err(CommandError::Twice(_))));
    assert!(matches!(world.command(Command::Remove(id)), Err(CommandError::Twice(_))));
    world.step();
    assert_eq!(world.commands().len(), 2, "the first vehicle, and its control");
    world.command(Command::Remove(id)).expect("it is possible");
    assert_eq!(world.command(accelerate(id, 2.0)), Err(CommandError::Removed(id)));
    world.step();
    assert_eq!(world.command(accelerate(id, 2.0)), Err(CommandError::NoVehicle(id)));
    assert_eq!(world.on_road(), 0);
}

#[test]
fn a_vehicle_is_not_put_where_another_could_not_stay_clear_of_it() {
    let (world, _) = alone();
    let lanelet = {
        let vehicle = world.vehicles().next().expect("there is one");
        world.network().lanelet_at(laneweave_network::Position::new(vehicle.spot.chain, vehicle.x())).0.id
    };
    let put = |position_m: f64, speed_mps: f64| {
        let (mut world, _): (World, _) = alone();
        let style = "conservative".into();
        let new = NewVehicle { lanelet, position_m, speed_mps, class: Class::Car, style, destination: None };
        world.command(Command::Insert(new)).map_err(|it| it.to_string())
    };
    // The car stands from 145.5 to 150 m at 25 m/s.
    for (position_m, speed_mps) in [(150.0, 25.0), (147.0, 25.0), (145.4, 30.0), (152.0, 25.0), (160.0, 0.0)]
    {
        let refused = put(position_m, speed_mps).expect_err("it is too near");
        assert!(refused.contains(&format!("vehicle {FIRST_INSERTED} is too near")), "{refused}");
    }
    for (position_m, speed_mps) in [(100.0, 25.0), (130.0, 0.0), (195.0, 25.0)] {
        assert_eq!(put(position_m, speed_mps), Ok(Some(FIRST_INSERTED + 1)), "{position_m} m");
    }
}
