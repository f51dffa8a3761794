//! Which chain comes next on the ways of all tables: what drivers look up at every step, together for each chain.

use laneweave_network::{ChainIndex, Network};

use crate::route::waypoint::Waypoint;

/// For each chain and table the place of the next chain among those that follow.
#[derive(Clone, Debug, Default)]
pub(crate) struct Onward {
    tables: usize,
    /// By chain, then by table.
    places: Vec<u16>,
}

impl Onward {
    /// There is none.
    const NOWHERE: u16 = u16::MAX;

    /// Of as many tables for `network`, none of which leads anywhere yet.
    pub(crate) fn new(network: &Network, tables: usize) -> Onward {
        Onward { tables, places: vec![Onward::NOWHERE; tables * network.chains.len()] }
    }

    /// Takes over the ways of a table.
    pub(crate) fn take(&mut self, network: &Network, table: usize, waypoints: &[Waypoint]) {
        let rows = self.places.chunks_exact_mut(self.tables);
        for ((row, waypoint), chain) in rows.zip(waypoints).zip(&network.chains) {
            let place = waypoint.next.and_then(|next| chain.following.iter().position(|it| *it == next));
            row[table] = place.map_or(Onward::NOWHERE, |it| it as u16);
        }
    }

    /// The chain with which the way of `table` goes on from `chain`.
    #[inline]
    pub(crate) fn next(&self, network: &Network, chain: ChainIndex, table: usize) -> Option<ChainIndex> {
        let place = self.places[chain.at() * self.tables + table];
        network.chain(chain).following.get(usize::from(place)).copied()
    }
}
