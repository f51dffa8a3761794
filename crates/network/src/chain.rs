//! Chains: maximal fork-free runs of lanelets, the lanes of the simulation.

use crate::class::{Class, Classes};
use crate::geometry::Polyline;
use crate::lanelet::{Lanelet, LaneletIndex, Side};
use serde::{Deserialize, Serialize};

/// A chain's place in [`crate::Network::chains`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ChainIndex(pub u32);

impl ChainIndex {
    /// The place as an index.
    #[inline]
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// A place on a chain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// The chain.
    pub chain: ChainIndex,
    /// Station along it, from its start on [m].
    pub x: f64,
}

impl Position {
    /// The place at station `x` [m] of `chain`.
    #[inline]
    pub fn new(chain: ChainIndex, x: f64) -> Position {
        Position { chain, x }
    }
}

/// A run of lanelets without a fork or a merge, for the same classes of vehicles. Stations run along its centre line
/// from its start [m].
///
/// Fields that drivers read in every step come first in memory, on one cache line: towns have thousands of chains.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Chain {
    /// Length [m].
    pub length: f64,
    /// Station up to which its vehicles still touch those on other branches of a fork behind [m].
    pub fork_clearance: f64,
    /// Chains that continue this one.
    pub following: Vec<ChainIndex>,
    /// Who may use it.
    pub classes: Classes,
    /// The classes for which it ends beside a continuing chain: they have to change lanes. All of them, if it is drawn
    /// so; or those that may not use what follows.
    pub ends_for: Classes,
    /// Somewhere some vehicles may not use it; or it is too narrow for them, so that for them it begins later or ends
    /// earlier than drawn.
    pub is_restricted: bool,
    /// It has bends, or a speed limit below the one before it.
    pub has_slow_places: bool,
    /// From its end to the next bend or lower speed limit on any route [m]; infinite if there is none near.
    pub slow_beyond: f64,
    /// Chains that this one continues.
    pub previous: Vec<ChainIndex>,
    /// Speed limits in order of their start.
    pub limits: Vec<Limit>,
    /// Stretches in built-up areas, in order [m].
    pub in_town: Vec<[f64; 2]>,
    /// Stretches from which a change to the left is allowed, in order.
    pub left: Vec<Beside>,
    /// Stretches from which a change to the right is allowed, in order.
    pub right: Vec<Beside>,
    /// Its lanelets in order.
    pub lanelets: Vec<LaneletIndex>,
    /// Where each lanelet starts [m].
    pub starts: Vec<f64>,
    /// Centre line.
    pub centre: Polyline,
    /// Where it is wide enough to drive on, for cars and for long vehicles: first and last station of a front [m].
    pub open: [[f64; 2]; 2],
    /// On the path through it, it is narrower somewhere than a long vehicle.
    pub is_tight_for_long: bool,
    /// Bends in order.
    pub bends: Vec<Bend>,
    /// The other branches of the forks behind, from which it has not parted at its start.
    pub branches: Vec<ForkBranch>,
}

/// A chain on another branch of a fork. Vehicles with their fronts on it are in each other's way with those on the
/// chain that this belongs to, until their rears have passed the place where the branches part.
#[derive(Clone, Debug, PartialEq)]
pub struct ForkBranch {
    /// The chain.
    pub chain: ChainIndex,
    /// Where it starts, as a station of the chain that this belongs to: both are as far from the fork [m].
    pub start: f64,
    /// Stations on it that rears pass when they are out of the way, for two cars, for a car and a long vehicle, and for
    /// two long ones; negative where this is on a chain before it [m].
    pub until: [f64; 3],
    /// The chains over which vehicles come to it from the fork, the nearest first; the last one is the one that forks.
    pub over: Vec<ChainIndex>,
    /// The chains over which vehicles come from the fork to the chain that this belongs to, likewise.
    pub own_over: Vec<ChainIndex>,
}

/// A speed limit from `start` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Where it begins [m].
    pub start: f64,
    /// The limit [m/s].
    pub speed: f64,
}

/// A stretch of a chain of about the same curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// First station [m].
    pub start: f64,
    /// Last station [m].
    pub end: f64,
    /// Its largest curvature [1/m].
    pub curvature: f64,
}

/// A stretch of a chain beside another chain, with a change allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside {
    /// First station here [m].
    pub start: f64,
    /// Last station here [m].
    pub end: f64,
    /// The chain beside.
    pub chain: ChainIndex,
    /// Station there that lies beside `start` [m].
    pub other_start: f64,
    /// Metres there for one metre here.
    pub scale: f64,
}

