//! Drivers see what stands in a lane from afar, as they see a closed lane: a vehicle that a user drives, and that
//! stands although its driver would go, and an obstacle.

use laneweave_network::{ChainIndex, Network, Position};

use crate::route::roads::Roads;
use crate::route::standing::{Does, Standing};
use crate::state::control::{Control, Longitudinal};
use crate::state::externals::{External, Kind};
use crate::state::lane::VehicleId;
use crate::state::traffic::Traffic;
use crate::step::change_roads::close;
use crate::step::externals::PATIENCE;
use crate::view::scene::Spot;

/// Lets drivers know what stands in lanes now.
pub(crate) fn see_standing(roads: &mut Roads, traffic: &mut Traffic) {
    if traffic.externals().is_empty() && roads.navigator().closures().standing().is_empty() {
        return;
    }
    let (now, before) = (seen(roads.network(), traffic), roads.navigator().closures().standing());
    let stands = |it: &&Standing| it.does != Does::Crawl;
    if !now.iter().filter(stands).eq(before.iter().filter(stands)) {
        close(roads, traffic, |roads| roads.note_standing(now));
    } else if now != before {
        // Where something crawls now, drivers see at their next turns.
        roads.note_standing(now);
    }
    note_passable(roads, traffic);
}

/// Notes since when drivers can go round what stands in lanes.
fn note_passable(roads: &Roads, traffic: &mut Traffic) {
    let (closures, step) = (roads.navigator().closures(), traffic.clock().step);
    for external in traffic.externals_mut().all_mut() {
        let mut places = std::iter::once(&external.at).chain(&external.obstacles);
        let is_passable = places.any(|it| closures.can_be_passed(*it));
        external.passable_since = is_passable.then_some(external.passable_since.unwrap_or(step));
    }
}

/// What stands and what crawls in lanes.
pub(super) fn seen(network: &Network, traffic: &Traffic) -> Vec<Standing> {
    let mut all = standing(traffic);
    all.extend(crawling(network, traffic));
    all
}

/// What stands in lanes. A recorded vehicle goes on as it was recorded.
fn standing(traffic: &Traffic) -> Vec<Standing> {
    let externals = traffic.externals().all();
    let longest = traffic.clock().steps(PATIENCE);
    let idle_for = |it: &External| if it.control.holds_still() { 1 } else { longest };
    let stands = |it: &External| match it.kind {
        Kind::Driven | Kind::Line(_) => it.idle >= idle_for(it),
        Kind::Recorded => false,
        Kind::Obstacle => true,
    };
    let mut found: Vec<bool> = externals.iter().map(stands).collect();
    // Whoever is held behind something that stands, such as the next one of a pile-up, stands there, too: its driver
    // would not go.
    let is_behind = |it: &External, found: &[bool]| {
        it.control.holds_still()
            && leader(traffic, it).is_some_and(|id| {
                let ahead = externals.binary_search_by_key(&id, |it| it.id);
                ahead.is_ok_and(|at| found[at])
            })
    };
    while let Some(at) = (0..found.len()).find(|at| !found[*at] && is_behind(&externals[*at], &found)) {
        found[at] = true;
    }
    externals.iter().zip(found).filter(|it| it.1).flat_map(|it| reaches(traffic, it.0)).collect()
}

/// Vehicles that users hold at less than half of the limit. Drivers look where they are now and then.
fn crawling(network: &Network, traffic: &Traffic) -> Vec<Standing> {
    /// Share of the limit below which a vehicle crawls, and the way after which drivers look again [m]; ours.
    const SLOW: f64 = 0.5;
    const WAY: f64 = 25.0;
    let crawls = |it: &&External| match it.control {
        Control::Drive { longitudinal: Longitudinal::Speed(speed), .. } => {
            speed > 0.0 && speed < SLOW * network.chain(it.at.chain).limit(it.at.x)
        }
        _ => false,
    };
    let crawling = traffic.externals().all().iter().filter(crawls);
    let seen = crawling.flat_map(|it| reaches(traffic, it));
    let rough = |it: Standing| {
        let [rear, front] = it.reach.map(|x| (x / WAY).floor() * WAY);
        Standing { reach: [rear, front + WAY], does: Does::Crawl, ..it }
    };
    seen.map(rough).collect()
}

/// What an external vehicle covers of lanes.
fn reaches(traffic: &Traffic, external: &External) -> Vec<Standing> {
    let does = if matches!(external.kind, Kind::Line(_)) { Does::Rest } else { Does::Stay };
    let of = |chain: ChainIndex, index: usize| {
        let it = &traffic.lane(chain).motions()[index];
        Standing { chain, reach: [it.rear(), it.x], does }
    };
    let mut all = Vec::new();
    if let Some(Spot { chain, index }) = spot(traffic, external) {
        all.push(of(chain, index));
        if let Some(there) = traffic.lane(chain).lane_change_states()[index].counterpart {
            all.extend(traffic.lane(there.chain).find(external.id, there.x).map(|it| of(there.chain, it)));
        }
    }
    let touched = external.obstacles.iter().filter_map(|at| {
        let index = traffic.lane(at.chain).find_obstacle(external.id, at.x)?;
        Some(of(at.chain, index))
    });
    all.extend(touched);
    all
}

/// The main entry of an external vehicle, if it is in a lane.
fn spot(traffic: &Traffic, external: &External) -> Option<Spot> {
    let Position { chain, x } = external.at;
    let index = traffic.lane(chain).find(external.id, x).filter(|_| external.off_road().is_none())?;
    Some(Spot { chain, index })
}

/// The vehicle ahead of an external vehicle that stands, on its lane.
fn leader(traffic: &Traffic, external: &External) -> Option<VehicleId> {
    let Spot { chain, index } = spot(traffic, external)?;
    let motions = traffic.lane(chain).motions();
    (motions[index].speed == 0.0).then(|| motions.get(index + 1).map(|it| it.id)).flatten()
}
