//! All that is on the road at an instant.

use laneweave_network::ChainIndex;
use serde::{Deserialize, Serialize};

use crate::state::busy::Busy;
use crate::state::clock::Clock;
use crate::state::goal::Destination;
use crate::state::traffic::{Car, Lane, Mind};

/// The vehicles, and the instant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Traffic {
    pub(crate) clock: Clock,
    /// By chain.
    pub(crate) lanes: Vec<Lane>,
    pub(crate) busy: Busy,
    /// Vehicles on the road.
    pub(crate) crowd: usize,
}

impl Traffic {
    /// Nobody on so many chains, with steps of this length [s].
    pub(crate) fn new(chains: usize, step: f64) -> Traffic {
        Traffic {
            clock: Clock { step: 0, dt: step },
            lanes: vec![Lane::default(); chains],
            busy: Busy::none_of(chains),
            crowd: 0,
        }
    }

    /// Whether it can be on so many chains, for so many drivers, and for ways that are known.
    pub(crate) fn fits(
        &self,
        chains: usize,
        characters: usize,
        is_known: impl Fn(Destination) -> bool,
    ) -> bool {
        let Traffic { clock, lanes, busy, crowd } = self;
        let is_chain = |it: ChainIndex| it.at() < chains;
        let car_fits = |it: &Car| (it.character as usize) < characters && is_known(it.goal.destination());
        let mind_fits = |it: &Mind| {
            it.twin.is_none_or(|it| is_chain(it.chain) && it.x.is_finite())
                && it.trail.known().all(is_chain)
                && it.entered.max(it.since) <= clock.step
        };
        let lane_fits =
            |it: &Lane| it.is_sound() && it.cars().iter().all(car_fits) && it.minds().iter().all(mind_fits);
        let cars = lanes.iter().flat_map(|it| it.cars());
        lanes.len() == chains
            && busy.is_of(chains)
            && lanes.iter().all(lane_fits)
            && cars.filter(|it| !it.is_shadow).count() == *crowd
    }
}
