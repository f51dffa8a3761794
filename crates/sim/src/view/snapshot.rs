//! A scene without a world: one instant of traffic from plain data, such as a recorded frame.

use laneweave_models::Style;
use laneweave_network::{ChainIndex, Network, Position, Side};

use crate::junction::reservations::{NO_RESERVATION, Reservations};
use crate::junction::signals::Signals;
use crate::route::navigate::Navigator;
use crate::state::clock::Clock;
use crate::state::externals::Externals;
use crate::state::goal::Destination;
use crate::state::lane::{
    Counterpart, DriverState, Entry, Kinematics, Lane, LaneChangeKind, LaneChangeState, Phase, VehicleId,
};
use crate::state::previous_lanes::PreviousLanes;
use crate::state::vehicle::Class;
use crate::view::scene::{Scene, Spot};

/// A vehicle as seen at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Its id, which no other vehicle has at this instant.
    pub id: VehicleId,
    /// The chain in which its centre is.
    pub chain: ChainIndex,
    /// Front bumper along it [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Acceleration [m/s²].
    pub acceleration: f64,
    /// Length [m].
    pub length: f64,
    /// Class.
    pub class: Class,
    /// Index of its driver in the table of driver parameters.
    pub parameters: u32,
    /// Desired speed of its driver [m/s].
    pub desired: f64,
    /// Its destination.
    pub destination: Destination,
    /// Its lane change under way.
    pub change: Option<Across>,
}

/// A lane change under way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across {
    /// The side to which it changes.
    pub side: Side,
    /// Share of its duration that has passed, 0…1.
    pub progress: f64,
    /// Position of its front bumper in the other lane.
    pub other: Position,
}

/// One instant of traffic. A vehicle that changes lanes has an entry in both lanes, as in a [`crate::World`].
#[derive(Clone, Debug)]
pub struct Snapshot {
    lanes: Vec<Lane>,
    reservations: Reservations,
    signals: Signals,
    externals: Externals,
    /// The main entries, ordered by id.
    spots: Vec<(VehicleId, Spot)>,
}

impl Snapshot {
    /// A recorded instant is seen as one of a world with these steps.
    const CLOCK: Clock = Clock { step: 0, dt: 0.1 };

    /// The instant with `vehicles` on `network`.
    ///
    /// # Panics
    /// If a chain does not belong to the network.
    pub fn new(network: &Network, vehicles: impl IntoIterator<Item = Seen>) -> Snapshot {
        let mut lanes = vec![Lane::default(); network.chains.len()];
        for seen in vehicles {
            lanes[seen.chain.at()].insert(main_entry(network, &seen));
            if let Some(change) = seen.change {
                lanes[change.other.chain.at()].insert(shadow(network, &seen, &change));
            }
        }
        let mut spots: Vec<(VehicleId, Spot)> = Vec::new();
        for (chain, lane) in lanes.iter().enumerate() {
            let main =
                lane.motions().iter().zip(lane.drivers()).enumerate().filter(|(_, (_, it))| !it.is_shadow);
            let chain = ChainIndex(chain as u32);
            spots.extend(main.map(|(index, (motion, _))| (motion.id, Spot { chain, index })));
        }
        spots.sort_by_key(|(id, _)| *id);
        let (reservations, signals) = (Reservations::new(network), Signals::new(network, Snapshot::CLOCK));
        Snapshot { lanes, reservations, signals, externals: Externals::default(), spots }
    }

    /// The scene that drivers with `driver_parameters` see, with routes by `navigator`.
    pub fn scene<'a>(
        &'a self,
        network: &'a Network,
        navigator: &'a Navigator,
        driver_parameters: &'a [Style],
    ) -> Scene<'a> {
        let Snapshot { lanes, reservations, signals, externals, .. } = self;
        // A recorded instant has no seed: it is seen as it is.
        let (errors, dt) = (None, Snapshot::CLOCK.dt);
        Scene { network, navigator, lanes, driver_parameters, dt, reservations, signals, externals, errors }
    }

    /// Gives the driver of the vehicle whose main entry is at `spot` another desired speed [m/s].
    pub fn set_desired(&mut self, spot: Spot, desired: f64) {
        let driver = &mut self.lanes[spot.chain.at()].drivers_mut()[spot.index];
        (driver.desired, driver.limit_desired) = (desired as f32, desired as f32);
    }

    /// The main entry of a vehicle.
    pub fn spot(&self, id: VehicleId) -> Option<Spot> {
        self.spots.binary_search_by_key(&id, |(it, _)| *it).ok().map(|it| self.spots[it].1)
    }

    /// The main entries of all vehicles, ordered by id.
    pub fn spots(&self) -> &[(VehicleId, Spot)] {
        &self.spots
    }
}

fn main_entry(network: &Network, seen: &Seen) -> Entry {
    let motion = Kinematics {
        x: seen.x,
        speed: seen.speed,
        acceleration: seen.acceleration as f32,
        headway_relaxation: 1.0,
        length: seen.length as f32,
        id: seen.id,
    };
    let driver = DriverState {
        desired: seen.desired as f32,
        limit_desired: seen.desired as f32,
        standing: 0.0,
        parameters: seen.parameters,
        due: 0,
        cooldown_until: 0,
        goal: seen.destination.into(),
        class: seen.class,
        phase: if seen.change.is_some() { Phase::Changes } else { Phase::Cruises },
        is_shadow: false,
        in_emergency: false,
        needs_full_update: false,
        is_external: false,
    };
    let counterpart =
        |change: Across| Counterpart { chain: change.other.chain, x: change.other.x, stretch: 1.0 };
    let lane_change = LaneChangeState {
        side: seen.change.map_or(network.driving_side.overtaking(), |it| it.side),
        kind: LaneChangeKind::Discretionary,
        entered: 0,
        since: 0,
        stretch: 1.0,
        progress: seen.change.map_or(0.0, |it| it.progress as f32),
        urgency: 0.0,
        gain: 0.0,
        record: 0,
        previous_lanes: PreviousLanes::NONE,
        counterpart: seen.change.map(counterpart),
        last_place: f64::INFINITY,
        lets_in: LaneChangeState::NOBODY,
        minds_offside: false,
        reservation: NO_RESERVATION,
    };
    Entry { motion, driver, lane_change }
}

/// The entry of a vehicle in its other lane.
fn shadow(network: &Network, seen: &Seen, change: &Across) -> Entry {
    let Entry { motion, driver, lane_change } = main_entry(network, seen);
    let x = change.other.x;
    Entry {
        motion: Kinematics { x, ..motion },
        driver: DriverState { is_shadow: true, ..driver },
        lane_change: LaneChangeState {
            counterpart: Some(Counterpart { chain: seen.chain, x: seen.x, stretch: 1.0 }),
            ..lane_change
        },
    }
}
