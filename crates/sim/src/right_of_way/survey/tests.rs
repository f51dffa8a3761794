use laneweave_generate::own_maps;
use laneweave_maps::{Drawing, regulations};
use laneweave_network::{
    DrivingSide, Lanelet, LaneletIndex, Network, Point, Polyline, Regulations, StopKind, StopRule, Touch,
    ZoneKind,
};

use super::*;
use crate::route::navigate::Navigator;
use crate::route::place::{InnerPlace, Place as TripEnd};
use crate::state::some_style::some_style;
use crate::state::vehicle::Class;
use crate::view::snapshot::{Seen, Snapshot};

/// A standing truck.
pub(crate) fn standing() -> Seen {
    Seen {
        id: 1,
        chain: ChainIndex(0),
        x: 0.0,
        speed: 0.0,
        acceleration: 0.0,
        length: 12.0,
        class: Class::Truck,
        parameters: 0,
        desired: 8.0,
        destination: None,
        change: None,
    }
}

#[test]
fn a_vehicle_counts_on_standing_where_its_front_and_its_rear_will_be_and_nowhere_else() {
    let (_, drawing) = own_maps().unwrap().into_iter().find(|it| it.0 == "roundabout.osm").unwrap();
    let network = regulated(&drawing);
    let navigator = Navigator::new(&network);
    let mut surveyed = 0;
    for number in 0..6000_u32 {
        let destination = Some((number % 4) as u16);
        let chain = ChainIndex(number % network.chains.len() as u32);
        let x = network.chain(chain).length * f64::from(number) / 6000.0;
        let truck = Seen { chain, x, destination, ..standing() };
        let snapshot = Snapshot::new(&network, [truck]);
        let styles = [some_style()];
        let scene = snapshot.scene(&network, &navigator, &styles);
        let (spot, mut out) = (snapshot.spot(1).unwrap(), Survey::default());
        if !survey(&scene, &Applicant::at(&scene, spot), [0.0, 30.0], |_, _| false, &mut out) {
            continue;
        }
        let from = scene.viewpoint(spot);
        let last = sections(&scene, from, &out).last().unwrap();
        surveyed += 1;
        assert_eq!(
            last.chain,
            chain_at(&scene, from, out.extent).chain,
            "{chain:?} at {x} m to {destination:?}"
        );
    }
    assert!(surveyed > 100, "{surveyed}");
}

/// Visits the surveys of standing vehicles all over a network.
fn survey_all_over(network: &Network, mut visit: impl FnMut(&Scene, &Applicant, &Survey)) {
    let navigator = Navigator::new(network);
    for number in 0..400_u32 {
        let chain = ChainIndex(number % network.chains.len() as u32);
        let x = network.chain(chain).length * f64::from(number) / 400.0;
        let destination = Some((number % network.exits.len() as u32) as u16);
        let class = if number % 2 == 0 { Class::Truck } else { Class::Car };
        let length = class.body().length;
        let seen = Seen { chain, x, length, class, destination, ..standing() };
        let snapshot = Snapshot::new(network, [seen]);
        let styles = [some_style()];
        let scene = snapshot.scene(network, &navigator, &styles);
        let applicant = Applicant::at(&scene, snapshot.spot(1).unwrap());
        let mut out = Survey::default();
        if survey(&scene, &applicant, [0.0, 40.0], |_, _| false, &mut out) {
            visit(&scene, &applicant, &out);
        }
    }
}

pub(crate) fn regulated(drawing: &Drawing) -> Network {
    let map = drawing.build().unwrap();
    let rules = regulations(&map);
    map.network.regulated(&rules)
}

#[test]
fn every_zone_within_the_extent_of_a_reservation_is_held_however_far_on_random_maps() {
    let mut surveyed = 0;
    for seed in 1..=12 {
        let network = regulated(&laneweave_generate::random(seed).drawing);
        survey_all_over(&network, |scene, applicant, out| {
            surveyed += 1;
            points(scene, applicant.from, &Cell::new(out.extent), |point, at, _| {
                if let What::Zone(crossing, ..) = point.what {
                    let is_held =
                        out.holds.iter().any(|it| (it.zone, it.side) == (crossing.zone, crossing.side));
                    assert!(is_held, "seed {seed}: {crossing:?} at {at} of {} m", out.extent);
                }
                ControlFlow::Continue(())
            });
        });
    }
    assert!(surveyed > 200, "{surveyed}");
}

