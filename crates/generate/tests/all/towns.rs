//! The drawings of the town generators.

use std::collections::HashSet;

use laneweave_generate::{Arterial, Control, Grid, Roundabout, approach, arterial, grid, roundabout, town};
use laneweave_maps::{Drawing, Map, NodeIndex, RuleKind, Sense, lanelet2, routes};
use laneweave_network::{Beside, DrivingSide, Gate, Id, Lanelet, LaneletIndex, Polyline, Side};

/// Limits of streets, of the roundabout, and of the motorway [m/s].
const STREET: f64 = 50.0 / 3.6;
const RING: f64 = 30.0 / 3.6;
const MOTORWAY: f64 = 120.0 / 3.6;

fn map(drawing: &Drawing) -> Map {
    let map = drawing.build().expect("the drawing is sound");
    assert!(map.problems.is_empty());
    map
}

fn single(lanes: usize, control: Control) -> Map {
    map(&grid(&Grid { rows: 1, columns: 1, lanes, control, ..Grid::default() })
        .expect("the grid is possible"))
}

fn refusal(change: impl Fn(&mut Grid)) -> String {
    let mut wanted = Grid::default();
    change(&mut wanted);
    grid(&wanted).expect_err("it is no grid").to_string()
}

/// All maps with right-angled junctions and roundabouts.
fn towns() -> Vec<Map> {
    let right = DrivingSide::Right;
    let mut drawings =
        vec![town(right), approach(right), roundabout(&Roundabout::default()).expect("it can be drawn")];
    drawings
        .extend((1..=3).map(|lanes| grid(&Grid { lanes, ..Grid::default() }).expect("the grid is possible")));
    drawings.push(arterial(&Arterial::default()).expect("the street is possible"));
    drawings.iter().map(map).collect()
}

fn lanelet(map: &Map, id: impl Into<Id>) -> &Lanelet {
    let id = id.into();
    map.network.lanelets.iter().find(|it| it.id == id).expect("the lanelet is there")
}

/// Angle by which a lanelet turns, to the left positive [°].
fn turn(lanelet: &Lanelet) -> f64 {
    let centre = &lanelet.centre;
    let turn = centre.heading(centre.length()) - centre.heading(0.0);
    (turn.to_degrees() + 540.0).rem_euclid(360.0) - 180.0
}

/// Movements of the lanelets that follow a lanelet: l, s and r.
fn ways(map: &Map, lanelet: &Lanelet) -> String {
    let following = lanelet.following.iter().map(|it| turn(&map.network.lanelets[it.at()]));
    let mut ways: Vec<char> = following
        .map(|turn| match turn {
            45.0.. => 'l',
            ..-45.0 => 'r',
            _ => 's',
        })
        .collect();
    ways.sort_unstable();
    ways.into_iter().collect()
}

/// The lanelets that can be reached from one, by driving on and, if `changing`, by changing lanes.
fn reachable(map: &Map, from: LaneletIndex, changing: bool) -> HashSet<LaneletIndex> {
    let (mut reached, mut open) = (HashSet::new(), vec![from]);
    while let Some(here) = open.pop() {
        if reached.insert(here) {
            let lanelet = &map.network.lanelets[here.at()];
            open.extend(&lanelet.following);
            open.extend(Side::BOTH.into_iter().filter(|_| changing).filter_map(|it| lanelet.beside(it)));
        }
    }
    reached
}

/// First lanelets of the entrances, by gate.
fn entrances(map: &Map) -> Vec<Vec<LaneletIndex>> {
    let first = |gate: &Gate| -> Vec<LaneletIndex> {
        gate.chains.iter().map(|it| map.network.chain(*it).lanelets[0]).collect()
    };
    map.network.entrances.iter().map(first).collect()
}

/// Last lanelets of the exits, by gate.
fn exits(map: &Map) -> Vec<Vec<LaneletIndex>> {
    let last = |gate: &Gate| -> Vec<LaneletIndex> {
        gate.chains
            .iter()
            .map(|it| *map.network.chain(*it).lanelets.last().expect("chains have lanelets"))
            .collect()
    };
    map.network.exits.iter().map(last).collect()
}

