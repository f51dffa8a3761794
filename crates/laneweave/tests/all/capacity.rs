//! The estimated capacity of maps is right: just below it hardly any vehicle waits; above it about as many enter.

use laneweave::generate::{Control, Grid, Motorway, grid, motorway};
use laneweave::maps::{Drawing, ReadOptions, load, regulations};
use laneweave::models::Style;
use laneweave::network::Network;
use laneweave::style::Population;
use laneweave::{Bottleneck, Capacity};
use laneweave_sim::{Demand, Navigator, Origin, Rate, Setup, Share, World};
use laneweave_test_data::data;

const TRUCKS: f64 = 0.1;

fn network(drawing: &Drawing) -> Network {
    let map = drawing.build().expect("a map");
    let rules = regulations(&map);
    map.network.regulated(&rules)
}

fn road(lanes: usize, plan: Motorway) -> Network {
    network(&motorway(&Motorway { lanes, length_m: 3000.0, ..plan }).expect("a road"))
}

fn cross(control: Control) -> Network {
    network(&grid(&Grid { rows: 1, columns: 1, control, ..Grid::default() }).expect("a junction"))
}

/// Drivers who stand for the usual styles, with their weights, and the usual population.
fn usual() -> (Vec<(Style, f64)>, Vec<Style>, Vec<Share>) {
    let Population { driver_parameters, shares } = Population::usual(1).expect("built-in styles");
    let mixture = Population::usual_mixture().expect("built-in styles");
    (Population::by_speed(&mixture), driver_parameters, shares)
}

/// The estimated capacity of `network` for a demand modified by `skew`.
fn capacity(network: &Network, skew: impl Fn(&mut Demand)) -> Capacity {
    let (drivers, _, shares) = usual();
    let mut demand = Demand::even(network, 1000.0, TRUCKS, shares);
    skew(&mut demand);
    let navigator = Navigator::towards(network, &demand.destinations);
    Capacity::new(network, &navigator, (&demand, [0.0, 1.0]), &drivers)
}

/// Only the origins with these indices have demand, and only their destinations.
fn only(demand: &mut Demand, [origins, destinations]: [&[usize]; 2]) {
    for (number, origin) in demand.origins.iter_mut().enumerate() {
        let comes = origins.contains(&number);
        origin.rate = Rate::constant(if comes { 500.0 } else { 0.0 });
        let weights = origin.weights.iter_mut().enumerate();
        weights.for_each(|(to, weight)| *weight = f64::from(u8::from(destinations.contains(&to))));
    }
}

#[test]
fn lanes_bear_as_much_as_there_are_of_them_where_fewest_are_left() {
    let plain = |lanes| capacity(&road(lanes, Motorway::default()), |_| ()).queues_from_veh_h;
    let lane = plain(1);
    assert!((1800.0..2300.0).contains(&lane), "{lane} veh/h");
    // Lane changes take a part of it.
    let [two, four] = [2, 4].map(plain);
    assert!((0.85..=1.0).contains(&(two / (2.0 * lane))), "{two} of {lane} veh/h a lane");
    assert!((0.85..1.0).contains(&(four / (4.0 * lane))), "{four} of {lane} veh/h a lane");
    let drop = capacity(&road(3, Motorway { lane_drop_at: Some(1500.0), ..Motorway::default() }), |_| ());
    assert!((drop.queues_from_veh_h / two - 1.0).abs() < 1e-9, "{drop:?}");
}

#[test]
fn the_more_leave_over_a_ramp_the_sooner_it_is_full() {
    let network = road(3, Motorway { off_ramp_at: vec![2000.0], ..Motorway::default() });
    let leaving = |share: f64| {
        let to_the_ramp = |demand: &mut Demand| {
            let is_ramp = |to: usize| demand.destinations[to].chains().len() == 1;
            let weights: Vec<f64> = (0..2).map(|to| if is_ramp(to) { share } else { 1.0 - share }).collect();
            demand.origins[0].weights = weights;
        };
        capacity(&network, to_the_ramp)
    };
    let [some, half, all] = [0.1, 0.5, 1.0].map(leaving);
    assert!(
        (some.queues_from_veh_h - capacity(&road(3, Motorway::default()), |_| ()).queues_from_veh_h).abs()
            < 1e-6,
        "{some:?}"
    );
    assert!((half.queues_from_veh_h / all.queues_from_veh_h - 2.0).abs() < 1e-9, "{half:?} {all:?}");
    // A single lane behind trucks carries as much on the road as on the ramp.
    let single = capacity(&road(1, Motorway::default()), |_| ());
    assert!((all.queues_from_veh_h / single.queues_from_veh_h - 1.0).abs() < 0.05, "{all:?} {single:?}");
}

#[test]
fn a_merge_bears_less_than_the_road_beyond_it_the_more_come_over_the_ramp() {
    let network = road(3, Motorway { on_ramp_at: vec![1000.0], ..Motorway::default() });
    let plain = capacity(&road(3, Motorway::default()), |_| ()).queues_from_veh_h;
    let from_ramp = |share: f64| {
        capacity(&network, |it| {
            let lanes = |origin: &Origin| origin.place.chains().len();
            for origin in &mut it.origins {
                let of_all = if lanes(origin) == 1 { share } else { 1.0 - share };
                origin.rate = Rate::constant(1000.0 * of_all);
            }
        })
        .queues_from_veh_h
    };
    let [none, few, some] = [0.0, 0.1, 0.25].map(from_ramp);
    assert!((none / plain - 1.0).abs() < 1e-9, "{none} of {plain}");
    assert!(0.85 * plain < some && some < few && few < plain, "{some} {few} of {plain}");
}

