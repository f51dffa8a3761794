//! What comes of a demand that grows: which part of the map is full first, what each origin bears, and how many
//! vehicles get through.

use laneweave_network::Network;
use laneweave_sim::{Assignment, InnerPlace, Thinning};
use laneweave_study::units::SECONDS_PER_HOUR;

use super::lights::Equivalents;
use super::movement::{self, Movement};
use super::tight::{self, Tight};
use super::{Bottleneck, Capacity, Load, Queues, Roads, conflict, lanes, lights, town};

/// Loads that differ by no more than this share are equal.
const ROUNDED: f64 = 1e-6;

/// The map, the routes of the demand, and its drivers.
pub(crate) struct Growth<'a> {
    /// Its roads, with the programs of the lights.
    network: &'a Network,
    /// The assignment of these demands of the origins [veh/h], if not all pass everywhere.
    assign: &'a dyn Fn(&[f64], &Thinning) -> Assignment,
    inner_places: &'a [InnerPlace],
    queues: &'a Queues,
    movements: Vec<Movement>,
    tight: Vec<Tight>,
}

impl<'a> Growth<'a> {
    /// That of the drivers of `queues` on `network`, with the assignments that `assign` makes.
    pub(crate) fn new(
        network: &'a Network,
        assign: &'a dyn Fn(&[f64], &Thinning) -> Assignment,
        inner_places: &'a [InnerPlace],
        queues: &'a Queues,
    ) -> Growth<'a> {
        let is_lit = network.lit_sides();
        let movements = movement::movements(network, queues, &is_lit);
        let tight = tight::places(network, queues, &is_lit);
        Growth { network, assign, inner_places, queues, movements, tight }
    }

    /// The estimated capacity for demands in proportion to `rates`.
    pub(crate) fn capacity(&self, rates: &[f64]) -> Capacity {
        /// The demand, as a multiple of that which fills the first part, at which the most get through: some parts
        /// take in more then, and others are not yet blocked (ours).
        const GROWTHS: [f64; 2] = [1.4, 2.0];
        /// Of what more would get through if queues blocked nobody else, this share does (ours; chosen on the random
        /// maps 1 to 300).
        const PAST_QUEUES: f64 = 0.7;
        let assignment = (self.assign)(rates, &Thinning::default());
        let Some(full) = self.fullest(&assignment) else {
            return Capacity { veh_h: 0.0, queues_from_veh_h: 0.0, bottleneck: None };
        };
        let from = assignment.total / full.share * SECONDS_PER_HOUR;
        let most = match full.of {
            Bottleneck::Town => from,
            _ => GROWTHS.map(|it| self.arriving(rates, it / full.share)).into_iter().fold(0.0, f64::max),
        };
        let queues_from_veh_h = from.min(most);
        let veh_h = queues_from_veh_h + PAST_QUEUES * (most - queues_from_veh_h);
        Capacity { veh_h, queues_from_veh_h, bottleneck: Some(full.of) }
    }

    /// The flow to all destinations if `growth` times these `rates` come, and before each part that is overfull some
    /// wait [veh/h]. Queues block nobody else.
    fn arriving(&self, rates: &[f64], growth: f64) -> f64 {
        /// Where streams wait for each other, the flows settle within these; before the last ones they take turns.
        const ROUNDS: u32 = 8;
        const SETTLING: u32 = 3;
        let rates: Vec<f64> = rates.iter().map(|it| growth * it).collect();
        let mut thinning = Thinning::default();
        for round in 0..ROUNDS {
            let mut next = Thinning::default();
            self.with_loads(&(self.assign)(&rates, &thinning), |_, _, loads| {
                for load in loads.filter(|it| it.passing < 1.0) {
                    let waiting = &load.at[..load.waits];
                    waiting.iter().for_each(|it| next.thin(it.chain, it.x, load.passing));
                }
            });
            thinning = if round < SETTLING { next } else { thinning.between(&next) };
        }
        (self.assign)(&rates, &thinning).arriving * SECONDS_PER_HOUR
    }

    /// The part that is full first when the flows of this `assignment` grow, if anybody drives.
    fn fullest(&self, assignment: &Assignment) -> Option<Load> {
        // Of parts with equal loads the first counts, however their numbers are rounded.
        let is_fuller = |it: &Load, than: &Load| it.share > than.share * (1.0 + ROUNDED);
        self.with_loads(assignment, |roads, movements, loads| {
            let fullest = loads.reduce(|fullest, it| if is_fuller(&it, &fullest) { it } else { fullest });
            let part = fullest.filter(|it| it.share > 0.0)?;
            Some(town::load(roads, movements, 1.0 / part.share).unwrap_or(part))
        })
    }

    /// What `of` finds of the loads of all parts but the town.
    fn with_loads<T>(
        &self,
        assignment: &Assignment,
        of: impl FnOnce(&Roads, &[Movement], &mut dyn Iterator<Item = Load>) -> T,
    ) -> T {
        let Growth { network, inner_places, queues, .. } = *self;
        let equivalents: &Equivalents = &lights::equivalents(network, assignment, queues);
        let roads = Roads { network, assignment, queues, equivalents };
        let movements = movement::with_flows(network, &self.movements, assignment);
        let junctions = conflict::loads(&roads, &movements);
        let inner_places = town::inner_place_loads(&roads, inner_places);
        let lanes = lanes::loads(&roads).into_iter();
        let mut loads = lanes.chain(junctions).chain(tight::loads(&roads, &self.tight)).chain(inner_places);
        of(&roads, &movements, &mut loads)
    }
}

