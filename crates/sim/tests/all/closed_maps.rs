//! Closed maps: trips start and end inside the map.

use std::collections::BTreeMap;

use crate::roads::{Road, drivers, real};
use laneweave_network::{ChainIndex, Id, LaneletIndex, Network};
use laneweave_sim::{
    Assignment, Class, Command, Demand, Destination, Event, Fleet, InnerPlace, Navigator, Place, Placement,
    Places, Setup, VehicleId, World, wait_cycle,
};

/// A ring road of 1,000 m with two lanelets per lane.
fn ring(lanes: usize) -> Network {
    Road { lanes, length: 1000.0, limit: 14.0, is_ring: true, ..Road::default() }.network()
}

/// The trip ends of all lanelets.
fn inner_places(network: &Network) -> Places {
    Places::along(network, (0..network.lanelets.len()).map(|it| LaneletIndex(it as u32)))
}

/// A fleet of all classes.
const FLEET: Fleet = Fleet { trucks: 0.1, buses: 0.05, motorcycles: 0.1, taxis: 0.0, emergency: 0.0 };

fn demand(network: &Network, places: Places, total: f64) -> Demand {
    let population = drivers::demand(network, 0.0, 0.0, &[0.3, 0.7]).population;
    Demand::over(network, places, total, FLEET, population)
}

fn world(network: Network, places: Places, total: f64, seed: u64) -> World {
    let demand = demand(&network, places, total);
    let styles = vec![drivers::aggressive(), drivers::conservative()];
    World::new(network, styles, demand, Setup { step: 0.1, seed, threads: 1 })
        .expect("the set-up makes sense")
}

/// Runs `world`. Checks in every step that no vehicle is lost, and that each completed trip ended at its place inside
/// the map. Returns the number of completed trips.
fn drive(world: &mut World, places: &Places, steps: usize) -> u64 {
    /// Higher than any vehicle's speed [m/s].
    const FASTEST: f64 = 60.0;
    let mut before: BTreeMap<VehicleId, (ChainIndex, f64, Destination)> = BTreeMap::new();
    for _ in 0..steps {
        world.step();
        let counts = world.counts();
        assert_eq!(world.arrived(), counts.entered + world.waiting() as u64);
        assert_eq!(counts.entered, counts.left + world.on_road() as u64);
        for event in world.events() {
            let Event::Left { vehicle, .. } = event else { continue };
            let (chain, x, destination) = before[vehicle];
            let number = world.scene().navigator.number(destination);
            let Some(Place::Inside(inner)) = number.map(|it| &places.destinations[it]) else {
                panic!("{vehicle} had no place to go to");
            };
            let to_go = if inner.chain == chain {
                inner.station - x
            } else {
                assert!(world.network().chain(chain).following.contains(&inner.chain));
                world.network().chain(chain).length - x + inner.station
            };
            assert!((0.0..0.1 * FASTEST).contains(&to_go), "{vehicle} left {to_go} m before its place");
        }
        before = world
            .vehicles()
            .map(|it| (it.id(), (it.spot.chain, it.x(), it.driver.goal.destination())))
            .collect();
    }
    world.counts().left
}

#[test]
fn every_lanelet_of_20_m_has_a_place_at_two_fifths_of_it() {
    let places = inner_places(&ring(2));
    let all: Vec<(Id, u32, f64)> = places
        .origins
        .iter()
        .filter_map(|it| {
            if let Place::Inside(inner) = it { Some((inner.id, inner.chain.0, inner.station)) } else { None }
        })
        .collect();
    assert_eq!(all, [(1.into(), 0, 200.0), (2.into(), 1, 200.0), (3.into(), 0, 700.0), (4.into(), 1, 700.0)]);
    assert_eq!(places.destinations, places.origins);
    let short = Road { length: 19.0, is_ring: true, ..Road::default() }.network();
    assert_eq!(inner_places(&short), Places { origins: vec![], destinations: vec![] });
    // No trip starts on a road that leads nowhere.
    let dead_end = Road { length: 400.0, ..Road::default() }.network();
    assert_eq!((inner_places(&dead_end).origins.len(), inner_places(&dead_end).destinations.len()), (0, 1));
}

#[test]
fn trips_on_a_ring_start_and_end_at_places_inside_and_nobody_collides() {
    let network = ring(2);
    let places = inner_places(&network);
    let mut world = world(network, places.clone(), 900.0, 5);
    let left = drive(&mut world, &places, 18_000);
    assert!(left > 350, "{left}");
    let counters = world.counters();
    assert_eq!(
        (counters.collisions, world.counters().overlaps, counters.stuck, counters.emergency_brakings),
        (0, 0, 0, 0)
    );
    // Half of the destinations are in the other lane.
    assert!(world.counts().route_changes > 100, "{:?}", world.counts());
}

