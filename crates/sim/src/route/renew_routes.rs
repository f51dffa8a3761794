//! What guidance changes of the routes: link times, and with them the recommendations.

use std::sync::Arc;

use laneweave_network::{ChainIndex, Network};
use serde::{Deserialize, Serialize};

use crate::route::links::Links;
use crate::route::navigate::{Navigator, Routes};
use crate::route::place::Place;
use crate::route::waypoint::Waypoint;
use crate::state::goal::{Destination, Goal};

/// What guidance has changed in a navigator.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Guided {
    tables: Vec<Vec<Waypoint>>,
    recommended: Vec<u16>,
    links: Links,
    measurements: u32,
}

impl Guided {
    /// Whether the route to a destination is planned.
    pub(crate) fn has(&self, destination: Destination) -> bool {
        is_planned(&self.tables, destination)
    }
}

/// Whether the route to a destination is planned in `tables`. A driver without a destination follows the road.
pub(super) fn is_planned(tables: &[Vec<Waypoint>], destination: Destination) -> bool {
    destination.is_none_or(|it| tables.get(usize::from(it)).is_some_and(|it| !it.is_empty()))
}

impl Navigator {
    /// What guidance has changed.
    pub(crate) fn guided(&self) -> Guided {
        let Routes { tables, recommended, links, measurements, .. } = &*self.routes;
        Guided {
            tables: tables.clone(),
            recommended: recommended.clone(),
            links: links.clone(),
            measurements: *measurements,
        }
    }

    /// Whether it can continue from `guided`.
    pub(crate) fn accepts(&self, guided: &Guided) -> bool {
        let Guided { tables, recommended, links, measurements: _ } = guided;
        let chains = self.routes.trip_ends.len();
        let alike =
            |(one, other): (&Vec<Waypoint>, &Vec<Waypoint>)| one.len() == other.len() || one.len() == chains;
        let is_chain = |it: ChainIndex| it.at() < chains;
        tables.len() == self.routes.tables.len()
            && tables.iter().zip(&self.routes.tables).all(alike)
            && tables.iter().flatten().all(|it| it.chains().all(is_chain))
            && recommended.len() == self.routes.recommended.len()
            && recommended
                .iter()
                .all(|it| usize::from(*it) < tables.len() && !tables[usize::from(*it)].is_empty())
            && links.fits(&self.routes.links)
    }

    /// Continues from what guidance had changed in a navigator of the same network.
    pub(crate) fn go_on(&mut self, network: &Network, guided: Guided) {
        let Guided { tables, recommended, links, measurements } = guided;
        let routes = Arc::make_mut(&mut self.routes);
        (routes.tables, routes.recommended) = (tables, recommended);
        (routes.links, routes.measurements) = (links, measurements);
        routes.look_onward(network);
    }

    /// Prepares guidance to `destinations`, at first with the link times of the free road.
    ///
    /// # Errors
    /// The greatest number of destinations, if there are too many for [`Navigator::WAYS`] ways to each.
    pub(crate) fn guide(&mut self, network: &Network, destinations: &[Place]) -> Result<(), usize> {
        let usual = self.routes.usual();
        if usual * Navigator::WAYS > usize::from(Goal::NONE) {
            return Err(usize::from(Goal::NONE) / Navigator::WAYS / self.routes.restrictions.count() - 1);
        }
        let routes = Arc::make_mut(&mut self.routes);
        routes.recommended = (0..usual as u16).collect();
        routes.links = Links::of(network);
        routes.tables.resize(usual * Navigator::WAYS, Vec::new());
        for table in usual..routes.tables.len() {
            if let Some(place) = destinations.get(table % routes.of_restriction) {
                routes.end_trips(place, table);
            }
        }
        routes.look_onward(network);
        Ok(())
    }

    /// Takes over measured times of all links [s]. The tables use them when they are next renewed.
    pub(crate) fn take_link_times(&mut self, times: impl Iterator<Item = f64>) {
        let routes = Arc::make_mut(&mut self.routes);
        routes.links.take(times);
        routes.measurements += 1;
    }

    /// Number of measurements of the link times.
    pub(crate) fn measurements(&self) -> u32 {
        self.routes.measurements
    }

    /// Updates the routes to `place` in the tables `ways` to the present link times. Drivers use those tables that are
    /// `in_use`. Recommends the best route again, if a table is free for it.
    pub(crate) fn renew(
        &mut self,
        network: &Network,
        place: &Place,
        ways: [usize; Navigator::WAYS],
        in_use: [bool; Navigator::WAYS],
    ) {
        let [usual, ..] = ways;
        let planner = self.routes.planner(network, usual / self.routes.of_restriction);
        let newest = usize::from(self.routes.recommended[usual]);
        let mut best = planner.plan(place);
        planner.note_alternatives(&mut best, None);
        let is_new = best.iter().zip(&self.routes.tables[newest]).any(|(new, old)| !new.goes_like(old));
        let mut spare = ways.into_iter().zip(in_use).skip(1);
        let spare = spare.find(|(way, in_use)| is_new && !in_use && *way != newest);
        if is_new && spare.is_none() {
            // A route that cannot be recommended is no alternative.
            best.clone_from(&self.routes.tables[newest]);
            planner.retime(&mut best, place);
            planner.note_alternatives(&mut best, None);
        }
        let mut renewed = Vec::new();
        for (way, in_use) in ways.into_iter().zip(in_use) {
            let is_followed = in_use || way == usual || way == newest;
            if is_followed && spare.is_none_or(|it| it.0 != way) {
                let mut table = self.routes.tables[way].clone();
                planner.retime(&mut table, place);
                planner.note_alternatives(&mut table, Some(&best));
                renewed.push((way, table));
            }
        }
        renewed.extend(spare.map(|(way, _)| (way, best)));
        let routes = Arc::make_mut(&mut self.routes);
        for (way, table) in renewed {
            routes.onward.take(network, way, &table);
            routes.tables[way] = table;
        }
        if let Some((way, _)) = spare {
            routes.recommended[usual] = way as u16;
        }
    }
}
