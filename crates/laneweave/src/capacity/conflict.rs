//! How full junctions without lights are.

use laneweave_models::yielding::time_to_cover;
use laneweave_network::{ChainIndex, Precedence, Zone, ZoneKind};

use super::{Bottleneck, Load, Roads};

/// The loads of junctions without lights (the conflict technique of Wu, 2000, Brilon and Wu, 2001): of movements that all get in each
/// other's way only one can be on the junction. Who goes first keeps its headway; the others come from rest, and take the time
/// until their rears are clear.
pub(super) fn loads(roads: &Roads) -> Vec<Load> {
    let movements = movements(roads);
    let load = |first: usize| {
        let share = clique(&movements, first).into_iter().map(|it| movements[it].share).sum();
        Load {
            share,
            of: Bottleneck::Junction(roads.lanelet(movements[first].chain, movements[first].start.max(0.0))),
        }
    };
    (0..movements.len()).map(load).collect()
}

/// A way through a junction.
struct Movement {
    chain: ChainIndex,
    /// Where its first zone begins, and its last one ends [m].
    start: f64,
    end: f64,
    /// Its zones, each with its side of it.
    zones: Vec<(usize, usize)>,
    /// Those that get in its way.
    rivals: Vec<usize>,
    /// Of all the time, what its vehicles take.
    share: f64,
}

/// All movements through zones that no lights guard, those that take most of the time first.
fn movements(roads: &Roads) -> Vec<Movement> {
    /// Zones further apart are of different junctions [m].
    const APART: f64 = 25.0;
    let junctions = &roads.network.junctions;
    let is_lit = junctions.lit_sides(roads.network);
    let mut all: Vec<Movement> = Vec::new();
    for chain in roads.chains() {
        for crossing in &junctions.on(chain).crossings {
            let (zone, side) = (crossing.zone.at(), usize::from(crossing.side));
            // Lights part those who meet.
            if junctions.zones[zone].kind == ZoneKind::Tight || is_lit[zone] == [true; 2] {
                continue;
            }
            let reach = junctions.reach(*crossing);
            let end = match junctions.zones[zone].kind {
                ZoneKind::Merging(stations) => stations[side],
                ZoneKind::Crossing | ZoneKind::Tight => reach.end,
            };
            match all.last_mut().filter(|it| it.chain == chain && reach.start < it.end + APART) {
                Some(last) => {
                    last.end = last.end.max(end);
                    last.zones.push((zone, side));
                }
                None => {
                    let (start, zones) = (reach.start, vec![(zone, side)]);
                    all.push(Movement { chain, start, end, zones, rivals: Vec::new(), share: 0.0 });
                }
            }
        }
    }
    all.iter_mut().for_each(|it| it.share = share(roads, &junctions.zones, it));
    all.sort_by(|a, b| b.share.total_cmp(&a.share));
    let mut on_side = vec![[usize::MAX; 2]; junctions.zones.len()];
    for (movement, number) in all.iter().zip(0..) {
        movement.zones.iter().for_each(|(zone, side)| on_side[*zone][*side] = number);
    }
    for movement in &mut all {
        movement.rivals = movement.zones.iter().map(|(zone, side)| on_side[*zone][1 - side]).collect();
    }
    all
}

/// Of all the time, what the vehicles of `movement` take.
fn share(roads: &Roads, zones: &[Zone], movement: &Movement) -> f64 {
    let Movement { chain, start, end, .. } = *movement;
    let [_, flow] = roads.assignment.flow(chain, start.max(0.0));
    let mixture = roads.mixture(roads.network.chain(chain).limit(start));
    let goes_first = |(zone, side): &(usize, usize)| zones[*zone].precedence == Precedence::Side(*side as u8);
    let from_rest = |length: f64, desired: f64| time_to_cover(end - start + length, 0.0, desired);
    let time = if movement.zones.iter().all(goes_first) {
        1.0 / mixture.stream()
    } else {
        mixture.mean_of(from_rest)
    };
    flow * time
}

/// Movements that all get in each other's way: the `first`, and as many of the others as can be, those that take most of the time
/// before the others.
fn clique(movements: &[Movement], first: usize) -> Vec<usize> {
    let mut members = vec![first];
    let mut rivals = movements[first].rivals.clone();
    rivals.sort_unstable();
    rivals.dedup();
    for rival in rivals.into_iter().filter(|it| *it < movements.len() && *it != first) {
        if members.iter().all(|it| movements[*it].rivals.contains(&rival)) {
            members.push(rival);
        }
    }
    members
}
