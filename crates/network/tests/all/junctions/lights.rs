//! Programs of lights: what they show when, and those that are made for lights without one.

use std::f64::consts::FRAC_PI_2;

use laneweave_network::{
    DrivingSide, Id, LaneletIndex, LightIndex, LightState, LightTraffic, Network, Phase, Point, Polyline,
    Position, Program, Regulations, SignalPlan, StopKind, StopRule, Turn,
};

use crate::junctions::drawn::{Lanes, arc, straight};

/// Distance of the lines from the middle of the junction [m], and of the lanes from the middle of the road [m].
const LINE: f64 = 12.0;
const BESIDE: f64 = 1.75;

/// Movements of a lane that comes to a junction.
#[derive(Clone, Copy)]
enum Movements {
    All,
    Straight,
}

/// A point turned around the middle of the junction by quarters.
fn turned(point: Point, quarters: usize) -> Point {
    (0..quarters).fold(point, |it, _| Point::new(-it.y, it.x, it.z))
}

/// A junction of four arms with a light at each: lanes 0 to 3 lead to it, from the west, south, east and north, lanes 4
/// to 7 away, and the others through it.
fn four_arms(movements: Movements) -> Network {
    let around = |line: &[Point], quarters: usize| line.iter().map(|it| turned(*it, quarters)).collect();
    let to = straight((-100.0, -BESIDE), (-LINE, -BESIDE));
    let away = straight((LINE, -BESIDE), (100.0, -BESIDE));
    let through = [
        straight((-LINE, -BESIDE), (LINE, -BESIDE)),
        arc((-LINE, LINE), LINE + BESIDE, -FRAC_PI_2, FRAC_PI_2),
        arc((-LINE, -LINE), LINE - BESIDE, FRAC_PI_2, -FRAC_PI_2),
    ];
    let count = match movements {
        Movements::All => 3,
        Movements::Straight => 1,
    };
    let mut lanes = Lanes::default();
    for quarter in 0..4 {
        let first = 8 + quarter as u32 * count;
        let following: Vec<u32> = (first..first + count).collect();
        lanes = lanes.with(around(&to, quarter), &following);
    }
    for quarter in 0..4 {
        lanes = lanes.with(around(&away, quarter), &[]);
    }
    for quarter in 0..4 {
        // Straight on, a quarter to the left, a quarter to the right.
        for (line, turn) in through.iter().zip([0, 1, 3]).take(count as usize) {
            lanes = lanes.with(around(line, quarter), &[4 + (quarter as u32 + turn) % 4]);
        }
    }
    let light = |arm: u32| StopRule {
        id: (100 + i64::from(arm)).into(),
        kind: StopKind::Light,
        lanelets: vec![LaneletIndex(arm)],
        lines: Vec::new(),
    };
    let regulations = Regulations { stops: (0..4).map(light).collect(), ..Regulations::default() };
    lanes.network(DrivingSide::Right).regulated(&regulations)
}

/// The plans for flows [veh/h] on the lanes from the west, south, east and north, from which everybody goes straight
/// on. A lane bears 1,800 veh/h.
fn plans(network: &Network, flows: [f64; 4]) -> Vec<SignalPlan> {
    let flow = |at: Position| match network.lanelet_at(at).0.id.number() {
        Some(lane @ 0..4) => flows[lane as usize] / 3600.0,
        way => flows[way.map_or(0, |it| it.max(8) as usize - 8)] / 3600.0,
    };
    network.lights().programs(&LightTraffic { flow: &flow, saturation: &|_| 0.5 })
}

/// The lights of each phase, in words.
fn phases(plan: &SignalPlan) -> Vec<String> {
    let word = |it: &LightIndex| ["west", "south", "east", "north"][it.at()];
    plan.turns.iter().map(|it| it.lights.iter().map(word).collect::<Vec<_>>().join(" ")).collect()
}

/// Moments of two cycles of at most 60 s, twenty a second.
fn moments() -> impl Iterator<Item = f64> {
    (0..2400).map(|it| f64::from(it) / 20.0)
}

fn program(phases: &[(f64, f64)]) -> Program {
    let phases = phases.iter().map(|(from, to)| Phase { from: *from, to: *to, yellow: 3.0 }).collect();
    Program { cycle: 60.0, phases }
}

