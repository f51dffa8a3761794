//! One instant of traffic, simulated or recorded: leaders and followers on any lane, across the ends of chains.

use laneweave_models::Style;
use laneweave_models::change::SIGHT;
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, Class, LightIndex, LightState, Network};

use crate::junction::reservations::{Reservation, Reservations};
use crate::junction::signals::Signals;
use crate::junction::state::JunctionState;
use crate::junction::storage_section::StorageSection;
use crate::route::closures::ClosureAhead;
use crate::route::fitting_speed::Outlook;
use crate::route::navigate::Navigator;
use crate::route::roads::Roads;
use crate::route::walk::{Leg, Walk};
use crate::state::externals::Externals;
use crate::state::goal::Destination;
use crate::state::lane::{DriverState, Kinematics, Lane, LaneChangeState, VehicleId};
use crate::state::random::Random;
use crate::state::traffic::Traffic;
use crate::state::vehicle::LONGEST;

/// One instant of traffic on a network.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The roads.
    pub network: &'a Network,
    /// The routes on them.
    pub navigator: &'a Navigator,
    /// The vehicles, by chain.
    pub lanes: &'a [Lane],
    /// The table of driver parameters, to which vehicles refer.
    pub driver_parameters: &'a [Style],
    /// How long a step is [s].
    pub(crate) dt: f64,
    /// The reservations at junctions.
    pub reservations: &'a Reservations,
    /// What the lights show.
    pub signals: &'a Signals,
    /// The vehicles that users drive.
    pub(crate) externals: &'a Externals,
    /// The random numbers of drivers' errors in what they see; `None` if all drivers see everything as it is.
    pub(crate) errors: Option<Random>,
}

/// An entry in a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// The chain.
    pub chain: ChainIndex,
    /// Its index in the lane.
    pub index: usize,
}

/// A viewpoint: a front bumper on a chain, and its vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// The chain.
    pub chain: ChainIndex,
    /// Front bumper along it [m].
    pub x: f64,
    /// Index of the first entry ahead.
    pub ahead: usize,
    /// The vehicle that looks. It does not see its own entries.
    pub id: VehicleId,
    /// Its destination.
    pub destination: Destination,
    /// The class of its vehicle.
    pub class: Class,
}

/// A vehicle that was found, and its distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Its entry.
    pub spot: Spot,
    /// Distance between its front bumper and the own one [m], positive.
    pub distance: f64,
}

/// The next vehicle on a driver's way.
#[derive(Clone, Copy, Debug)]
struct Leader {
    spot: Spot,
    /// From the driver's front to where the vehicle is in the way [m].
    gap: f64,
    /// Its rear is on the driver's way. If not, it is still on another road, and the place where that leads into the
    /// driver's way is taken until the rear is there.
    is_on_way: bool,
}

/// Range of the search for a follower [m].
pub(crate) const REAR_SIGHT: f64 = 250.0;

impl<'a> Scene<'a> {
    /// The present instant of a world.
    #[inline]
    pub(crate) fn of(roads: &'a Roads, traffic: &'a Traffic, junctions: &'a JunctionState) -> Scene<'a> {
        Scene {
            network: roads.network(),
            navigator: roads.navigator(),
            lanes: traffic.lanes(),
            driver_parameters: roads.driver_parameters(),
            dt: traffic.clock().dt,
            reservations: junctions.reservations(),
            signals: junctions.signals(),
            externals: traffic.externals(),
            errors: roads.errors(),
        }
    }

    /// The style of the driver at `spot`.
    #[inline]
    pub(crate) fn style(&self, spot: Spot) -> &'a Style {
        self.style_of(self.driver(spot))
    }