#[test]
fn a_driver_beyond_its_place_takes_another_route() {
    let network = ring(1);
    let places = inner_places(&network);
    let mut world = world(network, places, 0.0, 1);
    let new = Placement {
        chain: ChainIndex(0),
        x: 300.0,
        speed: 14.0,
        class: Class::Car,
        parameters: 1,
        destination: Some(0),
    };
    world.place(new).expect("it fits on the road");
    (0..620).for_each(|_| world.step());
    assert_eq!((world.on_road(), world.counts().left), (1, 0));
    (0..60).for_each(|_| world.step());
    assert_eq!((world.on_road(), world.counts().left, world.counters().missed_turns), (0, 1, 0));
    let distance = world.counters().distance;
    assert!((900.0..901.5).contains(&distance), "{distance} m");
}

#[test]
fn a_driver_who_is_kept_from_its_lane_misses_its_turn_and_goes_round() {
    let network = ring(2);
    let places = inner_places(&network);
    let mut world = world(network, places, 0.0, 1);
    let car = Placement {
        chain: ChainIndex(1),
        x: 145.0,
        speed: 14.0,
        class: Class::Car,
        parameters: 1,
        destination: Some(0),
    };
    world.place(car).expect("it fits on the road");
    for x in [100.0, 116.0, 132.0, 148.0, 164.0] {
        world
            .place(Placement { chain: ChainIndex(0), x, class: Class::Truck, destination: None, ..car })
            .expect("it fits on the road");
    }
    (0..600).for_each(|_| world.step());
    assert_eq!((world.counters().missed_turns, world.counts().left), (1, 0));
    (0..600).for_each(|_| world.step());
    assert_eq!((world.counters().missed_turns, world.counts().left), (1, 1));
}

#[test]
fn the_way_to_a_place_inside_is_counted_from_where_the_driver_is() {
    let network = ring(2);
    let navigator = Navigator::towards(&network, &inner_places(&network).destinations);
    let way = |chain, x| {
        let it = navigator.waypoint_from(&network, Some(0), ChainIndex(chain), x);
        (it.changes, it.last_place, it.end, it.distance - x)
    };
    assert_eq!(way(0, 150.0), (0, f64::INFINITY, 200.0, 50.0));
    assert_eq!(way(0, 250.0), (0, f64::INFINITY, f64::INFINITY, 950.0));
    // In the lane beside, up to 40 m before the trip end; after that, a full round.
    assert_eq!(way(1, 150.0), (1, 160.0, f64::INFINITY, 50.0));
    assert_eq!(way(1, 170.0), (1, 1160.0, f64::INFINITY, 1030.0));
}

#[test]
fn nobody_starts_before_a_driver_who_would_have_to_brake_harder_than_2_mps2() {
    let network = ring(1);
    let places = inner_places(&network);
    let mut world = world(network, places, 1500.0, 2);
    let (mut started, mut hardest, mut was_refused) = (0, 0.0_f64, false);
    for _ in 0..6000 {
        world.step();
        was_refused |= world.waiting() > 0;
        let new: Vec<VehicleId> = world
            .events()
            .iter()
            .filter_map(|event| if let Event::Entered(id) = event { Some(*id) } else { None })
            .collect();
        let places: Vec<(VehicleId, f64)> = world.vehicles().map(|it| (it.id(), it.x())).collect();
        let behind = |id: VehicleId| {
            let x = places.iter().find(|it| it.0 == id)?.1;
            let others = places.iter().filter(|it| it.0 != id);
            let back = |it: &(VehicleId, f64)| (x - it.1).rem_euclid(1000.0);
            others.min_by(|a, b| back(a).total_cmp(&back(b))).map(|it| it.0)
        };
        let followers: Vec<VehicleId> = new.iter().filter_map(|id| behind(*id)).collect();
        started += new.len();
        if !new.is_empty() {
            world.step();
            let braking = world.vehicles().filter(|it| followers.contains(&it.id()));
            hardest = braking.map(|it| -f64::from(it.motion.acceleration)).fold(hardest, f64::max);
        }
    }
    assert!(started > 100 && was_refused);
    assert!((1.0..2.0 + 1e-3).contains(&hardest), "{hardest} m/s²");
    assert_eq!((world.counters().collisions, world.counters().emergency_brakings), (0, 0));
}

#[test]
fn threads_and_the_storage_of_chains_change_nothing() {
    let hash = |network: Network, threads| {
        let demand = demand(&network, inner_places(&network), 1200.0);
        let styles = vec![drivers::aggressive(), drivers::conservative()];
        let mut world = World::new(network, styles, demand, Setup { step: 0.1, seed: 9, threads }).unwrap();
        (0..6000).for_each(|_| world.step());
        assert!(world.counts().left > 50);
        world.state_hash()
    };
    let first = hash(ring(3), 1);
    assert_eq!(hash(ring(3), 2), first);
    assert_eq!(hash(ring(3).with_chains_reversed(), 1), first);
}