/// Shortest time in which both lights are red between the yellow of one and the green of the other [s].
fn all_red(one: &Program, other: &Program) -> f64 {
    let ends = one.phases.iter().map(|it| it.to + it.yellow);
    let begins = || other.phases.iter().map(|it| it.from);
    ends.flat_map(|end| begins().map(move |begin| (begin - end).rem_euclid(one.cycle))).fold(60.0, f64::min)
}

#[test]
fn opposing_approaches_are_green_together_and_turns_across_them_are_permitted() {
    for movements in [Movements::All, Movements::Straight] {
        let junctions = four_arms(movements).junctions;
        let ids: Vec<Id> = junctions.lights.iter().map(|it| it.id).collect();
        assert_eq!(ids, [100, 101, 102, 103]);
        let [plan] = &junctions.made[..] else { panic!("{:?}", junctions.made) };
        assert_eq!(phases(plan), ["west east", "south north"]);
        assert_eq!(plan.turns[0].green, plan.turns[1].green);
        let [west, south, east, north] = &junctions.lights[..] else { panic!() };
        assert_eq!((&west.program, &south.program), (&east.program, &north.program));
    }
}

#[test]
fn cycle_and_greens_are_those_of_webster() {
    // 16.7 m from the line to the end of the last zone, at 8 m/s: an all-red time of 2.1 s after 3 s of yellow.
    let lost = 2.0 * (3.0 + 2.1);
    let network = four_arms(Movements::Straight);
    for [west, south] in [[900.0, 450.0], [450.0, 450.0], [700.0, 500.0], [1000.0, 300.0]] {
        // The critical lanes are those with more traffic.
        let [plan] = &plans(&network, [west, south, 0.5 * west, 0.1 * south])[..] else { panic!() };
        let ratios = [west, south].map(|it| it / 1800.0);
        let sum: f64 = ratios.iter().sum();
        let cycle = 2.0 * (0.5 * ((1.5 * lost + 5.0) / (1.0 - sum)).clamp(40.0, 120.0)).ceil();
        assert!((plan.cycle() - cycle).abs() < 1e-9, "{} s, not {cycle} s", plan.cycle());
        for (turn, ratio) in plan.turns.iter().zip(ratios) {
            assert_eq!((turn.yellow, turn.all_red), (3.0, 2.1));
            let green = (cycle - lost) * ratio / sum;
            assert!((turn.green - green).abs() <= 0.05 + 1e-9, "{} s, not {green} s", turn.green);
        }
    }
}

#[test]
fn no_green_is_shorter_than_five_seconds_and_no_cycle_longer_than_two_minutes() {
    let network = four_arms(Movements::Straight);
    let [plan] = &plans(&network, [900.0, 10.0, 900.0, 10.0])[..] else { panic!() };
    assert_eq!(plan.turns[1].green, 5.0);
    let [plan] = &plans(&network, [1700.0, 900.0, 1700.0, 900.0])[..] else { panic!() };
    assert!((plan.cycle() - 120.0).abs() < 1e-9);
    let share = plan.turns[0].green / (plan.turns[0].green + plan.turns[1].green);
    assert!((share - 17.0 / 26.0).abs() < 1e-3, "{share}");
    let [plan] = &plans(&network, [0.0; 4])[..] else { panic!() };
    assert_eq!(plan.turns[0].green, plan.turns[1].green);
}

#[test]
fn conflicting_lights_never_let_anybody_go_at_once_and_leave_time_to_clear() {
    // From the line to the end of the junction, where lanes merge; to the further lane across, and 2.70 m.
    for (movements, clearance) in [(Movements::All, 24.0), (Movements::Straight, LINE + BESIDE + 2.7)] {
        let lights = four_arms(movements).junctions.lights;
        for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))).filter(|(a, b)| (a + b) % 2 == 1) {
            let [one, other] = [a, b].map(|it| &lights[it].program);
            let is_let = |program: &Program, at: f64| program.state(at) != LightState::Red;
            let both = moments().find(|at| is_let(one, *at) && is_let(other, *at));
            assert_eq!(both, None, "lights {a} and {b}");
            let pause = all_red(one, other);
            assert!(pause >= f64::max(2.0, clearance / 8.0) - 1e-9, "{pause} s between {a} and {b}");
        }
        for light in &lights {
            assert!(light.program.green_share() > 0.1);
            assert!(moments().any(|at| light.program.state(at) == LightState::Green));
        }
    }
}