/// A road of 200 m across two others, 25 m apart, with a line beyond the first of them.
fn two_crossings(line: f64) -> Network {
    let lane = |id, from: [f64; 2], to: [f64; 2], aside: [f64; 2]| {
        let border = |by: f64| {
            let points = [from, to].map(|[x, y]| Point::new(x + by * aside[0], y + by * aside[1], 0.0));
            Polyline::new(points).unwrap()
        };
        Lanelet::alone(id, [1.5, -1.5, 0.0].map(border), 10.0)
    };
    let northward = |id, x| lane(id, [x, -50.0], [x, 50.0], [-1.0, 0.0]);
    let road = lane(1, [0.0, 0.0], [200.0, 0.0], [0.0, 1.0]);
    let line = [-2.0, 2.0].map(|y| Point::new(line, y, 0.0)).to_vec();
    let stop =
        StopRule { id: 9.into(), kind: StopKind::Line, lanelets: vec![LaneletIndex(0)], lines: vec![line] };
    let lanelets = vec![road, northward(2, 50.0), northward(3, 75.0)];
    let network = Network::new(lanelets, DrivingSide::Right).unwrap();
    network.regulated(&Regulations { stops: vec![stop], ..Regulations::default() })
}

#[test]
fn a_reservation_leads_over_every_line_before_which_the_rear_would_still_stand_in_a_zone() {
    let drawings = (1..=12).map(|it| laneweave_generate::random(it).drawing);
    let own = own_maps().unwrap().into_iter().map(|it| it.1);
    let drawn = drawings.chain(own).map(|it| regulated(&it));
    // A truck has left the first crossing when its front is at about 64 m.
    let lines = [55.0, 58.0, 61.0, 63.0, 64.0, 65.0, 68.0].map(two_crossings);
    for network in drawn.chain(lines) {
        survey_all_over(&network, |scene, applicant, out| {
            let next = stop_ahead(scene, applicant.from, out.extent, out.extent + 20.0);
            // Where lanes lead side by side, a zone ends where the longest vehicle has left it: others are out before.
            let is_beside = |it: &&ZoneReservation| {
                let zone = &network.junctions.zones[it.zone.at()];
                matches!(zone.kind, ZoneKind::Merging(_)) && zone.touch != Touch::Any
            };
            for hold in out.holds.iter().filter(|it| !is_beside(it)) {
                let is_out = next.is_none_or(|it| hold.leave <= it.stop - ROOM_AT_A_STOP);
                assert!(is_out, "{applicant:?}: {hold:?}, next stop at {:?}", next.map(|it| it.stop));
            }
        });
    }
}

#[test]
fn the_next_place_to_stop_is_the_nearest_of_those_that_are_still_ahead() {
    let network = two_crossings(64.0);
    let navigator = Navigator::new(&network);
    let chain = network.start_of(LaneletIndex(0)).chain;
    let snapshot = Snapshot::new(&network, [Seen { chain, x: 10.0, ..standing() }]);
    let styles = [some_style()];
    let scene = snapshot.scene(&network, &navigator, &styles);
    let leg = chain_at(&scene, scene.viewpoint(snapshot.spot(1).unwrap()), 0.0);
    let next = |distance: f64| next_place(&scene, leg, distance, Class::Truck);
    // The roads, 3 m wide, cross 40 and 65 m ahead, and the line lies 54 m ahead.
    assert!((35.0..37.6).contains(&next(0.0)), "{}", next(0.0));
    assert!((next(45.0) - (54.0 - BEFORE_A_LINE)).abs() < 1e-9, "{}", next(45.0));
    assert!((60.0..62.6).contains(&next(54.0)), "{}", next(54.0));
    assert_eq!(next(65.0), f64::INFINITY);
}

#[test]
fn nobody_has_to_stop_for_what_lies_beyond_the_end_of_its_trip() {
    let network = two_crossings(64.0);
    let chain = network.start_of(LaneletIndex(0)).chain;
    // One trip ends between the line at 64 m and the road at 75 m, and one beyond that.
    let ends = [67.0, 150.0].map(|station| TripEnd::Inside(InnerPlace { id: 1.into(), chain, station }));
    let navigator = Navigator::towards(&network, &ends);
    let styles = [some_style()];
    let stop_of = |x: f64, destination: u16| {
        let seen = Seen { chain, x, destination: Some(destination), ..standing() };
        let snapshot = Snapshot::new(&network, [seen]);
        let scene = snapshot.scene(&network, &navigator, &styles);
        let from = scene.viewpoint(snapshot.spot(1).unwrap());
        let stop = stop_ahead(&scene, from, 0.0, 40.0).map(|it| x + it.stop);
        assert_eq!(is_place_ahead(&scene, from, 40.0), stop.is_some());
        stop
    };
    for destination in [0, 1] {
        let line = stop_of(60.0, destination).expect("the line is ahead");
        assert!((line - (64.0 - BEFORE_A_LINE)).abs() < 1e-9, "{line}");
    }
    assert_eq!(stop_of(65.0, 0), None);
    let crossing = stop_of(65.0, 1).expect("it has to pass the road");
    assert!((70.0..72.6).contains(&crossing), "{crossing}");
}
