//! A simulated world that is looked at.

use std::collections::HashMap;
use std::sync::Arc;

use laneweave::network::Rectangle;
use laneweave::scenario::{Origin, Scenario, read_map};
use laneweave::sim::{DriverState, LaneChangeState, Vehicle};
use laneweave::{Class, Event, Fault, Phase, Side, Simulation, VehicleId};

use laneweave_studies::branch::Parting;

use super::driver::{DriverFacts, desire};
use super::lanes::Lanes;
use super::turns::Turns;
use super::{DemandFacts, Mark, StyleFacts, Wants, marks};
use crate::scene::{Scene, Surroundings};
use crate::snapshot::{Body, Seen, Snapshot};

/// Brake lights are on below this acceleration [m/s²]: more than a vehicle loses by rolling. Ours.
const BRAKES: f32 = -0.7;
/// Brake lights are on below this speed [m/s]: the driver holds the vehicle.
const HOLDS: f64 = 0.1;

/// A scenario in simulation, and what was noted of it for the page.
pub(super) struct Driven {
    pub(super) simulation: Simulation,
    title: String,
    around: Surroundings,
    turns: Turns,
    noted: Noted,
}

/// What was noted of the past of a simulation.
#[derive(Clone, Debug)]
pub(super) struct Noted {
    lanes: Lanes,
    /// When each vehicle has last changed lanes [s].
    last_changes: HashMap<VehicleId, f64>,
}

impl Driven {
    /// The scenario at its start.
    pub(super) fn new(scenario: &Scenario, origin: &Origin) -> Result<Driven, Fault> {
        let map = read_map(scenario, origin)?;
        let around = Surroundings::of(&map);
        Ok(Driven::of(Simulation::from_scenario_on(map, scenario, origin)?, around))
    }

    /// A simulation as it is now, on a map that has this beside its network.
    pub(super) fn of(simulation: Simulation, around: Surroundings) -> Driven {
        let noted = Noted { lanes: Lanes::of(simulation.network()), last_changes: HashMap::new() };
        let turns = Turns::of(simulation.network());
        let map = &simulation.scenario().map;
        let title = map.file_name().unwrap_or(map.as_os_str()).to_string_lossy().into_owned();
        Driven { simulation, title, around, turns, noted }
    }

    pub(super) fn time_s(&self) -> f64 {
        self.simulation.time_s()
    }

    pub(super) fn title(&self) -> String {
        self.title.clone()
    }

    pub(super) fn scene(&self) -> Scene {
        Scene::new(&self.title, self.simulation.network(), &self.around)
    }

    /// The same traffic in the same state, to be driven on without it.
    pub(super) fn twin(&self) -> Result<Driven, Fault> {
        let mut twin = Driven::new(self.simulation.scenario(), self.simulation.origin())?;
        twin.simulation.restore(&self.simulation.save()?)?;
        twin.noted.clone_from(&self.noted);
        Ok(twin)
    }

    /// Becomes what `base` is now, and the twin of it.
    pub(super) fn part(&mut self, base: &Driven, parting: &Parting) -> Result<(), Fault> {
        parting.part(&base.simulation, &mut self.simulation)?;
        self.noted.clone_from(&base.noted);
        Ok(())
    }

    pub(super) fn styles(&self) -> Vec<StyleFacts> {
        self.simulation.styles().into_iter().map(StyleFacts::from).collect()
    }

    pub(super) fn demand(&self) -> Vec<DemandFacts> {
        let origins = self.simulation.origins().into_iter();
        origins
            .map(|(id, vehicles_per_hour)| DemandFacts { origin: id.to_string(), vehicles_per_hour })
            .collect()
    }

    /// Simulates a step, and notes what happened in it.
    pub(super) fn step(&mut self, marks: &mut Vec<Mark>) {
        let events = self.simulation.step();
        let Driven { simulation, noted: Noted { lanes, last_changes }, .. } = self;
        for event in &events {
            match event {
                Event::LaneChange(change) if change.is_completed => {
                    last_changes.insert(change.vehicle, change.time_s);
                    let lanelet = simulation.network().lanelet_with(change.from_lanelet);
                    lanelet.into_iter().for_each(|it| lanes.changed(it.at()));
                }
                Event::Completed { occurrence, .. } | Event::Removed(occurrence) => {
                    last_changes.remove(&occurrence.vehicle);
                }
                _ => {}
            }
        }
        marks.extend(events.iter().filter_map(|it| marks::mark(it, simulation.network())));
        lanes.look(simulation);
    }

    /// What was noted until now.
    pub(super) fn noted(&self) -> Noted {
        self.noted.clone()
    }

    /// Time has jumped to where this was noted.
    pub(super) fn know(&mut self, noted: &Noted) {
        self.noted.clone_from(noted);
    }

