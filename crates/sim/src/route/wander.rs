//! The way of drivers without a destination.

use laneweave_network::{ChainIndex, Side};

use crate::route::waypoint::Waypoint;
use crate::route::ways::Planner;

impl Planner<'_> {
    /// Waypoints for drivers without a destination: they take the first following chain, and leave lanes that end.
    pub(crate) fn wander(&self) -> Vec<Waypoint> {
        let on = |chain: ChainIndex| Waypoint {
            changes: 0,
            last_place: f64::INFINITY,
            next: self.onward(chain).next(),
            time: 0.0,
            ..Waypoint::NOWHERE
        };
        let all = (0..self.network.chains.len() as u32).map(ChainIndex);
        let mut table: Vec<Waypoint> = all.map(on).collect();
        for (chain, waypoint) in self.network.chains.iter().zip(&mut table) {
            if !chain.ends_for.has(self.class()) {
                continue;
            }
            let until = chain.driven_until(true);
            let ends = |side: Side| chain.stretches(side).last().map(|it| it.end.min(until));
            let last_place = Side::BOTH.into_iter().filter_map(ends).reduce(f64::max).unwrap_or(chain.length);
            *waypoint = Waypoint { changes: 1, last_place, ..*waypoint };
        }
        table
    }
}