#[test]
fn a_light_bears_what_of_a_queue_drives_off_at_green() {
    let network = cross(Control::Signals);
    let even = capacity(&network, |_| ());
    assert!(matches!(even.bottleneck, Some(Bottleneck::Light { .. })), "{even:?}");
    // Each arm has a phase of some ten seconds in a minute.
    let green: f64 = network.junctions.lights.iter().map(|it| it.program.green_share()).sum::<f64>()
        / network.junctions.lights.len() as f64;
    let lanes: usize = network.entrances.iter().map(|it| it.chains.len()).sum();
    let at_green = even.queues_from_veh_h / (lanes as f64 * green);
    assert!((800.0..1800.0).contains(&at_green), "{at_green} veh/h of green and lane");
    // If all come from one arm, they have only its green.
    let one = capacity(&network, |it| only(it, [&[0], &[0, 1, 2, 3]]));
    assert!(one.queues_from_veh_h < 0.5 * even.queues_from_veh_h, "{one:?} {even:?}");
}

#[test]
fn who_crosses_takes_the_time_of_others_and_who_does_not_takes_none() {
    let network = cross(Control::RightBeforeLeft);
    let from = |origins: &[usize]| capacity(&network, |it| only(it, [origins, &[0, 1, 2, 3]]));
    let alone: Vec<f64> = (0..4).map(|it| from(&[it]).queues_from_veh_h).collect();
    let all = from(&[0, 1, 2, 3]);
    assert!(matches!(all.bottleneck, Some(Bottleneck::Junction(_))), "{all:?}");
    // Four arms have more capacity than one, but far less than four times as much.
    assert!(all.queues_from_veh_h > alone[0] && all.queues_from_veh_h < 2.0 * alone[0], "{all:?} {alone:?}");
    assert!(alone.iter().all(|it| (it / alone[0] - 1.0).abs() < 0.02), "{alone:?}");
}

/// Vehicles per hour that enter in a quarter of an hour at `load` times the estimated capacity of `network`, and
/// vehicles that wait then.
fn driven(network: &Network, load: f64) -> (f64, usize) {
    const STEP_S: f64 = 0.1;
    const DURATION_S: f64 = 900.0;
    let demanded = load * capacity(network, |_| ()).queues_from_veh_h;
    let (_, driver_parameters, shares) = usual();
    let demand = Demand::even(network, demanded, TRUCKS, shares);
    let setup = Setup { step: STEP_S, seed: 5, threads: 1 };
    let mut world =
        World::new(network.clone(), driver_parameters, demand, setup).expect("the set-up makes sense");
    (0..(DURATION_S / STEP_S) as u32).for_each(|_| world.step());
    (world.counts().entered as f64 * 3600.0 / DURATION_S, world.waiting())
}

#[test]
fn below_capacity_hardly_anybody_waits_and_above_it_nine_tenths_of_it_still_enter() {
    let networks = [
        ("two lanes", road(2, Motorway::default())),
        ("three lanes at 50 km/h", road(3, Motorway { speed_limit_kmh: 50.0, ..Motorway::default() })),
        ("a lane drop", road(3, Motorway { lane_drop_at: Some(1500.0), ..Motorway::default() })),
        ("an off-ramp", road(3, Motorway { off_ramp_at: vec![2000.0], ..Motorway::default() })),
        ("an on-ramp", road(3, Motorway { on_ramp_at: vec![1000.0], ..Motorway::default() })),
        ("priority", cross(Control::Priority)),
        ("lights", cross(Control::Signals)),
    ];
    for (what, network) in networks {
        let Capacity { veh_h, queues_from_veh_h: estimate, .. } = capacity(&network, |_| ());
        let (below, waiting) = driven(&network, 0.75);
        assert!(waiting < 8, "{what}: {waiting} wait, {below} of {estimate} veh/h entered");
        let (above, _) = driven(&network, 1.4);
        assert!(above > 0.9 * estimate, "{what}: {above} of {estimate} veh/h entered");
        let (most, _) = driven(&network, 2.0);
        assert!(most.max(above) > 0.8 * veh_h, "{what}: {above}, {most} of {veh_h} veh/h entered");
    }
}

#[test]
fn two_lanes_that_join_in_turns_bear_what_the_lane_behind_them_carries() {
    let Some(file) = data("cases/20_zipper.osm") else { return };
    for limit in [30.0, 50.0, 70.0] {
        let mut map = load(&file, &ReadOptions::default()).expect("a map");
        map.network.lanelets.iter_mut().for_each(|it| it.speed_limit = limit / 3.6);
        let lanelets = std::mem::take(&mut map.network.lanelets);
        map.network = Network::new(lanelets, map.network.driving_side).expect("a network");
        let network = map.network.clone().regulated(&regulations(&map));
        let (estimate, (above, _)) = (capacity(&network, |_| ()).veh_h, driven(&network, 1.4));
        assert!((above / estimate - 1.0).abs() < 0.15, "{limit} km/h: {above} of {estimate} veh/h entered");
    }
}

#[test]
fn a_single_lane_takes_in_what_it_carries_at_any_limit() {
    for speed_limit_kmh in [30.0, 50.0, 80.0, 120.0] {
        let network = road(1, Motorway { speed_limit_kmh, ..Motorway::default() });
        let (estimate, (above, _)) = (capacity(&network, |_| ()).veh_h, driven(&network, 1.4));
        assert!(above > 0.96 * estimate, "{speed_limit_kmh} km/h: {above} of {estimate} veh/h entered");
    }
}