/// A street to the east with lights at two junctions 300 m from each other, at each of which a lane crosses from the
/// south. Lanes 0 and 1 lead to the lights of the street, 2 and 3 to those of the others.
fn street() -> Network {
    let mut lanes = Lanes::default();
    for (from, to, next) in [(-200.0, -10.0, 4), (10.0, 290.0, 5)] {
        lanes = lanes.with(straight((from, 0.0), (to, 0.0)), &[next]);
    }
    for (x, next) in [(0.0, 6), (300.0, 7)] {
        lanes = lanes.with(straight((x, -200.0), (x, -10.0)), &[next]);
    }
    lanes = lanes.with(straight((-10.0, 0.0), (10.0, 0.0)), &[1]);
    lanes = lanes.with(straight((290.0, 0.0), (500.0, 0.0)), &[]);
    for x in [0.0, 300.0] {
        lanes = lanes.with(straight((x, -10.0), (x, 200.0)), &[]);
    }
    let light = |lane: u32| StopRule {
        id: (100 + i64::from(lane)).into(),
        kind: StopKind::Light,
        lanelets: vec![LaneletIndex(lane)],
        lines: Vec::new(),
    };
    let regulations = Regulations { stops: (0..4).map(light).collect(), ..Regulations::default() };
    lanes.network(DrivingSide::Right).regulated(&regulations)
}

#[test]
fn along_a_street_a_platoon_meets_green_at_the_next_light() {
    let network = street();
    for along in [200.0, 500.0, 800.0] {
        let flow = |at: Position| match network.lanelet_at(at).0.id.number() {
            Some(0 | 1 | 4 | 5) => along / 3600.0,
            _ => 200.0 / 3600.0,
        };
        let plans = network.lights().programs(&LightTraffic { flow: &flow, saturation: &|_| 0.5 });
        assert_eq!(plans.len(), 2);
        let cycle = plans[0].cycle();
        assert!((plans[1].cycle() - cycle).abs() < 1e-9);
        let green = |light: u32| {
            let program = plans.iter().find(|it| it.lights().any(|of| of.at() == light as usize)).unwrap();
            program.program(LightIndex(light)).phases[0]
        };
        let (first, second) = (green(0), green(1));
        // The platoon leaves while its light is green and the queue lasts, and drives 300 m at 50 km/h from rest.
        let ratio = along / 1800.0;
        let leaves = (first.to - first.from) * (ratio * cycle / (first.to - first.from)).min(1.0);
        let drives = 1.0 + 0.5 * (50.0 / 3.6) / 1.5 + 300.0 / (50.0 / 3.6);
        for part in [0.1, 0.5, 0.9] {
            let since = (first.from + part * leaves + drives - second.from).rem_euclid(cycle);
            assert!(since < second.to - second.from, "{along} veh/h: {part} of the platoon waits");
        }
    }
}

#[test]
fn a_light_on_its_own_stays_green() {
    let lanes = Lanes::default().with(straight((0.0, 0.0), (100.0, 0.0)), &[]);
    let stops = vec![StopRule {
        id: 7.into(),
        kind: StopKind::Light,
        lanelets: vec![LaneletIndex(0)],
        lines: Vec::new(),
    }];
    let junctions = lanes.junctions(&Regulations { stops, ..Regulations::default() });
    assert_eq!(junctions.lights[0].program, Program::ALWAYS_GREEN);
    assert!(moments().all(|at| junctions.lights[0].program.state(at) == LightState::Green));
    assert_eq!(junctions.lights[0].program.green_share(), 1.0);
}