/// A real map with its trip ends, if this machine has it.
fn with_places(file: &str) -> Option<(Network, Places)> {
    let (network, graph) = real(file)?;
    let alone = graph.conflicting.iter().zip(0..).filter(|(others, _)| others.is_empty());
    let places = Places::along(&network, alone.map(|(_, it)| LaneletIndex(it)));
    Some((network, places))
}

#[test]
fn trips_in_towns_end_at_their_places() {
    for (file, total, inner_places, least) in
        [("town10.osm", 1200.0, 45, 120), ("crossroads_with_stoplines.osm", 600.0, 23, 50)]
    {
        let Some((network, places)) = with_places(file) else { continue };
        assert!(network.entrances.is_empty() || network.exits.is_empty());
        assert_eq!((places.origins.len(), places.destinations.len()), (inner_places, inner_places), "{file}");
        let mut world = world(network, places.clone(), total, 1);
        let left = drive(&mut world, &places, 6_000);
        assert!(left >= least, "{file}: {left}");
    }
}

#[test]
fn a_town_in_which_far_more_start_than_it_can_bear_lets_them_wait_and_keeps_moving() {
    let Some((network, places)) = with_places("town10.osm") else { return };
    let roads: f64 = network.chains.iter().map(|it| it.length).sum();
    let mut world = world(network, places, 4000.0, 1);
    for _ in 0..9 {
        let before = world.counts().left;
        (0..1000).for_each(|_| world.step());
        let taken: f64 = world.vehicles().map(|it| f64::from(it.motion.length) + 2.0).sum();
        // The limit of perimeter control, and one more vehicle from each trip end before the limit takes effect.
        assert!(taken < 0.21 * roads, "{taken} m of {roads} m are taken up");
        assert!(
            world.counts().left > before || world.clock().time() < 200.0,
            "at {} s",
            world.clock().time()
        );
    }
    assert!(world.waiting() > 300, "{} wait", world.waiting());
}

#[test]
fn a_place_inside_keeps_clear_of_the_lanelets_before_and_behind() {
    let longest = FLEET.shares().map(|(class, _)| class.body().length).into_iter().fold(0.0, f64::max);
    let shortest = InnerPlace::SHORTEST_LANELET;
    let lanelet = Road { length: shortest, is_ring: true, ..Road::default() }.network();
    let Place::Inside(inner) = &inner_places(&lanelet).destinations[0] else { panic!("a place inside") };
    assert!(inner.station + longest <= shortest);
}

#[test]
fn a_demand_loads_the_ways_between_its_places() {
    let network = ring(1);
    let places = inner_places(&network);
    let demand = demand(&network, places.clone(), 600.0);
    let assignment =
        Assignment::new(&network, &Navigator::towards(&network, &places.destinations), &demand, [0.0, 1.0]);
    assert!((3600.0 * assignment.total - 600.0).abs() < 1e-6);
    // The distance from each of the two trip ends to the other one is half of the ring road.
    let chain = ChainIndex(0);
    let length = network.chain(chain).length;
    let parts = assignment.on(chain).iter();
    let metres: f64 = parts.map(|it| it.flow * (it.to.min(length) - it.from)).sum();
    assert!((metres / assignment.total - 0.5 * length).abs() < 1e-6, "{}", metres / assignment.total);
}

#[test]
fn on_a_full_ring_each_waits_for_the_next_and_all_are_named() {
    let network = ring(1);
    let mut world = world(network.clone(), inner_places(&network), 0.0, 1);
    let mut placed = Vec::new();
    for (chain, index) in network.chains.iter().zip(0..) {
        let room = (chain.length / 6.0) as u32;
        for x in (1..=room).map(|it| chain.length - 6.0 * f64::from(room - it)) {
            let (chain, destination) = (ChainIndex(index), None);
            let car = Placement { chain, x, speed: 0.0, class: Class::Car, parameters: 1, destination };
            placed.push(world.place(car).expect("there is room"));
        }
    }
    let first = world.vehicle(placed[0]).expect("it is on the road").spot;
    let mut circle = wait_cycle(&world, first);
    circle.sort_unstable();
    assert_eq!(circle, placed);
    // Behind a gap of 37.5 m, the next one waits for nobody, and drives off.
    for removed in &placed[7..13] {
        world.command(Command::Remove(*removed)).expect("it is there");
    }
    world.step();
    let first = world.vehicle(placed[0]).expect("it is on the road").spot;
    assert_eq!(wait_cycle(&world, first), Vec::<VehicleId>::new());
}