/// What each origin bears. All demands grow together until a part of the map is full. Those whose drivers pass it stay
/// as they are, and the others grow on: the max-min fair allocation, by progressive filling (Bertsekas and Gallager,
/// 1992, from memory).
impl Growth<'_> {
    /// So often are the others let grow on: each time takes some assignments.
    const ROUNDS: u32 = 6;
    /// The largest growth of one round.
    const MOST: f64 = 8.0;

    /// The demand of each origin [veh/h], from demands in proportion to `rates` on; `None` if nothing is ever full.
    pub(crate) fn fill(&self, rates: &[f64]) -> Option<Vec<f64>> {
        let mut full = self.fullest(&(self.assign)(rates, &Thinning::default()))?;
        let mut rates: Vec<f64> = rates.iter().map(|it| it / full.share).collect();
        let mut grows = vec![true; rates.len()];
        for _ in 0..Growth::ROUNDS {
            let had_grown = grows.clone();
            for (origin, grows) in grows.iter_mut().enumerate() {
                *grows = *grows && !self.loads(origin, &rates, &full);
            }
            if !grows.contains(&true) || grows == had_grown {
                break;
            }
            let grown = |by: f64| -> Vec<f64> {
                rates.iter().zip(&grows).map(|(it, grows)| if *grows { it * by } else { *it }).collect()
            };
            let (by, next) = self.growth(grown);
            rates = grown(by);
            // Where another part is as full, nobody has grown, but others stay as they are from then on.
            let Some(next) = next else { break };
            full = next;
        }
        Some(rates)
    }

    /// About the largest growth at which no part is overfull, of demands that are `grown` by it, and what is full
    /// beyond it; `None` if nothing is.
    fn growth(&self, grown: impl Fn(f64) -> Vec<f64>) -> (f64, Option<Load>) {
        const HALVINGS: u32 = 5;
        let overfull = |by: f64| {
            self.fullest(&(self.assign)(&grown(by), &Thinning::default()))
                .filter(|it| it.share > 1.0 + ROUNDED)
        };
        let (mut low, mut high) = (1.0, 2.0);
        let mut full = loop {
            match overfull(high) {
                Some(full) => break full,
                None if high >= Growth::MOST => return (high, None),
                None => (low, high) = (high, 2.0 * high),
            }
        };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            match overfull(middle) {
                Some(it) => (high, full) = (middle, it),
                None => low = middle,
            }
        }
        (low, Some(full))
    }

    /// Whether drivers from an origin pass the part that is `full`, or get nowhere.
    fn loads(&self, origin: usize, rates: &[f64], full: &Load) -> bool {
        if full.of == Bottleneck::Town {
            return true;
        }
        let alone: Vec<f64> =
            rates.iter().enumerate().map(|(it, rate)| if it == origin { *rate } else { 0.0 }).collect();
        let assignment = (self.assign)(&alone, &Thinning::default());
        assignment.total == 0.0 || full.at.iter().any(|it| assignment.flow(it.chain, it.x)[1] > 0.0)
    }
}
