//! The movements through junctions without lights, and the time that they take.

use std::collections::BTreeMap;

use laneweave_models::yielding::{MARGIN, time_to_cover};
use laneweave_network::{ChainIndex, Network, Precedence, Touch, ZoneKind};
use laneweave_sim::{Assignment, STANDS_BEFORE_A_LINE, STANDS_BEFORE_A_ZONE};

use super::{Queues, curvature};

/// A movement through a junction.
#[derive(Clone)]
pub(super) struct Movement {
    pub(super) chain: ChainIndex,
    /// Begin of its first zone, and end of its last one [m].
    pub(super) start: f64,
    end: f64,
    /// Its zones, each with its side of it.
    zones: Vec<(usize, usize)>,
    /// The movements that conflict with it.
    pub(super) rivals: Vec<usize>,
    /// Those of them that only join its lane, in turns: one follows the other there.
    joins: Vec<usize>,
    /// Its flow [veh/s].
    pub(super) flow: f64,
    /// The flow with priority over it [veh/s].
    pub(super) before: f64,
    /// The movements among them that give way to others.
    pub(super) waits_for: Vec<usize>,
    /// Critical gap in them [s], and that of drivers who only join a lane.
    pub(super) gap: f64,
    critical_gap: f64,
    /// Time between two vehicles that join a lane one after the other [s].
    joining: f64,
    /// Follow-up time: between two vehicles that go one after the other [s].
    pub(super) follow_up: f64,
    /// Time for which each vehicle keeps others away [s].
    time: f64,
}

impl Movement {
    /// The share of time that its vehicles take.
    pub(super) fn share(&self) -> f64 {
        self.flow * self.time
    }

    /// The share of time that its vehicles take beside those of `others`, each of which conflicts with it. Where they
    /// keep others away for long, such as on a street with one lane for both directions, two go one behind the other.
    pub(super) fn share_beside(&self, mut others: impl Iterator<Item = usize>) -> f64 {
        /// So many follow-up times are long (ours: simulated streets of 250 to 350 m carry two to three times as much
        /// as if vehicles went one by one, and junctions no more).
        const LONG: f64 = 4.0;
        let time = match () {
            () if others.all(|it| self.joins.contains(&it)) => self.joining,
            () if self.time > LONG * self.follow_up => 0.5 * (self.time + self.follow_up),
            () => self.time,
        };
        self.flow * time
    }
}

/// All movements through zones without lights, in the order of their chains; yet without flow. `is_lit` says for each
/// zone and each of its sides whether its drivers pass a light.
pub(super) fn movements(network: &Network, queues: &Queues, is_lit: &[[bool; 2]]) -> Vec<Movement> {
    let mut all = in_order_of_chains(network, is_lit);
    all.iter_mut().for_each(|it| take_time(network, queues, it));
    all
}

/// These `movements` with the flows of an `assignment`, those with the largest shares of time first.
pub(super) fn with_flows(
    network: &Network,
    movements: &[Movement],
    assignment: &Assignment,
) -> Vec<Movement> {
    let mut all = movements.to_vec();
    all.iter_mut().for_each(|it| it.flow = assignment.flow(it.chain, it.start.max(0.0))[1]);
    all.sort_by(|a, b| b.share().total_cmp(&a.share()));
    meet(network, &mut all);
    all
}

fn in_order_of_chains(network: &Network, is_lit: &[[bool; 2]]) -> Vec<Movement> {
    /// Zones further apart belong to different junctions [m].
    const APART: f64 = 25.0;
    let junctions = &network.junctions;
    let mut all: Vec<Movement> = Vec::new();
    for chain in (0..network.chains.len() as u32).map(ChainIndex) {
        for crossing in &junctions.on(chain).crossings {
            let (zone, side) = (crossing.zone.at(), usize::from(crossing.side));
            // Lights separate vehicles whose paths meet.
            if junctions.zones[zone].touch != Touch::Any || is_lit[zone] == [true; 2] {
                continue;
            }
            let reach = junctions.reach(*crossing);
            let end = match junctions.zones[zone].kind {
                ZoneKind::Merging(stations) => stations[side],
                ZoneKind::Crossing => reach.end,
            };
            match all.last_mut().filter(|it| it.chain == chain && reach.start < it.end + APART) {
                Some(last) => {
                    last.end = last.end.max(end);
                    last.zones.push((zone, side));
                }
                None => all.push(Movement {
                    chain,
                    start: reach.start,
                    end,
                    zones: vec![(zone, side)],
                    rivals: Vec::new(),
                    joins: Vec::new(),
                    flow: 0.0,
                    before: 0.0,
                    waits_for: Vec::new(),
                    gap: 0.0,
                    critical_gap: 0.0,
                    joining: 0.0,
                    follow_up: 0.0,
                    time: 0.0,
                }),
            }
        }
    }
    all
}