impl Beside {
    /// Stretches of a side that are no further apart count as one for a lane change [m]. Ours.
    pub const JOINED: f64 = 1.0;

    /// The station there that lies beside `station` here [m].
    #[inline]
    pub fn across(&self, station: f64) -> f64 {
        self.other_start + (station - self.start) * self.scale
    }

    /// The parts of the stretch outside of those `taken` [m], in order, without pieces too short for a change.
    pub(crate) fn without(&self, mut taken: Vec<[f64; 2]>) -> Vec<Beside> {
        /// Shortest piece [m], and distance to its end from the preceding taken place: a vehicle that comes from
        /// there first has to get its rear out of it. Ours.
        const SHORTEST: f64 = 1.0;
        const SHORTEST_AFTER: f64 = 25.0;
        taken.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let (mut pieces, mut taken_until) = (Vec::new(), f64::NEG_INFINITY);
        for [from, to] in taken.into_iter().chain([[self.end, self.end]]) {
            let (start, end) = (self.start.max(taken_until), from.min(self.end));
            if end - start >= SHORTEST && end - taken_until >= SHORTEST_AFTER {
                pieces.push(Beside { start, end, other_start: self.across(start), ..*self });
            }
            taken_until = taken_until.max(to);
        }
        pieces
    }

    /// The station here that lies beside `station` there [m].
    pub fn back(&self, station: f64) -> f64 {
        self.start + (station - self.other_start) / self.scale
    }
}

impl ForkBranch {
    /// Station on it that a rear passes when the two vehicles, which are long or not, are out of each other's way [m].
    #[inline]
    pub fn until(&self, [one_is_long, other_is_long]: [bool; 2]) -> f64 {
        self.until[usize::from(one_is_long) + usize::from(other_is_long)]
    }
}

impl Chain {
    /// Wide enough for all vehicles over its whole length.
    pub const WIDE: [[f64; 2]; 2] = [[f64::NEG_INFINITY, f64::INFINITY]; 2];

    /// Stretches of lanelets are joined to one as long as no station moves by more than this [m].
    const STRETCH_ERROR: f64 = 0.02;

