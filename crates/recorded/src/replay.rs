//! Recorded traffic as its drivers see it: each frame is a [`Scene`]. From it, `perceive` gives the situation of a
//! driver in the same way as in a simulation.
//!
//! Observed: place, speed, acceleration, length. From later frames: a vehicle's destination, and the begin and end of
//! its lane changes, during which it stands in both lanes. Assumed by the caller: the driver parameters and the
//! desired speed. Not visible in a recording: which drivers wait for a gap, so [`Situation::merging`] stays empty;
//! and headway relaxation.

use laneweave_models::Style;
use laneweave_models::change::Situation;
use laneweave_network::{LaneletIndex, Point, Position, Side};
use laneweave_recordings::{Foot, LaneChange, Matched, foot, smooth};
use laneweave_sim::{Across, Navigator, Scene, Seen, Snapshot, Spot, VehicleId, perceive};
use thiserror::Error;

use crate::drivers::{Assumed, Driver, drivers, easiest};

/// Positions and speeds are smoothed over this time before and after [s].
const REACH: f64 = 0.25;
/// An acceleration is computed from the speeds this time before and after [s].
const ACCELERATION_REACH: f64 = 0.5;
/// Maximum distance from a vehicle's centre to its front bumper [m].
const FARTHEST: f64 = 50.0;

/// A recording with its frames as scenes.
pub struct Replay<'a> {
    matched: &'a Matched<'a>,
    navigator: &'a Navigator,
    driver_parameters: &'a [Style],
    /// For each track its driver.
    drivers: Vec<Driver>,
    /// Whether drivers go where their tracks went.
    knows_destinations: bool,
}

/// Invalid assumptions about a driver.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ReplayError {
    /// The driver parameters are not in the table.
    #[error(
        "vehicle {vehicle} is given the driver parameters {parameters}, but there are {count} sets, from 0 on"
    )]
    Character {
        /// Id of the track.
        vehicle: i64,
        /// Its driver parameters.
        parameters: u32,
        /// Size of the table.
        count: usize,
    },
    /// A desired speed makes no sense.
    #[error("vehicle {vehicle} is given the speed factor {factor}; choose a number above 0")]
    SpeedFactor {
        /// Id of the track.
        vehicle: i64,
        /// Its speed factor.
        factor: f64,
    },
}