/// Mean delay before a start [s], at the usual steps of 0.1 s: a driver that gives way gets its reservation at the end
/// of the step in which the zones become free, and starts in the next one.
const NOTICES_AFTER: f64 = 0.05;

/// Sets the times of `movement`: with priority, vehicles keep their headway; otherwise they start from rest, and keep
/// others away until their rears are clear.
fn take_time(network: &Network, queues: &Queues, movement: &mut Movement) {
    let (limit, curvature) = limits(network, movement);
    let headway = 1.0 / queues.stream(limit, curvature);
    let zones = &network.junctions.zones;
    let goes_first = |(zone, side): &(usize, usize)| zones[*zone].precedence == Precedence::Side(*side as u8);
    if movement.zones.iter().all(goes_first) {
        (movement.follow_up, movement.time) = (headway, headway);
        return;
    }
    let distance = movement.end - movement.start + stands_before(network, movement);
    let mixture = queues.mixture(limit, curvature);
    let covers = mixture.mean_of(|length, desired| time_to_cover(distance + length, 0.0, desired));
    movement.time = MARGIN + covers + NOTICES_AFTER;
    movement.critical_gap = mixture.critical_gap();
    movement.gap = movement.critical_gap.max(movement.time);
    // They do not start from rest.
    movement.joining = headway + NOTICES_AFTER;
    movement.follow_up = (1.0 / mixture.starts()).max(headway) + NOTICES_AFTER;
}

/// The limit [m/s] at the begin of a movement, and its largest curvature [1/m].
fn limits(network: &Network, movement: &Movement) -> (f64, f64) {
    let Movement { chain, start, end, .. } = *movement;
    (network.chain(chain).limit(start), curvature(network, chain, [start, end]))
}

/// Distance before its first zone at which `movement` starts from rest: at the zone, or at a line before it [m].
fn stands_before(network: &Network, movement: &Movement) -> f64 {
    /// A line further away does not belong to the junction [m].
    const NEAR: f64 = 30.0;
    let [before] = network.chain(movement.chain).previous[..] else { return STANDS_BEFORE_A_ZONE };
    let length = network.chain(before).length;
    let line = network.junctions.on(before).stops.last();
    let distance = line.map(|it| length - it.station + movement.start).filter(|it| *it < NEAR);
    distance.map_or(STANDS_BEFORE_A_ZONE, |it| it + STANDS_BEFORE_A_LINE)
}

/// The share of vehicles that go before one which takes turns with them.
const IN_TURNS: f64 = 0.5;

/// Sets the conflicts and the priorities of the movements. Of a movement with which one takes turns, every other
/// vehicle has priority.
fn meet(network: &Network, all: &mut [Movement]) {
    let zones = &network.junctions.zones;
    let mut on_side = vec![[usize::MAX; 2]; zones.len()];
    for (movement, number) in all.iter().zip(0..) {
        movement.zones.iter().for_each(|(zone, side)| on_side[*zone][*side] = number);
    }
    for number in 0..all.len() {
        let mut rivals: BTreeMap<usize, f64> = BTreeMap::new();
        let mut crosses: Vec<usize> = Vec::new();
        for (zone, side) in &all[number].zones {
            let rival = on_side[*zone][1 - side];
            let before = match zones[*zone].precedence {
                Precedence::Side(first) if usize::from(first) == *side => 0.0,
                Precedence::Side(_) => 1.0,
                Precedence::Arrival | Precedence::FromTheRight(_) => IN_TURNS,
            };
            if rival < all.len() && rival != number {
                let noted = rivals.entry(rival).or_insert(before);
                *noted = before.max(*noted);
                if !matches!(zones[*zone].kind, ZoneKind::Merging(_)) || before != IN_TURNS {
                    crosses.push(rival);
                }
            }
        }
        all[number].before = rivals.iter().map(|(rival, share)| share * all[*rival].flow).sum();
        all[number].waits_for = rivals.iter().filter(|it| *it.1 == 1.0).map(|it| *it.0).collect();
        all[number].joins = rivals.keys().filter(|it| !crosses.contains(it)).copied().collect();
        all[number].rivals = rivals.into_keys().collect();
        if !all[number].rivals.is_empty() && crosses.is_empty() {
            (all[number].gap, all[number].follow_up) = (all[number].critical_gap, all[number].joining);
        }
    }
    let gives_way: Vec<bool> = all.iter().map(|it| it.before > 0.0).collect();
    all.iter_mut().for_each(|it| it.waits_for.retain(|other| gives_way[*other]));
}