#[test]
fn a_program_changes_at_the_moments_that_it_names_and_repeats() {
    use LightState::{Green, Red, Yellow};
    let once = program(&[(10.0, 30.0)]);
    let states = [9.999, 10.0, 29.999, 30.0, 32.999, 33.0, 59.999, 60.0, 70.0].map(|at| once.state(at));
    assert_eq!(states, [Red, Green, Green, Yellow, Yellow, Red, Red, Red, Green]);
    assert_eq!(once.state(-31.0), Green);
    assert_eq!(once.state(6.0e6 + 10.0), Green);
    assert!((once.green_share() - 1.0 / 3.0).abs() < 1e-15);
}

#[test]
fn the_yellow_of_a_green_at_the_end_of_a_cycle_reaches_into_the_next() {
    use LightState::{Green, Red, Yellow};
    let last = program(&[(0.5, 20.0), (40.0, 58.0)]);
    // Green comes before the yellow of another phase.
    let states = [39.0, 57.999, 58.0, 60.0, 60.499, 60.5, 80.0, 83.0].map(|at| last.state(at));
    assert_eq!(states, [Red, Green, Yellow, Yellow, Yellow, Green, Yellow, Red]);
}

#[test]
fn a_light_shows_the_same_until_a_phase_or_its_yellow_begins_or_ends() {
    let last = program(&[(0.5, 20.0), (40.0, 58.0)]);
    assert_eq!([39.0, 40.0, 58.5, 20.25, 62.0].map(|at| last.steady_for(at)), [1.0, 0.0, 2.0, 2.75, 18.0]);
    for time in (0..1200).map(|it| 0.1 * f64::from(it)) {
        let steady = last.steady_for(time);
        assert!(
            [0.001, 0.5, 0.999].iter().all(|it| last.state(time + it * steady) == last.state(time + 1e-9)),
            "{time}"
        );
    }
    assert_eq!(Program::ALWAYS_GREEN.steady_for(7.0), f64::INFINITY);
}

#[test]
fn a_light_stays_green_through_turns_that_follow_on_each_other_also_over_the_end_of_the_cycle() {
    let turn = |lights: &[u32]| Turn {
        lights: lights.iter().map(|it| LightIndex(*it)).collect(),
        green: 10.0,
        extension: None,
        yellow: 4.0,
        all_red: 1.0,
    };
    let plan =
        SignalPlan { offset: 7.0, turns: vec![turn(&[0, 1]), turn(&[1, 3]), turn(&[2, 3]), turn(&[0, 3])] };
    assert_eq!(plan.cycle(), 60.0);
    let phase = |from: f64, to: f64| Program { cycle: 60.0, phases: vec![Phase { from, to, yellow: 4.0 }] };
    let expected = [phase(52.0, 77.0), phase(7.0, 32.0), phase(37.0, 47.0), phase(22.0, 62.0)];
    assert_eq!([0, 1, 2, 3].map(|it| plan.program(LightIndex(it))), expected);
    let always = SignalPlan { offset: 0.0, turns: vec![turn(&[0]), turn(&[0, 1])] };
    assert_eq!(always.program(LightIndex(0)), Program::ALWAYS_GREEN);
    assert_eq!(always.program(LightIndex(1)).green_share(), 1.0 / 3.0);
}

#[test]
fn drivers_stop_at_the_first_place_where_a_line_cuts_their_way() {
    let point = |x: f64, y: f64| Point::new(x, y, 0.0);
    let way = Polyline::new([point(0.0, 0.0), point(10.0, 0.0), point(10.0, 10.0), point(0.0, 10.0)])
        .expect("the line has a length");
    // The line of two pieces cuts the path at 25 m, then at 5 m.
    let bent = [point(5.0, 12.0), point(5.0, 6.0), point(5.0, -1.0)];
    assert_eq!(way.crossed_by(&bent), Some(5.0));
    // Through a corner, along the path, and in one point only.
    assert_eq!(way.crossed_by(&[point(9.0, -1.0), point(11.0, 1.0)]), Some(10.0));
    assert_eq!(way.crossed_by(&[point(2.0, 0.0), point(8.0, 0.0)]), None);
    assert_eq!(way.crossed_by(&[point(4.0, 0.0), point(4.0, 2.0)]), Some(4.0));
    assert_eq!(way.crossed_by(&[point(4.0, 1.0)]), None);
    assert_eq!(way.crossed_by(&[]), None);
}
