//! Commands of users are carried out, one after the other, before drivers decide.

use laneweave_network::{ChainIndex, Position};

use crate::demand::arrivals::Arrivals;
use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::command::{Command, Commanded};
use crate::state::control::Control;
use crate::state::externals::{External, Externals};
use crate::state::goal::Destination;
use crate::state::lane::{Counterpart, DriverState, Kinematics, LaneChangeState, VehicleId};
use crate::state::traffic::Traffic;
use crate::step::index::Index;
use crate::step::names;
use crate::step::take_off::take_off;
use crate::view::scene::Spot;

/// What commands change, and what they depend on.
pub(super) struct CarryingOut<'a> {
    pub(super) roads: &'a Roads,
    pub(super) traffic: &'a mut Traffic,
    pub(super) junctions: &'a mut JunctionState,
    pub(super) arrivals: &'a mut Arrivals,
    pub(super) log: &'a mut Log,
    pub(super) externals: &'a mut Externals,
    pub(super) index: &'a Index,
}

impl CarryingOut<'_> {
    /// Carries out `commands`, which were checked when they were given.
    pub(super) fn all(&mut self, commands: &[Commanded]) {
        commands.iter().for_each(|it| self.one(it.vehicle, &it.command));
    }

    fn one(&mut self, vehicle: Option<VehicleId>, command: &Command) {
        let spot = |it: &Self, id| it.index.spot(it.traffic.lanes(), id);
        match command {
            // It is on the road already.
            Command::Insert(_) => vehicle.into_iter().for_each(|it| self.log.note_inserted(it)),
            Command::Remove(id) => {
                if let Some(spot) = spot(self, *id) {
                    take_off(self.roads, self.traffic, self.junctions, self.log, spot);
                    self.externals.forget(*id);
                }
            }
            Command::Control(id, control) => {
                if let Some(spot) = spot(self, *id) {
                    self.control(*id, spot, *control);
                }
            }
            Command::SetStyle(id, style) => {
                let parameters = names::parameters_of(self.roads, style, *id);
                if let (Some(spot), Some(parameters)) = (spot(self, *id), parameters) {
                    self.set_style(spot, parameters);
                }
            }
            Command::SetDestination(id, destination) => {
                let number = destination.and_then(|it| names::destination(self.arrivals.demand(), it));
                if let Some(spot) = spot(self, *id) {
                    self.set_destination(spot, number);
                }
            }
            Command::SetDemand { origin, vehicles_per_hour } => {
                if let Some(origin) = names::origin(self.arrivals.demand(), *origin) {
                    let (random, time) = (self.roads.random(), self.traffic.clock().time());
                    self.arrivals.set_rate(origin, *vehicles_per_hour, &random, time);
                }
            }
            Command::SetLight { light, shows } => {
                if let Some(light) = names::light(self.roads.network(), *light) {
                    self.junctions.set_light(self.roads.network(), light, *shows, self.traffic.clock());
                }
            }
        }
    }

    fn control(&mut self, id: VehicleId, spot: Spot, control: Control) {
        let is_external = control.is_external();
        self.change_both(spot, |_, driver, _, _| driver.is_external = is_external);
        let lane = self.traffic.lane(spot.chain);
        let at = Position::new(spot.chain, lane.motions()[spot.index].x);
        let phase = lane.drivers()[spot.index].phase;
        if is_external {
            self.externals.set(External { id, control, at, phase });
        } else {
            self.externals.forget(id);
        }
    }

    /// Gives the driver at `spot` another set of parameters. It considers lanes at once.
    fn set_style(&mut self, spot: Spot, parameters: u32) {
        let (network, style) = (self.roads.network(), self.roads.style(parameters));
        let step = self.traffic.clock().step;
        self.change_both(spot, |motion, driver, _, chain| {
            driver.parameters = parameters;
            driver.limit_desired =
                driver.class.desired_speed(style, network.chain(chain).limit(motion.x)) as f32;
            driver.desired = driver.desired.max(driver.limit_desired);
            driver.due = step;
            driver.needs_full_update = true;
        });
    }

    /// Gives the driver at `spot` another destination. It considers lanes at once.
    fn set_destination(&mut self, spot: Spot, number: Destination) {
        let (navigator, step) = (self.roads.navigator(), self.traffic.clock().step);
        self.change_both(spot, |_, driver, lane_change, _| {
            driver.goal = navigator.seen_by(driver.class, number).into();
            driver.due = step;
            driver.needs_full_update = true;
            lane_change.last_place = f64::INFINITY;
        });
        let id = self.traffic.lane(spot.chain).motions()[spot.index].id;
        self.log.set_destination(id, number.map(usize::from));
    }

    /// Changes the entry at `spot` and, between two lanes, the other entry of its vehicle.
    fn change_both(
        &mut self,
        spot: Spot,
        change: impl Fn(&Kinematics, &mut DriverState, &mut LaneChangeState, ChainIndex),
    ) {
        let (motion, driver, lane_change) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        change(motion, driver, lane_change, spot.chain);
        let (id, counterpart) = (motion.id, lane_change.counterpart);
        let Some(Counterpart { chain, x, .. }) = counterpart else { return };
        let lane = self.traffic.lane_mut(chain);
        if let Some(index) = lane.find(id, x) {
            let (motion, driver, lane_change) = lane.entry_mut(index);
            change(motion, driver, lane_change, chain);
        }
    }
}
