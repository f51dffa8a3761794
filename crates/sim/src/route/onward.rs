//! The next chain on the routes of all tables, stored together for each chain: drivers need it at every step.

use laneweave_network::{ChainIndex, Network};

use crate::route::waypoint::Waypoint;

/// For each chain and table, the index of the next chain among the following ones.
#[derive(Clone, Debug, Default)]
pub(crate) struct Onward {
    tables: usize,
    /// By chain, then by table.
    places: Vec<u16>,
}

impl Onward {
    /// There is no next chain.
    const NOWHERE: u16 = u16::MAX;

    /// The next chains for this number of tables of `network`; no route leads anywhere yet.
    pub(crate) fn new(network: &Network, tables: usize) -> Onward {
        Onward { tables, places: vec![Onward::NOWHERE; tables * network.chains.len()] }
    }

    /// Takes over the routes of a table.
    pub(crate) fn take(&mut self, network: &Network, table: usize, waypoints: &[Waypoint]) {
        let rows = self.places.chunks_exact_mut(self.tables);
        for ((row, waypoint), chain) in rows.zip(waypoints).zip(&network.chains) {
            let place = waypoint.next.and_then(|next| chain.following.iter().position(|it| *it == next));
            row[table] = place.map_or(Onward::NOWHERE, |it| it as u16);
        }
    }

    /// The chain after `chain` on the route of `table`.
    #[inline]
    pub(crate) fn next(&self, network: &Network, chain: ChainIndex, table: usize) -> Option<ChainIndex> {
        let place = self.places[chain.at() * self.tables + table];
        network.chain(chain).following.get(usize::from(place)).copied()
    }
}