    /// The style of a driver.
    #[inline]
    pub(crate) fn style_of(&self, driver: &DriverState) -> &'a Style {
        &self.driver_parameters[driver.parameters as usize]
    }

    /// The road ahead of a driver.
    #[inline]
    pub(crate) fn outlook(&self, driver: &DriverState) -> Outlook<'a> {
        let Scene { network, navigator, .. } = *self;
        let (class, destination) = (driver.class, driver.goal.destination());
        Outlook { network, navigator, style: self.style_of(driver), class, destination }
    }

    /// The vehicles on `chain`, as others see them.
    #[inline]
    pub fn motions(&self, chain: ChainIndex) -> &'a [Kinematics] {
        self.lanes[chain.at()].motions()
    }

    /// The drivers on `chain`.
    #[inline]
    pub fn drivers(&self, chain: ChainIndex) -> &'a [DriverState] {
        self.lanes[chain.at()].drivers()
    }

    /// The warm parts of the drivers on `chain`, the foremost last.
    pub fn lane_change_states(&self, chain: ChainIndex) -> &'a [LaneChangeState] {
        self.lanes[chain.at()].lane_change_states()
    }

    /// What a light shows.
    #[inline]
    pub fn light(&self, light: LightIndex) -> LightState {
        self.signals.shown(light)
    }

    /// Whether the vehicle at `spot` has a reservation that leads further than `distance` [m]. No other vehicle may go
    /// before it there.
    pub(crate) fn has_reservation(&self, spot: Spot, distance: f64) -> bool {
        self.reservation(spot).is_some_and(|it| it.left() > distance)
    }

    /// Whether a vehicle at `x` of a chain, with its rear bumper at `rear` [m], takes storage space beyond a junction
    /// that is kept for others.
    pub(crate) fn takes_kept_space(&self, chain: ChainIndex, x: f64, rear: f64) -> bool {
        /// A junction may reach this far into a chain [m].
        const JUNCTION: f64 = 15.0;
        let section = StorageSection::at(&self.network.junctions, chain, x);
        let kept = self.reservations.kept_on(section);
        kept > 0.0 && rear < kept + JUNCTION
    }

    /// The reservation of the vehicle at `spot`.
    #[inline]
    pub(crate) fn reservation(&self, spot: Spot) -> Option<&'a Reservation> {
        // A driver with a reservation needs a full update. For other drivers, a read of the cold lane-change state is
        // avoided.
        let lane_change = self.driver(spot).needs_full_update.then(|| self.lane_change(spot))?;
        self.reservations.of(lane_change.reservation, self.motion(spot).id)
    }

    /// The kinematics of the entry at `spot`.
    #[inline]
    pub fn motion(&self, spot: Spot) -> &'a Kinematics {
        &self.motions(spot.chain)[spot.index]
    }

    /// The hot part of the entry at `spot`.
    #[inline]
    pub fn driver(&self, spot: Spot) -> &'a DriverState {
        &self.drivers(spot.chain)[spot.index]
    }

    /// The warm part of the entry at `spot`.
    #[inline]
    pub(crate) fn lane_change(&self, spot: Spot) -> &'a LaneChangeState {
        &self.lanes[spot.chain.at()].lane_change_states()[spot.index]
    }

    /// Whether a vehicle of `class` may change lanes to `chain` at `x` [m].
    #[inline]
    pub(crate) fn takes(&self, chain: ChainIndex, x: f64, class: Class) -> bool {
        self.network.chain(chain).takes(x, class) && !self.is_closed(chain, x)
    }

    /// Whether `chain` is closed at `x` [m]: by a user, or by something that stands there.
    #[inline]
    pub(crate) fn is_closed(&self, chain: ChainIndex, x: f64) -> bool {
        let closures = self.navigator.closures();
        !closures.is_empty() && closures.cover(chain, x)
    }

    /// The next closed stretch ahead of a vehicle, if it may have to stop before it.
    #[inline]
    pub(crate) fn end_of_lane_ahead(&self, from: Viewpoint) -> Option<ClosureAhead> {
        self.closure_ahead(from).filter(|it| !it.crawls)
    }

    /// The next closed stretch ahead of a vehicle, if it may have to brake for it.
    #[inline]
    pub(crate) fn closure_ahead(&self, from: Viewpoint) -> Option<ClosureAhead> {
        /// Drivers brake within this distance [m].
        const BRAKING: f64 = 400.0;
        if self.navigator.closures().is_empty() {
            return None;
        }
        let Viewpoint { destination, chain, x, .. } = from;
        if !self.navigator.closures().are_near(chain) {
            return None;
        }
        self.navigator.closure_ahead(self.network, destination, chain, x, BRAKING)
    }

    /// The viewpoint of an entry.
    #[inline]
    pub fn viewpoint(&self, spot: Spot) -> Viewpoint {
        let Kinematics { x, id, .. } = *self.motion(spot);
        let DriverState { goal, class, .. } = self.driver(spot);
        let (ahead, destination) = (spot.index + 1, goal.destination());
        Viewpoint { chain: spot.chain, x, ahead, id, destination, class: *class }
    }

    /// The viewpoint of the same vehicle at `x` on another chain.
    #[inline]
    pub fn viewpoint_at(&self, from: Viewpoint, chain: ChainIndex, x: f64) -> Viewpoint {
        Viewpoint { chain, x, ahead: self.lanes[chain.at()].ahead_of(x), ..from }
    }

    /// The chain after `chain` on the route to `destination`.
    #[inline]
    pub fn next(&self, destination: Destination, chain: ChainIndex) -> Option<ChainIndex> {
        self.navigator.next(self.network, destination, chain)
    }

    /// The walk along the route of the vehicle at `from`, from its own chain on.
    #[inline]
    pub(crate) fn walk(&self, from: Viewpoint) -> Walk<'a> {
        self.navigator.walk(self.network, from.destination, from.chain, -from.x)
    }

    /// The leader within sight.
    #[inline]
    pub fn ahead(&self, from: Viewpoint) -> Option<Ahead> {
        let chain = self.network.chain(from.chain);
        let motions = self.motions(from.chain);
        match motions[from.ahead..].iter().find(|it| it.id != from.id) {
            Some(it) if from.x >= chain.fork_clearance => Some(it.ahead(it.rear() - from.x)),
            _ => self.leader(from).map(|it| {
                let ahead = self.motion(it.spot).ahead(it.gap);
                if it.is_on_way { ahead } else { Ahead::standing(it.gap) }
            }),
        }
    }

    /// The next vehicle within sight, on the route or beside it in a fork, wherever it comes from.
    pub fn leader_spot(&self, from: Viewpoint) -> Option<Spot> {
        self.leader(from).map(|it| it.spot)
    }

    fn leader(&self, from: Viewpoint) -> Option<Leader> {
        let mut found: Option<Leader> = None;
        let mut first = from.ahead;
        for leg in self.walk(from).within(SIGHT) {
            let Leg { chain, start, .. } = leg;
            // A vehicle on a later chain may reach back to one that is found on another branch of a fork.
            if found.is_some_and(|it| it.gap + LONGEST < start) {
                break;
            }
            let lane = &self.lanes[chain.at()];
            let place = lane.motions()[first..].iter().position(|it| it.id != from.id);
            let on_way = place.map(|place| {
                let index = first + place;
                let (it, lane_change) = (&lane.motions()[index], &lane.lane_change_states()[index]);
                let gap = start + it.rear();
                let to_merge =
                    leg.before().and_then(|before| self.merge_ahead(before, start, it, lane_change));
                let merge = to_merge.filter(|it| *it > gap);
                Leader { spot: Spot { chain, index }, gap: merge.unwrap_or(gap), is_on_way: merge.is_none() }
            });
            let beside = self.beside_in_fork(leg, from);
            let beside = beside.map(|(spot, rear)| Leader { spot, gap: start + rear, is_on_way: true });
            let all = found.into_iter().chain(on_way).chain(beside);
            found = all.reduce(|a, b| if b.gap < a.gap { b } else { a });
            if on_way.is_some() {
                break;
            }
            first = 0;
        }
        found
    }

    /// Distance to the merge [m], if the rear of the vehicle `it`, whose chain starts `base` ahead, is still on another
    /// route into that chain. It is in the way from the merge on, until its rear is there.
    fn merge_ahead(
        &self,
        chain: ChainIndex,
        base: f64,
        it: &Kinematics,
        lane_change: &LaneChangeState,
    ) -> Option<f64> {
        let other = lane_change.previous_lanes.last().filter(|other| it.rear() < 0.0 && *other != chain)?;
        let junctions = &self.network.junctions;
        let crossings = junctions.on(chain).crossings.iter();
        let shared = crossings.filter(|it| junctions.other_side(**it).chain == other);
        let reaches = shared.map(|it| junctions.reach(*it));
        let merge = reaches.into_iter().find(|it| it.end >= self.network.chain(chain).length)?;
        Some(base - self.network.chain(chain).length + merge.start)
    }

    /// The follower within sight.
    pub fn follower(&self, from: Viewpoint) -> Option<Found> {
        let motions = &self.motions(from.chain)[..from.ahead];
        let here = motions.iter().enumerate().rev().find(|(_, it)| it.id != from.id);
        if let Some((index, it)) = here {
            let found = Found { spot: Spot { chain: from.chain, index }, distance: from.x - it.x };
            return (found.distance < REAR_SIGHT).then_some(found);
        }
        let (mut chain, mut base) = (from.chain, from.x);
        while base < REAR_SIGHT {
            let (back, found) = self.last_on_previous(chain, base, from.id)?;
            if let Some(found) = found {
                return (found.distance < REAR_SIGHT).then_some(found);
            }
            chain = back;
            base += self.network.chain(chain).length;
        }
        None
    }

    /// The follower of the vehicle that was `found` behind the vehicle `id`, with its distance from that vehicle.
    pub(crate) fn next_behind(&self, found: Found, id: VehicleId) -> Option<Found> {
        let from = self.viewpoint(found.spot);
        let next = self.follower(Viewpoint { ahead: found.spot.index, id, ..from })?;
        Some(Found { distance: found.distance + next.distance, ..next })
    }

    /// The foremost vehicle that comes from a previous chain onto `chain`, and the chain to continue from.
    fn last_on_previous(
        &self,
        chain: ChainIndex,
        base: f64,
        id: VehicleId,
    ) -> Option<(ChainIndex, Option<Found>)> {
        let previous = &self.network.chain(chain).previous;
        let mut nearest: Option<(ChainIndex, Option<Found>)> = previous.first().map(|it| (*it, None));
        for back in previous {
            let mut foremost = self.motions(*back).iter().zip(self.drivers(*back)).enumerate().rev();
            let comes = |driver: &DriverState| self.next(driver.goal.destination(), *back) == Some(chain);
            let found =
                foremost.find(|(_, (it, driver))| it.id != id && comes(driver)).map(|(index, (it, _))| {
                    let distance = base + self.network.chain(*back).length - it.x;
                    Found { spot: Spot { chain: *back, index }, distance }
                });
            let is_nearer = match (&nearest, &found) {
                (Some((_, Some(old))), Some(new)) => new.distance < old.distance,
                (_, Some(_)) => true,
                _ => false,
            };
            if is_nearer {
                nearest = Some((*back, found));
            }
        }
        nearest
    }
}

/// The entry whose rear bumper is nearest; of equal ones the first.
#[inline]
pub(crate) fn nearest(rears: impl Iterator<Item = (Spot, f64)>) -> Option<(Spot, f64)> {
    rears.reduce(|nearest, it| if it.1 < nearest.1 { it } else { nearest })
}

/// The nearer of two leaders.
pub(crate) fn nearer(one: Option<Ahead>, other: Option<Ahead>) -> Option<Ahead> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.gap < one.gap { other } else { one }),
        (one, other) => one.or(other),
    }
}
