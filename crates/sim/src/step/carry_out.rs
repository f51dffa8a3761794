//! Commands of users are carried out, one after the other, before drivers decide.

use laneweave_network::{ChainIndex, Position};

use crate::demand::arrivals::Arrivals;
use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::command::{Command, Commanded};
use crate::state::control::Control;
use crate::state::externals::{Body, External, Kind, Service};
use crate::state::goal::Destination;
use crate::state::lane::{Counterpart, DriverState, Entry, Kinematics, LaneChangeState, VehicleId};
use crate::state::traffic::Traffic;
use crate::state::vehicle::LONGEST;
use crate::step::change_roads::desire_speed;
use crate::step::end_change::end_change;
use crate::step::index::Index;
use crate::step::move_externals::clear_obstacles;
use crate::step::names;
use crate::step::take_off::{end_trip, take_off};
use crate::view::pose::pose;
use crate::view::scene::{Scene, Spot};

/// What commands change, and what they depend on.
pub(super) struct CarryingOut<'a> {
    pub(super) roads: &'a Roads,
    pub(super) traffic: &'a mut Traffic,
    pub(super) junctions: &'a mut JunctionState,
    pub(super) arrivals: &'a mut Arrivals,
    pub(super) log: &'a mut Log,
    pub(super) index: &'a Index,
}