#[test]
fn every_lane_before_a_junction_leads_where_it_should() {
    for (lanes, expected) in [(1, vec!["lrs"]), (2, vec!["ls", "rs"]), (3, vec!["l", "s", "rs"])] {
        let map = single(lanes, Control::Signals);
        // Lights are numbered arm by arm, from the left lane to the right one.
        let found: Vec<String> =
            map.rules.iter().map(|it| ways(&map, lanelet(&map, it.lanelets[0]))).collect();
        assert_eq!(found, [&expected[..]; 4].concat());
    }
}

#[test]
fn an_arterial_has_two_lanes_that_cross_streets_of_one() {
    let map = map(&arterial(&Arterial { junctions: 2, ..Arterial::default() }).unwrap());
    let lanes = |gates: &[Vec<LaneletIndex>]| gates.iter().map(Vec::len).collect::<Vec<_>>();
    let (mut ins, mut outs) = (lanes(&entrances(&map)), lanes(&exits(&map)));
    ins.sort_unstable();
    outs.sort_unstable();
    assert_eq!((ins, outs), (vec![1, 1, 1, 1, 2, 2], vec![1, 1, 1, 1, 2, 2]));
    let mut found: Vec<String> =
        map.rules.iter().map(|it| ways(&map, lanelet(&map, it.lanelets[0]))).collect();
    found.sort();
    assert_eq!(found, [["lrs"; 4], ["ls"; 4], ["rs"; 4]].concat());
}

#[test]
fn a_route_leads_from_every_entrance_of_a_grid_to_every_exit() {
    let map = map(&grid(&Grid::default()).unwrap());
    for lane in entrances(&map).concat() {
        let reached = reachable(&map, lane, true);
        assert!(exits(&map).concat().iter().all(|it| reached.contains(it)));
    }
}

#[test]
fn nobody_turns_back_at_a_junction() {
    let map = single(2, Control::Signals);
    let end = |it: LaneletIndex| {
        let centre = &map.network.lanelets[it.at()].centre;
        centre.at(centre.length())
    };
    for entrance in entrances(&map) {
        let start = map.network.lanelets[entrance[0].at()].centre.at(0.0);
        let reached = reachable(&map, entrance[0], true);
        for exit in exits(&map) {
            let is_own_arm = end(exit[0]).distance(&start) < 20.0;
            assert_eq!(exit.iter().all(|it| reached.contains(it)), !is_own_arm);
        }
    }
}

#[test]
fn lanes_share_ground_inside_of_junctions_only() {
    let wanted = Grid { lanes: 3, rows: 2, columns: 2, ..Grid::default() };
    let map = map(&grid(&wanted).unwrap());
    // From the middle of the nearest junction; the arms of three lanes end 18.125 m from there.
    let away = |metres: f64| (metres - if metres < 75.0 { 0.0 } else { wanted.block_length_m }).abs();
    let mut ways = 0;
    for (lanelet, others) in map.network.lanelets.iter().zip(&map.graph.conflicting) {
        let middle = lanelet.centre.at(lanelet.length() / 2.0);
        let is_inside = away(middle.x).max(away(middle.y)) < 18.125;
        assert_eq!(!others.is_empty(), is_inside, "{}", lanelet.id);
        ways += usize::from(is_inside);
    }
    // Four junctions of four arms with one path left, two straight on and one right.
    assert_eq!(ways, 64);
}

#[test]
fn ways_from_lanes_side_by_side_do_not_cross() {
    for lanes in [2, 3] {
        let map = single(lanes, Control::Signals);
        for arm in map.rules.chunks(lanes) {
            let ways: Vec<&Vec<LaneletIndex>> =
                arm.iter().map(|it| &lanelet(&map, it.lanelets[0]).following).collect();
            for (number, from_lane) in ways.iter().enumerate() {
                for other in ways.iter().skip(number + 1).copied().flatten() {
                    let crosses = |it: &LaneletIndex| map.graph.conflicting[it.at()].contains(other);
                    assert!(!from_lane.iter().any(crosses));
                }
            }
        }
    }
}

