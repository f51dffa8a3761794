use laneweave_network::{DrivingSide, Id, Lanelet, LaneletIndex, Point, Polyline};

use super::*;
use crate::route::navigate::Navigator;
use crate::route::place::{CrossSection, InnerPlace};

/// A lane to the east between two stations [m], with a limit of 10 m/s, followed by `following`.
pub(crate) fn lanelet(id: i64, [from, to]: [f64; 2], following: &[u32]) -> Lanelet {
    let line = Polyline::new([from, to].map(|x| Point::new(x, 0.0, 0.0))).unwrap();
    let mut lanelet = Lanelet::alone(id, [line.clone(), line.clone(), line], 10.0);
    lanelet.following = following.iter().map(|it| LaneletIndex(*it)).collect();
    lanelet
}

/// A road of 100 m that forks into one of 200 m and one of 400 m, which meet before the last 100 m.
fn fork() -> Network {
    let all = vec![
        lanelet(1, [0.0, 100.0], &[1, 2]),
        lanelet(2, [100.0, 300.0], &[3]),
        lanelet(3, [100.0, 500.0], &[3]),
        lanelet(4, [300.0, 400.0], &[]),
    ];
    Network::new(all, DrivingSide::Right).unwrap()
}

fn chain(network: &Network, id: i64) -> ChainIndex {
    let chains = (0..network.chains.len() as u32).map(ChainIndex);
    chains.into_iter().find(|it| network.lanelet_at(Position::new(*it, 0.0)).0.id == id).unwrap()
}

/// A planner for cars.
fn planner<'a>(
    network: &'a Network,
    into: &'a [Into],
    links: &'a Links,
    restrictions: &'a ClassRestrictions,
) -> Planner<'a> {
    Planner { network, into, links, restrictions, restriction: 0 }
}

/// The first lanelet after the fork, the time of the route, and that of the alternative. `slow` gives a lanelet's chain
/// another time than the free one.
fn way(kept: bool, slow: Option<(i64, f64)>) -> (Id, f64, f64) {
    let network = fork();
    let into = beside_into(&network);
    let restrictions = ClassRestrictions::default();
    let mut links = Links::of(&network);
    let free = planner(&network, &into, &links, &restrictions);
    let place = Place::Gate(network.exits[0].clone());
    let mut table = free.plan(&place);
    let times: Vec<f64> = (0..network.chains.len() as u32)
        .map(ChainIndex)
        .map(|it| {
            let usual = free.time(it, network.chain(it).length);
            slow.filter(|(id, _)| chain(&network, *id) == it).map_or(usual, |(_, time)| time)
        })
        .collect();
    links.take(times.into_iter());
    let planner = planner(&network, &into, &links, &restrictions);
    let mut best = planner.plan(&place);
    planner.note_alternatives(&mut best, None);
    planner.retime(&mut table, &place);
    planner.note_alternatives(&mut table, Some(&best));
    let Waypoint { next, time, alternative, .. } = (if kept { table } else { best })[chain(&network, 1).at()];
    (network.lanelet_at(Position::new(next.unwrap(), 0.0)).0.id, time, alternative)
}

#[test]
fn the_alternative_is_the_best_way_over_the_end_of_the_lane_that_is_not_the_own_one() {
    assert_eq!(way(true, None), (2.into(), 40.0, 60.0));
    assert_eq!(way(false, None), (2.into(), 40.0, 60.0));
}

/// A lane of 1,000 m, and a lane on its left from 300 m on.
fn two_lanes() -> Network {
    let beside = |it: Lanelet, left, right| Lanelet { left, right, ..it };
    let index = |it| Some(LaneletIndex(it));
    let all = vec![
        lanelet(1, [0.0, 300.0], &[1]),
        beside(lanelet(2, [300.0, 600.0], &[2]), index(3), None),
        beside(lanelet(3, [600.0, 1000.0], &[]), index(4), None),
        beside(lanelet(4, [300.0, 600.0], &[4]), None, index(1)),
        beside(lanelet(5, [600.0, 1000.0], &[]), None, index(2)),
    ];
    Network::new(all, DrivingSide::Right).unwrap()
}

