//! The open lanes beside what closes a lane.

use laneweave_network::{Class, Network, Position, Side};

use crate::route::standing::Standing;

/// For each side the number of lanes to the next one that is open beside a closed stretch, and the place there.
pub(super) type OpenLanes = [Option<(u32, Position)>; 2];

/// The part of the lane `at` a place beside the rear of something of this `length` [m] where nothing may stand if the
/// lane is open.
pub(super) fn beside(at: Position, length: f64) -> [f64; 2] {
    [at.x - Standing::ROOM_BESIDE, at.x + length + Standing::ROOM_BEYOND]
}

/// The place on its own lane by which drivers have to be on their way out of the lane of `it`, if its `way_out` is
/// there and these lanes are `open` [m]: earlier than that, if something else stands before in a lane between.
pub(super) fn lanes_left_by(
    network: &Network,
    it: &Standing,
    way_out: f64,
    open: &OpenLanes,
    standing: &[Standing],
) -> f64 {
    let [rear, front] = [way_out, it.reach[1]].map(|x| x.max(0.0));
    let sides = Side::BOTH.into_iter().zip(open).filter_map(|(side, open)| Some((side, open.as_ref()?.0)));
    let Some((side, lanes)) = sides.min_by_key(|it| it.1) else { return way_out };
    let between = lanes_beside(network, Position::new(it.chain, rear), side).take(lanes as usize - 1);
    let earlier = between.flat_map(|at| {
        let reach = beside(at, front - rear);
        let there = move |it: &&Standing| it.chain == at.chain && overlap(it.reach, reach);
        standing.iter().filter(there).map(move |it| it.reach[0] - at.x)
    });
    way_out + earlier.fold(0.0, f64::min)
}

/// The number of lanes from a place to the next one on a `side` that is open, and the place there. It is a lane for
/// cars, or for all that may use the own one.
pub(super) fn next_lane(
    network: &Network,
    at: Position,
    side: Side,
    is_open: impl Fn(&Position) -> bool,
) -> Option<(u32, Position)> {
    let classes = |at: &Position| network.chain(at.chain).classes;
    let takes_cars = |it: &Position| classes(it).has(Class::Car) || classes(it).include(classes(&at));
    let mut lanes = lanes_beside(network, at, side).zip(1..);
    lanes.find(|(at, _)| takes_cars(at) && is_open(at)).map(|(at, count)| (count, at))
}

/// The places beside `at` on the lanes of a `side`, the nearest first.
fn lanes_beside(network: &Network, at: Position, side: Side) -> impl Iterator<Item = Position> + '_ {
    let beside = move |at: &Position| {
        let beside = network.chain(at.chain).beside(side, at.x)?;
        Some(Position::new(beside.chain, beside.across(at.x)))
    };
    std::iter::successors(beside(&at), beside)
}

/// Whether two stretches have a part in common.
pub(super) fn overlap([from, until]: [f64; 2], [other_from, other_until]: [f64; 2]) -> bool {
    from < other_until && other_from < until
}

/// The place `distance` [m] before `at`, on its chain or on the only one before it.
pub(super) fn back(network: &Network, at: Position, distance: f64) -> Option<Position> {
    let x = at.x - distance;
    if x >= 0.0 {
        return Some(Position::new(at.chain, x));
    }
    let [before] = network.chain(at.chain).previous[..] else { return None };
    let x = network.chain(before).length + x;
    (x >= 0.0).then_some(Position::new(before, x))
}
