//! Drivers change lanes never without a reason, soon with a reason, and not back and forth.

use crate::roads::{Road, drivers};
use laneweave_models::Style;
use laneweave_models::change::{
    Comfort, ConstantHazard, Courtesy, Keeping, LaneChangeModel, Mcdm, Route, Rule, Speed, Urgency,
};
use laneweave_models::follow::{FollowingModel, Fvdm, Pace};
use laneweave_models::{Manner, Reading};
use laneweave_network::{ChainIndex, LaneUse, Network};
use laneweave_sim::{Class, Event, LaneChange, Phase, Placement, Setup, World};

/// Length of a car [m].
const LENGTH: f64 = 4.5;

fn mcdm(style: &Style) -> Mcdm {
    let LaneChangeModel::Mcdm(mcdm) = &style.change else { unreachable!() };
    mcdm.clone()
}

fn with_change(style: Style, change: LaneChangeModel) -> Style {
    Style { change, ..style }
}

/// The style with no weight on any incentive.
fn indifferent(style: Style) -> Style {
    let bare = Mcdm {
        speed: Speed { weight: 0.0, ..Speed::default() },
        route: Route { weight: 0.0, ..Route::default() },
        comfort: Comfort { weight: 0.0, ..Comfort::default() },
        courtesy: Courtesy { weight: 0.0, ..Courtesy::default() },
        urgency: Urgency { weight: 0.0 },
        ..mcdm(&style)
    };
    with_change(style, LaneChangeModel::Mcdm(bare))
}

fn threshold(style: Style, theta: f64) -> Style {
    let change = LaneChangeModel::Mcdm(Mcdm { rule: Rule::Threshold, theta, ..mcdm(&style) });
    with_change(style, change)
}

/// The style with a null model, which changes lanes at random.
fn coin(style: Style, hazard: f64) -> Style {
    with_change(style, LaneChangeModel::ConstantHazard(ConstantHazard { hazard }))
}

/// Ten minutes on a motorway of two lanes with 2,400 veh/h, trucks included. Returns the world at the end, and the
/// changes.
fn motorway(styles: Vec<Style>, seed: u64) -> (World, Vec<LaneChange>) {
    let network = Road { lanes: 2, length: 4000.0, ..Road::default() }.network();
    let demand = drivers::demand(&network, 2400.0, 0.1, &[0.3, 0.7]);
    let mut world = World::new(network, styles, demand, Setup { step: 0.1, seed, threads: 1 })
        .expect("the set-up makes sense");
    let mut changes = Vec::new();
    for _ in 0..6000 {
        world.step();
        changes.extend(world.events().iter().filter_map(|event| match event {
            Event::LaneChange(change) => Some(*change),
            _ => None,
        }));
    }
    (world, changes)
}

fn both() -> [Style; 2] {
    [drivers::aggressive(), drivers::conservative()]
}

#[test]
fn v36_without_weights_the_threshold_rule_never_changes() {
    let (world, changes) = motorway(both().map(|it| threshold(indifferent(it), 0.01)).to_vec(), 1);
    assert!(world.counts().left > 100);
    assert_eq!(changes, []);
}

#[test]
fn v36_without_weights_the_stochastic_rule_is_a_coin_that_hardly_ever_falls() {
    // h(G = 0) = 1/(1 + exp(θ/σ)) with θ = 8 σ.
    let hazard = 1.0 / (1.0 + (0.112_f64 / 0.014).exp());
    let (indifferent, changes) = motorway(both().map(indifferent).to_vec(), 1);
    let (coins, _) = motorway(both().map(|it| coin(it, hazard)).to_vec(), 1);
    assert_eq!(indifferent.state_hash(), coins.state_hash());
    let per_vehicle_km = changes.len() as f64 / (indifferent.counters().distance / 1000.0);
    assert!(per_vehicle_km < 0.02 && !changes.is_empty(), "{per_vehicle_km}");
}

#[test]
fn v37_identical_drivers_in_equilibrium_on_equal_lanes_feel_no_desire() {
    const CARS: usize = 30;
    const SPEED: f64 = 25.0;
    let literal = |style: Style| {
        let reading = Reading::Literal;
        let table = mcdm(&style);
        let change = LaneChangeModel::Mcdm(Mcdm {
            speed: Speed { reading, ..table.speed },
            courtesy: Courtesy { reading, ..table.courtesy },
            ..table
        });
        with_change(style, change)
    };
    for style in both().into_iter().flat_map(|it| [literal(it.clone()), it]) {
        let limit = 120.0 / 3.6;
        let desired = f64::from((limit * style.speed_factor) as f32);
        let spacing = style.follow.equilibrium_gap(Pace::new(SPEED, desired)) + LENGTH;
        // How far ahead the cars of the fast lane are, as a share of the spacing.
        for ahead in [0.0, 0.1, 0.5, 0.9] {
            let road =
                Road { lanes: 2, length: CARS as f64 * spacing, limit, is_ring: true, ..Road::default() };
            let network = road.network();
            let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
            let setup = Setup { step: 0.1, seed: 1, threads: 1 };
            let mut world = World::new(network, vec![threshold(style.clone(), 0.0)], nobody, setup).unwrap();
            for number in 0..2 * CARS {
                world
                    .place(Placement {
                        chain: ChainIndex((number % 2) as u32),
                        x: ((number / 2) as f64 + if number % 2 == 1 { ahead } else { 0.0 }) * spacing + 1.0,
                        speed: SPEED,
                        class: Class::Car,
                        parameters: 0,
                        destination: None,
                    })
                    .expect("it fits on the road");
            }
            for _ in 0..1000 {
                world.step();
                assert!(world.vehicles().all(|it| it.driver.phase == Phase::Cruises));
            }
            assert!(world.counters().considerations >= 100 * 2 * CARS as u64);
        }
    }
}

