//! Random maps: valid, difficult, and the same for the same seed.

use std::collections::{BTreeMap, HashSet};

use laneweave_generate::{Element, Hazard, RandomMap, random};
use laneweave_maps::{Map, ReadOptions, lanelet2};
use laneweave_network::{LaneletIndex, Side};

/// The seeds of the benchmark.
fn seeds() -> impl Iterator<Item = u64> {
    (1..=300).chain(1001..=1100)
}

fn read(map: &RandomMap) -> Map {
    lanelet2::read(lanelet2::write(&map.drawing).as_bytes(), &ReadOptions::default()).expect("it is a map")
}

/// The lanelets that can be reached from one, by driving on and by changing lanes.
fn reachable(map: &Map, from: LaneletIndex) -> HashSet<LaneletIndex> {
    let (mut reached, mut open) = (HashSet::new(), vec![from]);
    while let Some(here) = open.pop() {
        if reached.insert(here) {
            let lanelet = &map.network.lanelets[here.at()];
            open.extend(&lanelet.following);
            open.extend(Side::BOTH.into_iter().filter_map(|it| lanelet.beside(it)));
        }
    }
    reached
}

#[test]
fn the_same_seed_draws_the_same_map_and_another_seed_another_one() {
    let text = |seed| lanelet2::write(&random(seed).drawing);
    assert_eq!(text(7), text(7));
    let texts: HashSet<String> = (1..=20).map(text).collect();
    assert_eq!(texts.len(), 20);
}

#[test]
fn random_maps_are_read_without_problems_and_every_entrance_leads_to_an_exit() {
    for seed in seeds() {
        let map = read(&random(seed));
        assert_eq!(map.problems, [], "seed {seed}");
        let network = &map.network;
        assert!(!network.entrances.is_empty() && !network.exits.is_empty(), "seed {seed}");
        let exits: HashSet<LaneletIndex> = network
            .exits
            .iter()
            .flat_map(|it| &it.chains)
            .filter_map(|it| network.chain(*it).lanelets.last().copied())
            .collect();
        for chain in network.entrances.iter().flat_map(|it| &it.chains) {
            let from = network.chain(*chain).lanelets[0];
            let reaches = reachable(&map, from).iter().any(|it| exits.contains(it));
            assert!(reaches, "seed {seed}: lanelet {}", network.lanelets[from.at()].id);
        }
    }
}

#[test]
fn every_random_map_is_hard_to_drive_on_and_every_hazard_is_found_often() {
    let mut found: BTreeMap<Hazard, usize> = BTreeMap::new();
    for seed in seeds() {
        let map = random(seed);
        let hazards: Vec<Hazard> = map.elements.iter().filter_map(|it| it.hazard).collect();
        assert!(hazards.len() >= 3, "seed {seed}: {hazards:?}");
        assert!((600.0..4500.0).contains(&map.length_m), "seed {seed}: {} m", map.length_m);
        hazards.into_iter().for_each(|it| *found.entry(it).or_default() += 1);
    }
    for hazard in Hazard::ALL {
        let times = found.get(&hazard).copied().unwrap_or(0);
        assert!(times >= 10, "{hazard}: {times} of {found:?}");
    }
}

#[test]
fn lanes_are_wide_enough_for_a_car_but_for_strips_and_where_they_end() {
    for seed in seeds() {
        let random = random(seed);
        let map = read(&random);
        for element in random.elements.iter().filter(|it| it.hazard != Some(Hazard::Strip)) {
            for lanelet in map.network.lanelets.iter().filter(|it| element.has(it.id)) {
                let [left, right] = [&lanelet.left_border, &lanelet.right_border];
                let widths =
                    [0.0, 1.0].map(|it| left.at(it * left.length()).distance(&right.at(it * right.length())));
                let sound = |it: f64| (2.199..5.0).contains(&it) || it < 1e-9;
                assert!(widths.into_iter().all(sound), "seed {seed}: {}: {widths:?}", lanelet.id);
                assert!(widths.iter().any(|it| *it > 0.0), "seed {seed}: {}", lanelet.id);
            }
        }
    }
}

#[test]
fn lanelets_share_ground_inside_of_elements_that_are_meant_to_only() {
    let shares = |it: &Hazard| {
        use Hazard::{
            Bulge, CrossingExits, ForkRow, Gap, MergeExit, NestedFork, OpeningAtLight, SharedEntrance,
        };
        use Hazard::{EdgeFork, EdgeMerge, Lights, OneLaneStreet, PartialOverlap, PlainJunction};
        use Hazard::{Fork, Merge};
        use Hazard::{Priority, Roundabout, ShortArms, Strip};
        let meant = [EdgeFork, EdgeMerge, Lights, OneLaneStreet, PartialOverlap, PlainJunction];
        let tight =
            [Bulge, CrossingExits, ForkRow, Gap, MergeExit, NestedFork, OpeningAtLight, SharedEntrance];
        let joined = [Priority, Roundabout, ShortArms, Strip, Fork, Merge];
        [&meant[..], &tight, &joined].concat().contains(it)
    };
    for seed in seeds() {
        let random = random(seed);
        let map = read(&random);
        let element = |it: LaneletIndex| -> &Element {
            let id = map.network.lanelets[it.at()].id;
            random.elements.iter().find(|it| it.has(id)).expect("every lanelet is of an element")
        };
        for (here, others) in (0..).zip(&map.graph.conflicting) {
            let here = element(LaneletIndex(here));
            for other in others {
                let there = element(*other);
                assert_eq!(here, there, "seed {seed}");
                assert!(here.hazard.as_ref().is_some_and(shares), "seed {seed}: {here:?}");
            }
        }
    }
}
