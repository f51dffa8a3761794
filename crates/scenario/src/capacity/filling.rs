//! What each origin bears. All demands grow together until a part of the map is full. Those whose drivers pass it stay
//! as they are, and the others grow on: the max-min fair allocation, by progressive filling (Bertsekas and Gallager,
//! 1992). Parts with other loads than the sum of flows are full in the same sense.

use laneweave_network::Network;
use laneweave_sim::{InnerPlace, World};

use super::{Bottleneck, Load, Queues, fullest};

/// What it depends on.
pub(crate) struct Filling<'a> {
    /// The world with the routes of the demand.
    pub(crate) world: &'a World,
    /// Its network, with the programs of its lights.
    pub(crate) network: &'a Network,
    pub(crate) inner_places: &'a [InnerPlace],
    pub(crate) queues: &'a Queues,
}

impl Filling<'_> {
    /// So often are the others let grow on: each time takes some assignments.
    const ROUNDS: u32 = 6;
    /// The largest growth of one round, and the growth below which it ends.
    const MOST: f64 = 8.0;
    const LEAST: f64 = 1.02;

    /// The demand of each origin [veh/h], from demands in proportion to `rates` on; `None` if nothing is ever full.
    pub(crate) fn fill(&self, rates: &[f64]) -> Option<Vec<f64>> {
        let mut full = self.fullest(rates)?;
        let mut rates: Vec<f64> = rates.iter().map(|it| it / full.share).collect();
        let mut grows = vec![true; rates.len()];
        for _ in 0..Filling::ROUNDS {
            for (origin, grows) in grows.iter_mut().enumerate() {
                *grows &= !self.loads(origin, &rates, &full);
            }
            if !grows.contains(&true) {
                break;
            }
            let grown = |by: f64| -> Vec<f64> {
                rates.iter().zip(&grows).map(|(it, grows)| if *grows { it * by } else { *it }).collect()
            };
            let Some((by, next)) = self.growth(grown) else { break };
            (rates, full) = (grown(by), next);
            if by < Filling::LEAST {
                break;
            }
        }
        Some(rates)
    }

    /// The largest growth at which no part is overfull, of demands that are `grown` by it, and what is full beyond it;
    /// `None` if nothing is.
    fn growth(&self, grown: impl Fn(f64) -> Vec<f64>) -> Option<(f64, Load)> {
        const HALVINGS: u32 = 5;
        let overfull = |by: f64| self.fullest(&grown(by)).filter(|it| it.share > 1.0);
        let (mut low, mut high) = (1.0, 2.0);
        let mut full = loop {
            match overfull(high) {
                Some(full) => break full,
                None if high >= Filling::MOST => return None,
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
        Some((low, full))
    }

    fn fullest(&self, rates: &[f64]) -> Option<Load> {
        fullest(self.network, &self.world.assignment_of(rates), self.inner_places, self.queues)
    }

    /// Whether drivers from an origin pass the part that is `full`, or get nowhere.
    fn loads(&self, origin: usize, rates: &[f64], full: &Load) -> bool {
        if full.of == Bottleneck::Town {
            return true;
        }
        let alone: Vec<f64> =
            rates.iter().enumerate().map(|(it, rate)| if it == origin { *rate } else { 0.0 }).collect();
        let assignment = self.world.assignment_of(&alone);
        assignment.total == 0.0 || full.at.iter().any(|it| assignment.flow(it.chain, it.x)[1] > 0.0)
    }
}