/// The style with the wish for the slow side alone: beside a free slow lane G is `gain` for as long as it lasts.
fn drawn_to_the_slow_side(style: Style, gain: f64, theta: f64, sigma: f64) -> Style {
    let keeping = Keeping { weight: gain, ..Keeping::default() };
    let bare = mcdm(&indifferent(style.clone()));
    with_change(style, LaneChangeModel::Mcdm(Mcdm { keeping, theta, sigma, ..bare }))
}

/// Cars on the fast lane, each beside a free gap of the slow lane that law and `style` want it to take.
fn beside_free_gaps(style: Style, cars: u32, step: f64) -> World {
    const SPACING: f64 = 80.0;
    const SPEED: f64 = 20.0;
    let road = Road { lanes: 2, length: f64::from(cars) * SPACING + 4000.0, limit: SPEED, ..Road::default() };
    let mut network = road.network();
    network.law.lane_use = LaneUse::SlowSide;
    let starts = chains_from(&network, ChainIndex(1));
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let setup = Setup { step, seed: 3, threads: 1 };
    let mut world = World::new(network, vec![style], nobody, setup).expect("the set-up makes sense");
    for number in 0..cars {
        let x = f64::from(number) * SPACING + LENGTH;
        let (chain, start) = *starts.iter().rev().find(|(_, start)| *start < x).expect("it is on the road");
        let (class, destination) = (Class::Car, Some(0));
        let car = Placement { chain, x: x - start, speed: SPEED, class, parameters: 0, destination };
        world.place(car).expect("it fits on the road");
    }
    world
}

#[test]
fn v39_times_to_a_change_for_a_constant_gain_are_geometric_whatever_the_step() {
    const CARS: u32 = 5_000;
    let (gain, theta, sigma) = (0.08, 0.11, 0.0125);
    // In every epoch of 1 s.
    let hazard = 1.0 / (1.0 + f64::exp((theta - gain) / sigma));
    let style = drawn_to_the_slow_side(drivers::conservative(), gain, theta, sigma);
    // The step [s], and the epoch, which is a whole number of steps [s].
    for (step, epoch) in [(0.1, 1.0), (0.3, 0.9), (0.5, 1.0), (1.0, 1.0)] {
        let mut world = beside_free_gaps(style.clone(), CARS, step);
        let steps_per_epoch = world.clock().steps(1.0);
        let mut epochs = vec![0_u32; CARS as usize];
        // A driver who wants to change goes in the next step.
        world.step();
        for number in 0..(120.0 / step) as u32 {
            world.step();
            for change in world.vehicles().filter(|it| it.driver.phase == Phase::Changes) {
                let first = &mut epochs[change.id() as usize];
                *first = if *first == 0 { number / steps_per_epoch + 1 } else { *first };
            }
        }
        assert!(epochs.iter().all(|it| *it > 0));
        let mean = epoch * epochs.iter().sum::<u32>() as f64 / f64::from(CARS);
        // The mean of a geometric time of whole epochs.
        let expected = epoch / (1.0 - (1.0 - hazard).powf(epoch));
        assert!((mean - expected).abs() < 0.03 * expected, "step {step}: {mean} s of {expected} s");
        for waited in [3, 10, 30] {
            let share = epochs.iter().filter(|it| **it > waited).count() as f64 / f64::from(CARS);
            let survival = (1.0 - hazard).powf(epoch * f64::from(waited));
            let error = (survival * (1.0 - survival) / f64::from(CARS)).sqrt();
            assert!((share - survival).abs() < 3.0 * error, "step {step}: {share} after {waited} epochs");
        }
    }
}

/// The chains of the lane that begins with the chain `first`, each with its start along the road [m].
fn chains_from(network: &Network, first: ChainIndex) -> Vec<(ChainIndex, f64)> {
    let (mut chain, mut start, mut all) = (Some(first), 0.0, Vec::new());
    while let Some(index) = chain {
        all.push((index, start));
        start += network.chain(index).length;
        chain = network.chain(index).following.first().copied();
    }
    all
}