impl CarryingOut<'_> {
    /// Carries out `commands`, which were checked when they were given.
    pub(super) fn all(&mut self, commands: &[Commanded]) {
        commands.iter().for_each(|it| self.one(it.vehicle, &it.command));
    }

    fn one(&mut self, vehicle: Option<VehicleId>, command: &Command) {
        match command {
            // The roads are as it says already.
            Command::SetParameter { .. } | Command::CloseLanelet { .. } => {}
            // It is on the road already.
            Command::Insert(_) => vehicle.into_iter().for_each(|it| self.log.note_inserted(it)),
            Command::Remove(id) => self.remove(*id),
            Command::Control(id, control) => {
                self.leave_line(*id);
                self.control(*id, *control);
            }
            Command::SetStyle(id, style) => {
                if let Some(parameters) = names::parameters_of(self.roads, self.arrivals.demand(), style, *id)
                {
                    self.set_style(*id, parameters);
                }
            }
            Command::SetDestination(id, destination) => {
                self.leave_line(*id);
                let number = destination.and_then(|it| names::destination(self.arrivals.demand(), it));
                self.set_destination(*id, number);
            }
            Command::SetDemand { origin, vehicles_per_hour } => {
                if let Some(origin) = names::origin(self.arrivals.demand(), *origin) {
                    let (random, time) = (self.roads.random(), self.traffic.clock().time());
                    self.arrivals.set_rate(origin, *vehicles_per_hour, &random, time);
                }
            }
            Command::SetShare { style, weight } => {
                if let Some(number) = names::style(self.roads, self.arrivals.demand(), style) {
                    self.arrivals.set_weight(number, *weight);
                }
            }
            Command::SetLight { light, shows } => {
                if let Some(light) = names::light(self.roads.network(), *light) {
                    self.junctions.set_light(self.roads.network(), light, *shows, self.traffic.clock());
                }
            }
            Command::SetOffset { light, offset_s } => {
                if let Some((plan, cycle)) = names::plan(self.roads.network(), *light) {
                    self.junctions.set_offset(plan, cycle, *offset_s);
                }
            }
        }
    }

    /// The main entry of a vehicle, if it is in a lane.
    fn spot(&self, id: VehicleId) -> Option<Spot> {
        self.index.spot(self.traffic.lanes(), id)
    }

    pub(super) fn remove(&mut self, id: VehicleId) {
        let external = self.traffic.externals_mut().take(id);
        let off_road = external.as_ref().and_then(|it| Some((it.at.chain, *it.off_road()?)));
        if let Some(mut external) = external {
            clear_obstacles(self.traffic, &mut external);
        }
        let spot = self.spot(id);
        let CarryingOut { roads, traffic, junctions, log, .. } = self;
        if let Some((chain, entry)) = off_road {
            end_trip(roads, traffic, junctions, log, chain, &entry);
        } else if let Some(spot) = spot {
            take_off(roads, traffic, junctions, log, spot);
        }
    }

    /// Lets a user drive a vehicle in this way, or leaves it to its driver.
    pub(super) fn control(&mut self, id: VehicleId, control: Control) {
        let before = self.traffic.externals_mut().take(id);
        let mut external = match before {
            Some(external) => external,
            None => {
                let Some(spot) = self.spot(id) else { return };
                let x = self.traffic.lane(spot.chain).motions()[spot.index].x;
                External::new(id, control, Position::new(spot.chain, x))
            }
        };
        let was_on_its_own_path = external.body.is_some();
        external.control = control;
        match control {
            Control::Pose { .. } if external.body.is_some() => {}
            Control::Pose { .. } => external.body = self.body(id),
            Control::Drive { .. } => {
                if let Some(body) = external.body.take() {
                    self.back_in_lane(id, body.length);
                }
            }
        }
        if external.body.is_none() && was_on_its_own_path || !control.is_external() {
            clear_obstacles(self.traffic, &mut external);
        }
        self.change(id, |_, driver, _, _| driver.is_external = control.is_external());
        if let Some(spot) = self.spot(id) {
            external.phase = self.traffic.lane(spot.chain).drivers()[spot.index].phase;
        }
        if control.is_external() {
            self.traffic.externals_mut().add(external);
        }
    }

    /// A vehicle of a line of which a user disposes leaves its line, and drives to its end.
    fn leave_line(&mut self, id: VehicleId) {
        let external = self.traffic.externals().of(id);
        let Some(Kind::Line(service)) = external.map(|it| it.kind) else { return };
        if let Some(mut external) = self.traffic.externals_mut().take(id) {
            clear_obstacles(self.traffic, &mut external);
        }
        // Who is passing a junction keeps the way for which its reservation was granted.
        if !self.has_reservation(id) {
            let line = &self.arrivals.demand().lines[usize::from(service.line)];
            self.set_destination(id, Some(line.destination as u16));
        }
    }

    /// Whether a vehicle has a reservation of a junction.
    pub(super) fn has_reservation(&self, id: VehicleId) -> bool {
        let Some(Spot { chain, index }) = self.spot(id) else { return false };
        let number = self.traffic.lane(chain).lane_change_states()[index].reservation;
        self.junctions.reservations().of(number, id).is_some()
    }

    /// Lets a vehicle of a line drive in this way, as its `service` is.
    pub(super) fn direct(&mut self, id: VehicleId, service: Service, control: Control) {
        if let Some(external) = self.traffic.externals_mut().of_mut(id) {
            (external.kind, external.control) = (Kind::Line(service), control);
        }
    }

    /// The body of a vehicle that has driven in lanes. It no longer changes lanes.
    fn body(&mut self, id: VehicleId) -> Option<Body> {
        let spot = self.spot(id)?;
        let scene = Scene::of(self.roads, self.traffic, self.junctions);
        let (pose, motion, driver) = (pose(&scene, spot), scene.motion(spot), scene.driver(spot));
        let (speed, length, width) = (motion.speed, f64::from(motion.length), driver.class.body().width);
        end_change(self.roads.network(), self.traffic, self.log, spot);
        Some(Body { pose, length, width, speed, off_road: None })
    }

    /// A vehicle of this length [m] drives in lanes again. It is as long as it is, and considers lanes at once.
    fn back_in_lane(&mut self, id: VehicleId, length: f64) {
        let Some(spot) = self.spot(id) else { return };
        let step = self.traffic.clock().step;
        let (motion, driver, _) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        motion.length = length.min(LONGEST) as f32;
        driver.due = step;
        driver.needs_full_update = true;
    }

    /// Gives the driver of a vehicle another set of parameters. It considers lanes at once.
    fn set_style(&mut self, id: VehicleId, parameters: u32) {
        let (roads, step) = (self.roads, self.traffic.clock().step);
        self.change(id, |motion, driver, _, chain| {
            driver.parameters = parameters;
            desire_speed(
                driver,
                roads.outlook(driver).fitting_speed(Position::new(chain, motion.x), 0.0) as f32,
            );
            driver.due = step;
            driver.needs_full_update = true;
        });
    }

    /// Gives a driver another destination. It considers lanes at once.
    pub(super) fn set_destination(&mut self, id: VehicleId, number: Destination) {
        let (navigator, step) = (self.roads.navigator(), self.traffic.clock().step);
        self.change(id, |_, driver, lane_change, _| {
            driver.goal = navigator.seen_by(driver.class, number).into();
            driver.due = step;
            driver.needs_full_update = true;
            lane_change.last_place = f64::INFINITY;
        });
        self.log.set_destination(id, number.map(usize::from));
    }

    /// Changes the main entry of a vehicle, wherever it is, and the other entry of a vehicle between two lanes.
    fn change(
        &mut self,
        id: VehicleId,
        change: impl Fn(&Kinematics, &mut DriverState, &mut LaneChangeState, ChainIndex),
    ) {
        let Some(spot) = self.spot(id) else {
            let external = self.traffic.externals_mut().of_mut(id);
            let chain = external.as_ref().map(|it| it.at.chain);
            if let Some((chain, entry)) = chain.zip(external.and_then(External::off_road_mut)) {
                let Entry { motion, driver, lane_change } = entry;
                change(motion, driver, lane_change, chain);
            }
            return;
        };
        let (motion, driver, lane_change) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        change(motion, driver, lane_change, spot.chain);
        let Some(Counterpart { chain, x, .. }) = lane_change.counterpart else { return };
        let lane = self.traffic.lane_mut(chain);
        if let Some(index) = lane.find(id, x) {
            let (motion, driver, lane_change) = lane.entry_mut(index);
            change(motion, driver, lane_change, chain);
        }
    }
}