#[test]
fn nothing_bends_sharper_than_8_m_or_has_a_kink() {
    for map in towns() {
        for lanelet in &map.network.lanelets {
            let centre = &lanelet.centre;
            let mut station = 0.0;
            while station + 6.0 < centre.length() {
                let [a, b, c] = [0.0, 3.0, 6.0].map(|it| centre.at(station + it));
                let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                let curvature = 2.0 * area.abs() / (a.distance(&b) * b.distance(&c) * c.distance(&a));
                assert!(curvature < 1.0 / 8.0, "{} at {station}: {}", lanelet.id, 1.0 / curvature);
                station += 1.0;
            }
            for next in lanelet.following.iter().map(|it| &map.network.lanelets[it.at()].centre) {
                let turn = (next.heading(0.0) - centre.heading(centre.length())).to_degrees();
                assert!(((turn + 540.0).rem_euclid(360.0) - 180.0).abs() < 8.0, "{}: {turn}", lanelet.id);
            }
        }
    }
}

#[test]
fn lanes_are_changed_up_to_30_m_before_the_stop_line() {
    let map = single(2, Control::Signals);
    for chain in entrances(&map).concat() {
        let chain = map.network.chains.iter().find(|it| it.lanelets[0] == chain).unwrap();
        let beside = chain.left.iter().chain(&chain.right).collect::<Vec<_>>();
        assert_eq!(beside.len(), 1);
        assert_eq!(beside[0].start, 0.0);
        assert!((chain.length - beside[0].end - 30.0).abs() < 2e-3);
    }
}

#[test]
fn every_lane_before_lights_has_one_and_stops_at_its_end() {
    let map = map(&grid(&Grid::default()).unwrap());
    // Nine junctions of four arms of two lanes.
    assert_eq!(map.rules.len(), 72);
    let mut lanes = HashSet::new();
    for rule in &map.rules {
        assert_eq!((&rule.kind, rule.lanelets.len()), (&RuleKind::TrafficLight, 1));
        assert!(lanes.insert(rule.lanelets[0]));
        let lanelet = lanelet(&map, rule.lanelets[0]);
        let last = |line: &Polyline| *line.points().last().unwrap();
        let end = [last(&lanelet.left_border), last(&lanelet.right_border)];
        assert_eq!((rule.stop_lines.len(), &rule.stop_lines[0][..]), (1, &end[..]));
        assert_eq!(rule.signs[0][0].z - end[0].z, 5.0);
        assert!(lanelet.following.iter().all(|it| !map.graph.conflicting[it.at()].is_empty()));
    }
}

#[test]
fn at_a_priority_junction_who_comes_from_north_or_south_gives_way() {
    let map = single(1, Control::Priority);
    assert_eq!(map.rules.len(), 2);
    for rule in &map.rules {
        let RuleKind::RightOfWay { first, yielding } = &rule.kind else { panic!("{rule:?}") };
        // An approach and its three movements; two of these have priority.
        assert_eq!((first.len(), yielding.len(), rule.lanelets.len(), rule.stop_lines.len()), (8, 4, 12, 1));
        let is_along_east = |id: &Id| lanelet(&map, *id).centre.heading(0.0).cos().abs() > 0.9;
        assert!(first.iter().all(is_along_east) && !yielding.iter().any(is_along_east));
        assert!(rule.stop_lines[0].iter().all(|it| (it.y.abs() - 11.625).abs() < 1e-9));
        // Every lanelet that gives way crosses one with priority.
        let index = |id: Id| map.network.lanelets.iter().position(|it| it.id == id).unwrap();
        for way in &yielding[1..] {
            let conflicting = &map.graph.conflicting[index(*way)];
            assert!(first.iter().any(|it| conflicting.contains(&LaneletIndex(index(*it) as u32))));
        }
    }
}