#[test]
fn v48_nobody_changes_again_by_choice_while_calm() {
    let restless = both().map(|it| coin(it, 0.9)).to_vec();
    for (styles, is_restless) in [(both().to_vec(), false), (restless, true)] {
        let calm = Manner::default().calm;
        let (_, changes) = motorway(styles, 2);
        let mut ends = std::collections::BTreeMap::new();
        let mut shortest = f64::INFINITY;
        for change in &changes {
            if let Some(end) = ends.insert(change.vehicle, change.started + change.duration) {
                shortest = shortest.min(change.started - end);
            }
        }
        assert!(changes.len() > 50);
        assert!(shortest > calm - 1e-9, "{shortest} s");
        // Only the cooldown keeps these drivers from another change.
        assert!(!is_restless || shortest < calm + 0.5, "{shortest} s");
    }
}

/// A driver who keeps its speed behind any leader.
fn unyielding() -> Style {
    let follow = Fvdm { sensitivity: 0.0, relative_sensitivity: 0.0, ..Fvdm::default() };
    threshold(indifferent(Style { follow: FollowingModel::Fvdm(follow), ..drivers::conservative() }), 1.0)
}

/// Speed of the slow leader [m/s].
const SLOW: f64 = 8.0;

/// A driver of `style`, number 0, in equilibrium behind number 1, which drives 8 m/s, on a road of `lanes`.
fn held_up(style: Style, lanes: usize, seed: u64) -> World {
    let network = Road { lanes, length: 2500.0, ..Road::default() }.network();
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let desired = network.chain(ChainIndex(0)).limit(0.0) * style.speed_factor;
    let gap = style.follow.equilibrium_gap(Pace::new(SLOW, desired));
    let setup = Setup { step: 0.1, seed, threads: 1 };
    let mut world =
        World::new(network, vec![style, unyielding()], nobody, setup).expect("the set-up makes sense");
    put(&mut world, 0, 300.0, SLOW, 0);
    put(&mut world, 0, 300.0 + gap + LENGTH, SLOW, 1);
    world
}

fn put(world: &mut World, lane: u32, x: f64, speed: f64, parameters: u32) {
    let (chain, class, destination) = (ChainIndex(lane), Class::Car, Some(0));
    world.place(Placement { chain, x, speed, class, parameters, destination }).expect("it fits on the road");
}

fn phase_of_the_first(world: &World) -> Phase {
    world.vehicles().find(|it| it.id() == 0).expect("it is on the road").driver.phase
}

#[test]
fn v49_a_driver_behind_a_slow_leader_takes_the_free_lane() {
    const SEEDS: u64 = 1000;
    for style in both() {
        let has_changed = |seed| {
            let mut world = held_up(style.clone(), 2, seed);
            (0..200).for_each(|_| world.step());
            world.counts().discretionary_changes > 0
        };
        let share = (0..SEEDS).filter(|seed| has_changed(*seed)).count() as f64 / SEEDS as f64;
        assert!(share >= 0.95, "{}: {share}", style.name);
    }
}

#[test]
fn v49_without_a_lane_beside_nobody_wants_to_change() {
    for style in both() {
        let mut world = held_up(style, 1, 1);
        for _ in 0..1200 {
            world.step();
            assert_eq!(phase_of_the_first(&world), Phase::Cruises);
        }
        assert!(world.counters().considerations > 200);
    }
}

#[test]
fn v49_a_driver_waits_while_the_gap_is_blocked_and_changes_when_it_opens() {
    const SEEDS: u64 = 200;
    const BLOCKERS: u32 = 12;
    const PASSING: f64 = 13.0;
    /// From front to front [m]: a car between two of them has no more than a metre in front and behind.
    const SPACING: f64 = 2.0 * LENGTH + 2.0;
    for style in both() {
        let (mut waited, mut changed) = (0, 0);
        for seed in 0..SEEDS {
            let mut world = held_up(style.clone(), 2, seed);
            (0..BLOCKERS)
                .for_each(|number| put(&mut world, 1, 310.0 - f64::from(number) * SPACING, PASSING, 1));
            let last = BLOCKERS + 1;
            let mut opened = None;
            while opened.is_none_or(|since| world.clock().time() < since + 20.0) {
                world.step();
                let car = |id| world.vehicles().find(|it| it.id() == id).unwrap();
                let is_blocked = car(last).x() < car(0).x() + LENGTH;
                if is_blocked {
                    let phase = phase_of_the_first(&world);
                    assert!(
                        matches!(phase, Phase::Cruises | Phase::Wants),
                        "changed into a gap that is none"
                    );
                    waited += u32::from(phase == Phase::Wants);
                } else {
                    opened = opened.or(Some(world.clock().time()));
                }
            }
            changed += u64::from(world.counts().discretionary_changes > 0);
        }
        assert!(waited > 0);
        assert!(changed as f64 >= 0.95 * SEEDS as f64, "{}: {changed}", style.name);
    }
}