#[test]
fn nobody_changes_lanes_and_back_wherever_there_is_a_jam() {
    let network = two_lanes();
    let into = beside_into(&network);
    let restrictions = ClassRestrictions::default();
    let [long, short] = [1, 4].map(|id| chain(&network, id));
    let inner = InnerPlace { id: 3.into(), chain: long, station: 950.0 };
    for jammed in 0..5 {
        let mut links = Links::of(&network);
        let times: Vec<f64> = (0..5).map(|it| if it == jammed { 900.0 } else { 30.0 }).collect();
        links.take(times.into_iter());
        let planner = planner(&network, &into, &links, &restrictions);
        let table = planner.plan(&Place::Inside(inner));
        let [here, there] = [long, short].map(|it| table[it.at()]);
        assert_eq!((here.changes, here.via), (0, long), "{jammed}");
        assert_eq!((there.changes, there.via), (1, long), "{jammed}");
        // A driver from the start of the long lane arrives later than one from the start of the short lane.
        assert!(here.time > there.time, "{jammed}: {} {}", here.time, there.time);
        let mut timed = table.clone();
        planner.retime(&mut timed, &Place::Inside(inner));
        assert_eq!(timed[short.at()].time, there.time, "{jammed}");
    }
}

/// A road of 1,000 m, and on its right one of 300 m that forks: one branch leads back beside the long road for 300 m,
/// the other leaves the map.
fn a_way_around() -> Network {
    let beside = |it: Lanelet, left, right| Lanelet { left, right, ..it };
    let index = |it| Some(LaneletIndex(it));
    let all = vec![
        beside(lanelet(1, [0.0, 300.0], &[1]), None, index(3)),
        lanelet(2, [300.0, 600.0], &[2]),
        lanelet(3, [600.0, 1000.0], &[]),
        lanelet(4, [0.0, 300.0], &[4, 5]),
        beside(lanelet(5, [300.0, 600.0], &[]), index(1), None),
        lanelet(6, [300.0, 500.0], &[]),
    ];
    Network::new(all, DrivingSide::Right).unwrap()
}

#[test]
fn no_route_leads_around_a_jam_again_and_again() {
    let network = a_way_around();
    let into = beside_into(&network);
    let restrictions = ClassRestrictions::default();
    let [long, side, branch] = [1, 4, 5].map(|id| chain(&network, id));
    let exit = network.exits.iter().find(|it| it.chains.contains(&long)).unwrap();
    for jam in [30.0, 900.0] {
        let mut links = Links::of(&network);
        let chains = (0..network.chains.len() as u32).map(ChainIndex);
        links.take(chains.map(|it| if it == long { jam } else { 30.0 }));
        let planner = planner(&network, &into, &links, &restrictions);
        let table = planner.plan(&Place::Gate(exit.clone()));
        let ways = [long, side, branch].map(|it| (table[it.at()].changes, table[it.at()].via));
        assert_eq!(ways, [(0, long), (1, branch), (1, long)], "{jam}");
    }
}

#[test]
fn a_change_counts_as_a_detour_the_more_the_less_road_there_is_for_it() {
    let counted = [0.0, 10.0, 30.0, 40.0, 90.0].map(Planner::missed_turn_penalty);
    assert_eq!(counted, [120.0, 90.0, 30.0, 0.0, 0.0]);
}

#[test]
fn with_new_link_times_a_way_is_kept_with_its_new_time_and_the_best_one_is_another() {
    assert_eq!(way(true, Some((2, 100.0))), (2.into(), 120.0, 60.0));
    assert_eq!(way(false, Some((2, 100.0))), (3.into(), 60.0, 120.0));
    assert_eq!(way(true, Some((1, 50.0))), (2.into(), 80.0, 100.0));
}

#[test]
fn a_way_of_its_own_is_kept_where_another_one_is_faster_and_who_leaves_it_goes_there_on_any_way() {
    let network = fork();
    let [first, short, long, last] = [1, 2, 3, 4].map(|id| chain(&network, id));
    let section = CrossSection::new("end".into(), &[Position::new(last, 60.0)]);
    let own = Place::Across(section.clone().reached_over([first, long]));
    let anyhow = Place::Across(section);
    let navigator = Navigator::towards(&network, &[own, anyhow]);
    let [own, anyhow] = [Some(0), Some(1)];
    assert_eq!([own, anyhow].map(|it| navigator.waypoint(it, first).next), [Some(long), Some(short)]);
    assert_eq!([own, anyhow].map(|it| navigator.waypoint(it, first).distance), [560.0, 360.0]);
    assert!(!navigator.waypoint(own, short).leads_there());
    assert_eq!(navigator.nearest(&network, own, short, 10.0), anyhow);
    // Trips end where the line crosses the lane.
    assert_eq!(navigator.trip_ends(last).iter().map(|it| it.station).collect::<Vec<_>>(), [60.0; 2]);
}