    /// Stretches from which a change to `side` is allowed.
    #[inline]
    pub fn stretches(&self, side: Side) -> &[Beside] {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// The stretch at `station` from which a change to `side` is allowed.
    #[inline]
    pub fn beside(&self, side: Side, station: f64) -> Option<&Beside> {
        let stretches = self.stretches(side);
        let after = stretches.partition_point(|it| it.start <= station);
        stretches[..after].last().filter(|it| station <= it.end)
    }

    /// Start of the last stretch on which a change is allowed, to either side; stretches that continue each other are
    /// one [m].
    pub fn last_window(&self) -> Option<f64> {
        let begin = |side: Side| {
            let mut begin: Option<f64> = None;
            for stretch in self.stretches(side).iter().rev() {
                if begin.is_some_and(|it| it - stretch.end >= Beside::JOINED) {
                    break;
                }
                begin = Some(stretch.start);
            }
            begin
        };
        Side::BOTH.into_iter().filter_map(begin).reduce(f64::min)
    }

    /// Whether it is wide enough at `station` [m] for a car, or for a long vehicle.
    #[inline]
    pub fn is_open(&self, station: f64, is_long: bool) -> bool {
        let [from, until] = self.open[usize::from(is_long)];
        (from..=until).contains(&station)
    }

    /// Whether a vehicle of `class` may change lanes to it at `station` [m].
    #[inline]
    pub fn takes(&self, station: f64, class: Class) -> bool {
        !self.is_restricted || (self.classes.has(class) && self.is_open(station, class.is_long()))
    }

    /// Whether it ends, as drawn, beside a continuing chain.
    pub fn is_lane_drop(&self) -> bool {
        self.ends_for == Classes::ALL
    }

    /// Last station that a car, or a long vehicle, can use [m]: its end, or where it gets too narrow.
    #[inline]
    pub fn driven_until(&self, is_long: bool) -> f64 {
        self.open[usize::from(is_long)][1].min(self.length)
    }

    /// Speed limit at `station` [m/s].
    #[inline]
    pub fn limit(&self, station: f64) -> f64 {
        let after = self.limits.partition_point(|it| it.start <= station).max(1);
        self.limits[after - 1].speed
    }

    /// Whether `station` lies in a built-up area.
    #[inline]
    pub fn is_in_town(&self, station: f64) -> bool {
        self.in_town.iter().any(|[start, end]| (*start..*end).contains(&station))
    }

    /// Which of its lanelets holds `station`, and how far along that is [m].
    pub fn lanelet(&self, station: f64) -> (LaneletIndex, f64) {
        let after = self.starts.partition_point(|start| *start <= station).max(1);
        (self.lanelets[after - 1], station - self.starts[after - 1])
    }

    /// Joins `lanelets` to a chain; its links are filled in when all chains are known.
    pub(crate) fn of(all: &[Lanelet], lanelets: Vec<LaneletIndex>) -> Chain {
        let mut centre = all[lanelets[0].at()].centre.clone();
        let mut starts = vec![0.0];
        for lanelet in &lanelets[1..] {
            starts.push(centre.length());
            centre.append(&all[lanelet.at()].centre);
        }
        let mut limits: Vec<Limit> = Vec::new();
        for (lanelet, start) in lanelets.iter().zip(&starts) {
            let speed = all[lanelet.at()].speed_limit;
            if limits.last().is_none_or(|last| last.speed != speed) {
                limits.push(Limit { start: *start, speed });
            }
        }
        let ends = starts[1..].iter().copied().chain([f64::INFINITY]);
        let mut in_town: Vec<[f64; 2]> = Vec::new();
        for ((lanelet, start), end) in lanelets.iter().zip(&starts).zip(ends) {
            match in_town.last_mut() {
                _ if !all[lanelet.at()].is_in_town => {}
                Some(last) if last[1] == *start => last[1] = end,
                _ => in_town.push([*start, end]),
            }
        }
        Chain {
            length: centre.length(),
            classes: all[lanelets[0].at()].classes,
            lanelets,
            starts,
            centre,
            limits,
            in_town,
            following: Vec::new(),
            previous: Vec::new(),
            left: Vec::new(),
            right: Vec::new(),
            ends_for: Classes::NONE,
            is_restricted: false,
            has_slow_places: false,
            slow_beyond: f64::INFINITY,
            bends: Vec::new(),
            open: Chain::WIDE,
            is_tight_for_long: false,
            fork_clearance: 0.0,
            branches: Vec::new(),
        }
    }

    /// Station at which lanelet number `place` ends [m].
    pub(crate) fn end_of(&self, place: usize) -> f64 {
        self.starts.get(place + 1).copied().unwrap_or(self.length)
    }
}

/// Adds `next` to `stretches`; it is joined to the last one where it continues it.
pub(crate) fn join(stretches: &mut Vec<Beside>, next: Beside) {
    if let Some(last) = stretches.last_mut() {
        let continues = last.chain == next.chain
            && last.end == next.start
            && (last.across(last.end) - next.other_start).abs() < Chain::STRETCH_ERROR;
        let end_there = next.across(next.end);
        let joined = Beside {
            end: next.end,
            scale: (end_there - last.other_start) / (next.end - last.start),
            ..*last
        };
        if continues && (joined.across(next.start) - next.other_start).abs() < Chain::STRETCH_ERROR {
            *last = joined;
            return;
        }
    }
    stretches.push(next);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_are_changed_where_a_vehicle_has_got_out_of_the_last_junction_and_not_yet_into_the_next() {
        let stretch = Beside { start: 0.0, end: 100.0, chain: ChainIndex(1), other_start: 10.0, scale: 1.0 };
        let pieces = |taken: &[[f64; 2]]| -> Vec<[f64; 2]> {
            stretch.without(taken.to_vec()).iter().map(|it| [it.start, it.end]).collect()
        };
        assert_eq!(pieces(&[]), [[0.0, 100.0]]);
        assert_eq!(pieces(&[[30.0, 60.0]]), [[0.0, 30.0], [60.0, 100.0]]);
        // The path from one to the next is too short, although one is on the chain before.
        assert_eq!(pieces(&[[-20.0, -5.0], [10.0, 30.0], [50.0, 60.0]]), [[60.0, 100.0]]);
        assert_eq!(pieces(&[[-20.0, -5.0], [20.0, 60.0]]), [[0.0, 20.0], [60.0, 100.0]]);
        assert_eq!(stretch.without(vec![[0.0, 60.0]])[0].other_start, 70.0);
    }
}