    /// Adds what can be seen now.
    pub(super) fn see(&self, wants: &Wants, snapshot: &mut Snapshot) {
        let simulation = &self.simulation;
        snapshot.time_s = self.time_s();
        snapshot.waiting = simulation.waiting_to_enter();
        snapshot.lights = simulation.lights().into_iter().map(|it| it.state).collect();
        let vehicles = simulation.views().map(|it| self.seen(&it, wants));
        snapshot.vehicles = vehicles.chain(simulation.obstacles().map(obstacle)).collect();
        for id in &wants.selected {
            let vehicle = VehicleId::try_from(*id).ok().and_then(|it| simulation.view(it));
            let facts = vehicle.and_then(|it| serde_json::to_string(&self.facts(&it)).ok());
            snapshot.drivers.extend(facts.map(|it| (*id, Arc::from(it))));
        }
        if wants.lanes {
            snapshot.lanes = serde_json::to_string(&self.noted.lanes.rows()).ok().map(Arc::from);
        }
    }

    /// Whether a vehicle of a replay moves as it was recorded.
    fn is_recorded(&self, vehicle: &Vehicle) -> bool {
        self.simulation.scenario().replay.is_asked() && vehicle.is_on_its_own_path()
    }

    fn facts(&self, vehicle: &Vehicle) -> DriverFacts {
        let facts = DriverFacts::of(&self.simulation, vehicle);
        if self.is_recorded(vehicle) { facts.of_recorded() } else { facts }
    }

    fn seen(&self, vehicle: &Vehicle, wants: &Wants) -> Seen {
        let (pose, [length, width], driver) = (vehicle.pose(), vehicle.size(), vehicle.driver);
        let is_desire_wanted = wants.desire && vehicle.is_in_lane();
        let is_recorded = self.is_recorded(vehicle);
        Seen {
            id: i64::from(vehicle.id()),
            at: [pose.at.x, pose.at.y, pose.at.z],
            heading: pose.heading,
            speed: vehicle.speed(),
            length,
            width,
            body: body(driver.class),
            style: vehicle.style_number() as u8,
            phase: driver.phase as u8,
            is_braking: vehicle.motion.acceleration < BRAKES || vehicle.speed() < HOLDS,
            signals: signals(driver, vehicle.lane_change)
                .or_else(|| self.turns.side(&self.simulation, vehicle)),
            is_external: driver.is_external && !is_recorded,
            is_recorded,
            values: [
                if is_desire_wanted { desire(&self.simulation, vehicle.id()) } else { 0 },
                self.delay(vehicle),
                self.since_change(vehicle.id()),
                0,
            ],
        }
    }

    /// The delay of a vehicle as the byte of a frame.
    fn delay(&self, vehicle: &Vehicle) -> u8 {
        let Some(trip) = self.simulation.trip(vehicle.id()) else { return 0 };
        let desired = f64::from(vehicle.driver.desired).max(1.0);
        let free = (trip.way_to_start + vehicle.x()) / desired;
        let lost = self.time_s() - trip.entered - free;
        1 + (lost / 2.0).round().clamp(0.0, 253.0) as u8
    }

    /// Time since the last lane change of a vehicle, as the byte of a frame.
    fn since_change(&self, vehicle: VehicleId) -> u8 {
        let since = self.noted.last_changes.get(&vehicle).map(|it| self.time_s() - it);
        since.map_or(u8::MAX, |it| 1 + it.round().clamp(0.0, 253.0) as u8)
    }

    /// Where a vehicle is [m].
    pub(super) fn find(&self, id: i64) -> Option<[f64; 2]> {
        let pose = self.simulation.view(VehicleId::try_from(id).ok()?)?.pose();
        Some([pose.at.x, pose.at.y])
    }
}

fn body(class: Class) -> Body {
    match class {
        Class::Car | Class::Taxi | Class::Emergency => Body::Car,
        Class::Truck => Body::Truck,
        Class::Bus => Body::Bus,
        Class::Motorcycle => Body::Motorcycle,
    }
}

/// The side to which a driver signals: it wants to change there, or does.
fn signals(driver: &DriverState, lane_change: &LaneChangeState) -> Option<Side> {
    matches!(driver.phase, Phase::Wants | Phase::Changes).then_some(lane_change.side)
}

/// An obstacle, as grey as what is recorded.
fn obstacle((id, it): (VehicleId, Rectangle)) -> Seen {
    Seen {
        id: i64::from(id),
        at: [it.pose.at.x, it.pose.at.y, it.pose.at.z],
        heading: it.pose.heading,
        speed: 0.0,
        length: it.length,
        width: it.width,
        body: body(Class::Car),
        style: 0,
        phase: 0,
        is_braking: false,
        signals: None,
        is_external: false,
        is_recorded: true,
        values: [0; 4],
    }
}