#[test]
fn an_all_way_stop_stops_all_and_right_before_left_has_no_sign() {
    let map = single(1, Control::AllWayStop);
    let [rule] = &map.rules[..] else { panic!("{:?}", map.rules) };
    let RuleKind::AllWayStop { lanelets } = &rule.kind else { panic!("{rule:?}") };
    assert_eq!((lanelets.len(), rule.lanelets.len(), rule.stop_lines.len()), (4, 4, 4));
    assert!(lanelets.iter().all(|it| ways(&map, lanelet(&map, *it)) == "lrs"));
    assert!(single(1, Control::RightBeforeLeft).rules.is_empty());
}

#[test]
fn every_way_into_a_roundabout_gives_way_to_the_ring() {
    let map = map(&roundabout(&Roundabout::default()).expect("it can be drawn"));
    for entrance in entrances(&map).concat() {
        // Vehicles also come back around the roundabout.
        let reached = reachable(&map, entrance, false);
        assert!(exits(&map).concat().iter().all(|it| reached.contains(it)));
    }
    assert_eq!(map.rules.len(), 4);
    for rule in &map.rules {
        let RuleKind::RightOfWay { first, yielding } = &rule.kind else { panic!("{rule:?}") };
        assert!(first.iter().all(|it| lanelet(&map, *it).speed_limit == RING));
        let [street, way_in] = &yielding[..] else { panic!("{yielding:?}") };
        assert_eq!(lanelet(&map, *street).speed_limit, STREET);
        let onto = |id: Id| lanelet(&map, id).following.clone();
        // The piece of the circulating lane before the arm, then the one in front of it, which leads onto the same
        // lanelet as the entry.
        assert_eq!(onto(first[1]).last(), onto(*way_in).last());
        assert!(onto(first[0]).iter().any(|it| map.network.lanelets[it.at()].id == first[1]));
        assert!(turn(lanelet(&map, first[1])) > 0.0);
    }
}

#[test]
fn bridges_lie_6_m_above_the_motorway_and_slopes_are_gentle() {
    let map = map(&town(DrivingSide::Right));
    let lanelets = &map.network.lanelets;
    let mut crossings = 0;
    for (here, others) in map.graph.conflicting.iter().enumerate() {
        for other in others.iter().map(|it| &lanelets[it.at()]) {
            let heights = |it: &Lanelet| it.centre.at(it.length() / 2.0).z;
            if lanelets[here].speed_limit == MOTORWAY {
                crossings += 1;
                assert_eq!((heights(&lanelets[here]), other.speed_limit), (0.0, STREET));
                let above = other.centre.points().iter().filter(|it| it.y.abs() < 10.0);
                assert!(above.clone().count() > 0 && above.clone().all(|it| (it.z - 6.0).abs() < 1e-9));
            } else if other.speed_limit != MOTORWAY {
                // Inside of a junction.
                assert!(lanelets[here].length() < 40.0 && heights(&lanelets[here]) == 0.0);
            }
        }
    }
    // Two bridges of two lanes over four.
    assert_eq!(crossings, 16);
    for lanelet in lanelets {
        for pair in lanelet.centre.points().windows(2) {
            let slope = (pair[1].z - pair[0].z).abs() / pair[0].distance(&pair[1]);
            assert!(slope < 0.06, "{}: {slope}", lanelet.id);
        }
    }
}

#[test]
fn the_ramps_of_the_town_join_its_streets_to_the_motorway() {
    let map = map(&town(DrivingSide::Right));
    let is_motorway = |it: &&LaneletIndex| map.network.lanelets[it.at()].speed_limit == MOTORWAY;
    let gates = [entrances(&map), exits(&map)].map(|it| it.concat());
    let [ins, outs] = [&gates[0], &gates[1]];
    assert_eq!([ins, outs].map(|it| it.iter().filter(is_motorway).count()), [4, 4]);
    let reaches = |from: &LaneletIndex| {
        let reached = reachable(&map, *from, true);
        let found = outs.iter().filter(|it| reached.contains(it));
        (found.clone().filter(is_motorway).count(), found.filter(|it| !is_motorway(it)).count())
    };
    let streets = outs.len() - 4;
    for from in ins {
        let found = reaches(from);
        match map.network.lanelets[from.at()].centre.heading(0.0).cos() {
            // Only the carriageway to the east has ramps.
            cos if is_motorway(&from) && cos < 0.0 => assert_eq!(found, (2, 0)),
            _ => assert_eq!(found, (2, streets)),
        }
    }
}