impl<'a> Replay<'a> {
    /// A recording with all its lane `changes`, seen by drivers with `driver_parameters` and the routes of
    /// `navigator`. `assume` gives the assumptions about each track's driver, by the index of the track in the
    /// recording.
    ///
    /// Each vehicle goes where it went. If the recording ends before it left the map, its destination is the exit
    /// that needs the fewest lane changes from there, and of several the one of least time. The same destination is
    /// used while permitted changes do not lead where it went.
    ///
    /// # Errors
    /// If an assumption names driver parameters that do not exist, or a desired speed not above 0.
    pub fn new(
        matched: &'a Matched<'a>,
        changes: &[LaneChange],
        navigator: &'a Navigator,
        driver_parameters: &'a [Style],
        assume: impl Fn(usize) -> Assumed,
    ) -> Result<Replay<'a>, ReplayError> {
        let drivers = drivers(matched, changes, navigator, assume);
        for (track, driver) in matched.recording.tracks.iter().zip(&drivers) {
            let (vehicle, Assumed { parameters, speed_factor: factor }) = (track.id, driver.assumed);
            if parameters as usize >= driver_parameters.len() {
                return Err(ReplayError::Character { vehicle, parameters, count: driver_parameters.len() });
            }
            if !(factor > 0.0 && factor.is_finite()) {
                return Err(ReplayError::SpeedFactor { vehicle, factor });
            }
        }
        Ok(Replay { matched, navigator, driver_parameters, drivers, knows_destinations: true })
    }

    /// The same without destinations: all drivers follow the road. So nothing that a driver knows comes from the lanes
    /// that it takes later.
    pub fn without_destinations(self) -> Replay<'a> {
        Replay { knows_destinations: false, ..self }
    }

    /// The instant of `frame`. A vehicle is in it from its first state with a position until its front bumper passes
    /// an exit.
    pub fn frame(&self, frame: i64) -> Frame<'_> {
        let present = self.matched.present(frame);
        let seen: Vec<Seen> = present.filter_map(|(track, at)| self.seen(track, at)).collect();
        let mut ids: Vec<(i64, VehicleId)> =
            seen.iter().map(|it| (self.matched.recording.tracks[it.id as usize].id, it.id)).collect();
        ids.sort_unstable();
        Frame { replay: self, snapshot: Snapshot::new(self.matched.network, seen), ids }
    }

    /// A track's vehicle in its state number `at`.
    fn seen(&self, track: usize, at: usize) -> Option<Seen> {
        let lanelet = self.matched.places[track][at]?.lanelet;
        let (driver, step) = (&self.drivers[track], self.matched.recording.step);
        let (id, track) = (track as VehicleId, &self.matched.recording.tracks[track]);
        let motion = smooth::motion(&track.states, at, REACH, step);
        let centre = Point::new(motion.x, motion.y, 0.0);
        let half = 0.5 * track.length;
        let foot = foot(&self.matched.network.lanelets[lanelet.at()], &centre)?;
        let Position { chain, x } = self.onward(driver, at, self.front(lanelet, &foot, half)?)?;
        let time = track.states[at].frame as f64 * step;
        let change = driver.changes.iter().find_map(|it| {
            let progress = it.extent.progress(time)?;
            let is_across = it.last_before.is_none_or(|last| at > last);
            let to_other = if is_across { it.side.opposite() } else { it.side };
            let (lanelet, foot) = self.beside(lanelet, to_other, &centre)?;
            let other = self.onward(driver, at, self.front(lanelet, &foot, half)?)?;
            (other.chain != chain).then_some(Across { side: it.side, progress, other })
        });
        let leads_on = self.navigator.waypoint(driver.destination, chain).leads_on(x);
        Some(Seen {
            id,
            chain,
            x,
            speed: smooth::speed(&track.states, at, REACH, step),
            acceleration: smooth::acceleration(&track.states, at, ACCELERATION_REACH, step),
            length: track.length,
            class: driver.class,
            parameters: driver.assumed.parameters,
            desired: driver.desired(self.matched.network.chain(chain).limit(x), &self.matched.network.law),
            destination: match self.knows_destinations {
                true if leads_on => driver.destination,
                true => easiest(self.navigator, chain, x),
                false => None,
            },
            change,
        })
    }

    /// The position of the front bumper, `half` a vehicle's length ahead of its centre's foot on `lanelet`.
    fn front(&self, lanelet: LaneletIndex, foot: &Foot, half: f64) -> Option<Position> {
        let Position { chain, x: start } = self.matched.network.start_of(lanelet);
        let beyond = if foot.station > 0.0 { foot.beyond } else { -foot.beyond };
        // This form also refuses NaN.
        let is_near = beyond.abs() + half <= FARTHEST;
        is_near.then(|| Position::new(chain, start + foot.station + beyond + half))
    }

    /// The same place, if it lies beyond the end of the chain: on the chain on which the driver continues. `None`
    /// beyond an exit.
    fn onward(&self, driver: &Driver, at: usize, front: Position) -> Option<Position> {
        let Position { mut chain, mut x } = front;
        let network = self.matched.network;
        while x > network.chain(chain).length {
            let following = &network.chain(chain).following;
            let by_route = || self.navigator.waypoint(driver.destination, chain).next;
            let Some(next) = driver.next(at, following).or_else(by_route) else {
                let is_exit = network.exits.iter().any(|it| it.chains.contains(&chain));
                return (!is_exit).then(|| Position::new(chain, x));
            };
            x -= network.chain(chain).length;
            chain = next;
        }
        Some(Position::new(chain, x))
    }

    /// The lanelet on `side` of `lanelet`, and the position of `centre` along it.
    fn beside(&self, lanelet: LaneletIndex, side: Side, centre: &Point) -> Option<(LaneletIndex, Foot)> {
        let foot = |it: LaneletIndex| foot(&self.matched.network.lanelets[it.at()], centre);
        let feet = self.matched.beside(lanelet, side).filter_map(|it| Some((it, foot(it)?)));
        feet.min_by(|a, b| a.1.beyond.total_cmp(&b.1.beyond))
    }
}

/// One instant of a recording.
pub struct Frame<'r> {
    replay: &'r Replay<'r>,
    snapshot: Snapshot,
    /// Ids of the vehicles in order, with their names in the scene.
    ids: Vec<(i64, VehicleId)>,
}

impl Frame<'_> {
    /// The instant as a scene; the name of a vehicle is the index of its track in the recording.
    pub fn scene(&self) -> Scene<'_> {
        let Replay { matched, navigator, driver_parameters, .. } = self.replay;
        self.snapshot.scene(matched.network, navigator, driver_parameters)
    }

    /// Ids of the vehicles that are there, in order.
    pub fn vehicles(&self) -> impl Iterator<Item = i64> {
        self.ids.iter().map(|(id, _)| *id)
    }

    /// The position of a vehicle's main entry in the scene.
    pub fn spot(&self, vehicle: i64) -> Option<Spot> {
        let found = self.ids.binary_search_by_key(&vehicle, |(id, _)| *id).ok()?;
        self.snapshot.spot(self.ids[found].1)
    }

    /// Supposes another desired speed of the driver of a vehicle, as a share of the speed that the limit and its class
    /// allow.
    pub fn suppose(&mut self, vehicle: i64, speed_factor: f64) {
        let Some(spot) = self.spot(vehicle) else { return };
        let scene = self.scene();
        let (class, x) = (scene.driver(spot).class, scene.motion(spot).x);
        let network = self.replay.matched.network;
        let allowed = class.allowed(network.chain(spot.chain).limit(x), &network.law);
        self.snapshot.set_desired(spot, allowed * speed_factor);
    }

    /// What the driver of a vehicle knows when it considers the lane on `side`; `None` where it may not change to one.
    pub fn perceive(&self, vehicle: i64, side: Side) -> Option<Situation<'_>> {
        perceive(&self.scene(), self.spot(vehicle)?, side)
    }
}
