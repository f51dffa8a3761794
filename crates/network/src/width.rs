//! Where lanes are wide enough. A lane that opens, or narrows to nothing, begins and ends for a vehicle where it is
//! as wide as the vehicle.

use crate::chain::{Chain, ChainIndex};
use crate::class::{Class, Classes};
use crate::gate::Gate;
use crate::lanelet::Lanelet;

/// Width of a car, and of the widest long vehicle [m].
pub(crate) const BODIES: [f64; 2] = [Class::Car.body().width, Class::Bus.body().width];
/// Length of a car, and of a long vehicle [m].
const LENGTHS: [f64; 2] = [Class::Car.body().length, Class::Bus.body().length];
/// Widths are compared at stations this far apart [m].
const STEP: f64 = 0.5;
/// Every vehicle that can reach a lane that ends can leave it. This is the minimum length of road with lane changes,
/// on which the lane gets no narrower than lanes are drawn [m]. Ours.
pub(crate) const LEAST_WINDOW: f64 = 5.0;
/// A lane that is nowhere wider than this was drawn without a width [m].
const NO_WIDTH: f64 = 0.01;

/// Closes to long vehicles the lanes that end beside others, `lane_drops`, and are nowhere as wide as they: with one
/// beside them, they could never leave it.
pub(crate) fn close_to_long(chains: &mut [Chain], lanelets: &[Lanelet], lane_drops: &[ChainIndex]) {
    let long: Classes = Class::ALL.into_iter().filter(|it| it.is_long()).collect();
    for index in lane_drops {
        let chain = &mut chains[index.at()];
        let widest = widths(chain, lanelets).iter().map(|it| it.1).fold(0.0, f64::max);
        if (BODIES[0]..BODIES[1]).contains(&widest) {
            chain.classes = chain.classes.without(long);
        }
    }
}

/// Computes for each chain where it is wide enough. A lane that begins or ends beside others, or that is too narrow
/// for cars and leads nowhere, begins and ends according to its width. Any other lane is open to all, but counts as
/// narrow for long vehicles where it is narrower than they are.
pub(crate) fn note_open(chains: &mut [Chain], lanelets: &[Lanelet], [entrances, exits]: [&[Gate]; 2]) {
    let [is_entrance, is_exit] = [entrances, exits].map(|gates| {
        let mut is_gate = vec![false; chains.len()];
        gates.iter().flat_map(|it| &it.chains).for_each(|it: &ChainIndex| is_gate[it.at()] = true);
        is_gate
    });
    for (index, chain) in chains.iter_mut().enumerate() {
        if is_wide(chain, lanelets) {
            continue;
        }
        let widths = widths(chain, lanelets);
        if widths.iter().all(|(_, it)| *it < NO_WIDTH || *it >= BODIES[1]) {
            continue;
        }
        let leads_nowhere = widths.iter().all(|(_, it)| *it < BODIES[0]);
        let opens = chain.previous.is_empty() && (leads_nowhere || !is_entrance[index]);
        let closes = chain.following.is_empty() && (leads_nowhere || !is_exit[index]);
        let left_by = chain.last_window().map_or(f64::NEG_INFINITY, |start| start + LEAST_WINDOW);
        chain.open = BODIES.map(|body| open(&widths, body, [opens, closes], left_by));
        // Where a lane begins beside another one, a front is there once the whole body has room.
        chain.open.iter_mut().zip(LENGTHS).for_each(|(open, length)| open[0] += length);
        let [from, until] = chain.open[1];
        let through = widths.iter().filter(|(station, _)| (from..=until).contains(station));
        chain.is_tight_for_long = through.map(|it| it.1).fold(f64::INFINITY, f64::min) < BODIES[1];
        chain.is_restricted |= chain.is_tight_for_long || chain.open != Chain::WIDE;
    }
}

/// First and last station at which a lane of these `widths` is as wide as a body, where it therefore begins or ends
/// [m]. It does not end before `left_by`, however narrow it is.
fn open(widths: &[(f64, f64)], body: f64, [opens, closes]: [bool; 2], left_by: f64) -> [f64; 2] {
    const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
    let mut wide = widths.iter().filter(|it| it.1 >= body).map(|it| it.0);
    let first = wide.next();
    let [from, until] = first.map_or(NOWHERE, |it| [it, wide.next_back().unwrap_or(it)]);
    let end = widths.last().map_or(0.0, |it| it.0);
    let until = until.max(left_by);
    [
        if opens && from > 0.0 { from } else { f64::NEG_INFINITY },
        if closes && until < end { until } else { f64::INFINITY },
    ]
}

/// Whether a few samples show that a chain is clearly wide enough for all.
fn is_wide(chain: &Chain, lanelets: &[Lanelet]) -> bool {
    /// Distance between these samples [m], and the width that they must show [m].
    const APART: f64 = 10.0;
    const BY_FAR: f64 = BODIES[1] + 0.25;
    chain.lanelets.iter().all(|index| {
        let lanelet = &lanelets[index.at()];
        let pieces = (lanelet.length() / APART).ceil().max(1.0) as usize;
        let stations = (0..=pieces).map(|it| lanelet.length() * it as f64 / pieces as f64);
        stations.into_iter().all(|it| lanelet.clear_width(it) >= BY_FAR)
    })
}

/// Stations of a chain, with its width there [m].
fn widths(chain: &Chain, lanelets: &[Lanelet]) -> Vec<(f64, f64)> {
    let pieces = (chain.length / STEP).ceil().max(1.0) as usize;
    let stations = (0..=pieces).map(|it| chain.length * it as f64 / pieces as f64);
    stations
        .map(|station| {
            let (lanelet, along) = chain.lanelet(station);
            (station, lanelets[lanelet.at()].clear_width(along))
        })
        .collect()
}