#[test]
fn on_the_approach_a_leads_left_b_both_ways_and_c_straight_on() {
    let map = map(&approach(DrivingSide::Right));
    // The left road's own exit, that of the straight road, and the common one.
    let [north, south, east] = &exits(&map)[..] else { panic!("three exits") };
    let lanes = entrances(&map).concat();
    let chain = |lane: usize| map.network.chains.iter().find(|it| it.lanelets[0] == lanes[lane]).unwrap();
    let reached = |lane: usize| {
        // From 25 m before the stop line on, lane changes are forbidden.
        let (last, _) = chain(lane).lanelet(475.0);
        let reached = reachable(&map, last, true);
        [north, south, east].map(|exit| exit.iter().any(|it| reached.contains(it)))
    };
    assert_eq!([0, 1, 2].map(reached), [[true, false, true], [true, true, true], [false, true, true]]);
    // The junction begins 14.875 m before its middle.
    let stop_line = 515.0 - 14.875;
    for (lane, sides) in [(0, [0, 1]), (1, [1, 1]), (2, [1, 0])] {
        let before = |it: &&Beside| it.start < stop_line;
        let beside =
            [&chain(lane).left, &chain(lane).right].map(|it| it.iter().filter(before).collect::<Vec<_>>());
        assert_eq!(beside.each_ref().map(Vec::len), sides);
        assert!(
            beside.iter().flatten().all(|it| it.start == 0.0 && (stop_line - it.end - 40.0).abs() < 2e-3)
        );
    }
    // From lane B to the common exit straight on, and around by the left road.
    let sense = Sense { most: 100, longest: 3.0 };
    let found = routes(&map, NodeIndex(lanes[1].0), NodeIndex(east[1].0), sense);
    let lengths: Vec<f64> = found.iter().map(|it| it.length).collect();
    let [straight_on, around] = [lengths[0], lengths[lengths.len() - 1]];
    assert!((960.0..970.0).contains(&straight_on) && around > straight_on + 250.0, "{lengths:?}");
}

#[test]
fn what_cannot_be_a_grid_is_refused_with_the_range() {
    assert_eq!(refusal(|it| it.rows = 0), "0 rows; choose 1 to 50");
    assert_eq!(refusal(|it| it.columns = 51), "51 columns; choose 1 to 50");
    assert_eq!(refusal(|it| it.lanes = 4), "4 lanes in a direction; choose 1 to 3");
    assert_eq!(refusal(|it| it.block_length_m = 79.0), "a block length of 79 m; choose 80 to 1000 m");
    assert_eq!(
        refusal(|it| it.speed_limit_kmh = f64::NAN),
        "a speed limit of NaN km/h; choose 5 to 130 km/h"
    );
    let error = arterial(&Arterial { junctions: 0, ..Arterial::default() }).unwrap_err();
    assert_eq!(error.to_string(), "0 junctions; choose 1 to 50");
}

#[test]
fn a_grid_of_four_hundred_junctions_has_the_paths_and_the_size_that_it_should() {
    let wanted = Grid { rows: 20, columns: 20, lanes: 1, ..Grid::default() };
    let drawing = grid(&wanted).unwrap();
    let text = lanelet2::write(&drawing);
    assert!(text.len() < 25_000_000, "{}", text.len());
    // Twelve paths over each junction.
    assert_eq!(map(&drawing).graph.nodes.iter().filter(|it| it.following.len() == 3).count(), 1600);
}
