//! A simulated world that is looked at.

use std::collections::HashMap;
use std::sync::Arc;

use laneweave::branch::Parting;
use laneweave::network::LightIndex;
use laneweave::scenario::{Origin, Prepared, Scenario, prepare_on, read_map};
use laneweave::sim::{DriverState, Event, LaneChangeState, Vehicle, World};
use laneweave::{Class, Fault, Phase, Side, VehicleId};

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
    pub(super) scenario: Scenario,
    pub(super) origin: Origin,
    pub(super) prepared: Prepared,
    title: String,
    around: Surroundings,
    turns: Turns,
    noted: Noted,
    /// The index of the style of each set of driver parameters.
    style_of: Vec<u8>,
}

/// What was noted of the past of a world.
#[derive(Clone, Debug)]
pub(super) struct Noted {
    lanes: Lanes,
    /// When each vehicle has last changed lanes [s].
    last_changes: HashMap<VehicleId, f64>,
}

impl Driven {
    /// The scenario at its start.
    pub(super) fn new(scenario: Scenario, origin: Origin) -> Result<Driven, Fault> {
        let map = read_map(&scenario, &origin)?;
        let around = Surroundings::of(&map);
        let prepared = prepare_on(map, &scenario, &origin)?;
        let noted = Noted { lanes: Lanes::of(prepared.world.network()), last_changes: HashMap::new() };
        let turns = Turns::of(prepared.world.network());
        let name = scenario.map.file_name().unwrap_or(scenario.map.as_os_str());
        let title = name.to_string_lossy().into_owned();
        let style_of = Vec::new();
        let mut driven = Driven { scenario, origin, prepared, title, around, turns, noted, style_of };
        driven.know_styles();
        Ok(driven)
    }

    pub(super) fn world(&self) -> &World {
        &self.prepared.world
    }

    pub(super) fn time_s(&self) -> f64 {
        self.world().clock().time()
    }

    pub(super) fn title(&self) -> String {
        self.title.clone()
    }

    pub(super) fn scene(&self) -> Scene {
        Scene::new(&self.title, self.world().network(), &self.around)
    }

    /// The same world in the same state, to be driven on without it.
    pub(super) fn twin(&self) -> Result<Driven, Fault> {
        let bug = |error: &dyn std::fmt::Display| Fault::new("twin", error, "report this as a bug");
        let mut twin = Driven::new(self.scenario.clone(), self.origin.clone())?;
        let saved = self.prepared.save().map_err(|error| bug(&error))?;
        twin.prepared.restore(&saved).map_err(|error| bug(&error))?;
        twin.follow(self);
        Ok(twin)
    }

    /// Becomes what `base` is now, and the twin of it.
    pub(super) fn part(&mut self, base: &Driven, parting: &Parting) -> Result<(), Fault> {
        parting.part(&base.prepared, &mut self.prepared)?;
        self.follow(base);
        Ok(())
    }

    /// Knows what was noted of `other`, which has the same state.
    fn follow(&mut self, other: &Driven) {
        self.noted.clone_from(&other.noted);
        self.know_styles();
    }

    /// Finds the style of each set of driver parameters.
    fn know_styles(&mut self) {
        let names = &self.prepared.styles;
        let index = |name: &str| names.iter().position(|(it, _)| it == name).unwrap_or(0) as u8;
        self.style_of = self.prepared.world.driver_parameters().iter().map(|it| index(&it.name)).collect();
    }

    pub(super) fn styles(&self) -> Vec<StyleFacts> {
        let world = self.world();
        let drivers = world.driver_parameters();
        let population = world.demand().population.iter().zip(world.style_weights());
        let weight = |name: &str| {
            let of_name = population.clone().filter(|(it, _)| drivers[it.first as usize].name == name);
            of_name.map(|(_, weight)| weight).sum()
        };
        let styles = self.prepared.styles.iter();
        styles.map(|(name, _)| StyleFacts::of(name, weight(name), drivers)).collect()
    }

    pub(super) fn demand(&self) -> Vec<DemandFacts> {
        let now = self.time_s();
        let facts = |it: &laneweave::sim::Origin| DemandFacts {
            origin: it.place.id().to_string(),
            vehicles_per_hour: it.rate.at(now),
        };
        self.world().demand().origins.iter().map(facts).collect()
    }

    /// Simulates a step, and notes what happened in it.
    pub(super) fn step(&mut self, marks: &mut Vec<Mark>) {
        self.prepared.step();
        let Driven { prepared: Prepared { world, .. }, noted: Noted { lanes, last_changes }, .. } = self;
        for event in world.events() {
            match event {
                Event::LaneChange(it) if it.is_completed => {
                    last_changes.insert(it.vehicle, it.time);
                    if let Some(lanelet) =
                        world.network().lanelet_with(world.network().lanelet_at(it.from).0.id)
                    {
                        lanes.changed(lanelet.at());
                    }
                }
                Event::Left { vehicle, .. } | Event::Removed { vehicle, .. } => {
                    last_changes.remove(vehicle);
                }
                _ => {}
            }
        }
        marks::look(world, marks);
        lanes.look(world);
        if self.style_of.len() != self.world().driver_parameters().len() {
            self.know_styles();
        }
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
        let world = self.world();
        snapshot.time_s = self.time_s();
        snapshot.waiting = world.waiting();
        let scene = world.scene();
        let lights = 0..world.network().junctions.lights.len() as u32;
        snapshot.lights = lights.map(|it| scene.light(LightIndex(it))).collect();
        snapshot.vehicles = world.vehicles().map(|it| self.seen(&it, wants)).collect();
        for id in &wants.selected {
            let vehicle = VehicleId::try_from(*id).ok().and_then(|it| world.vehicle(it));
            let facts = vehicle.and_then(|it| serde_json::to_string(&self.facts(&it)).ok());
            snapshot.drivers.extend(facts.map(|it| (*id, Arc::from(it))));
        }
        if wants.lanes {
            snapshot.lanes = serde_json::to_string(&self.noted.lanes.rows()).ok().map(Arc::from);
        }
    }

    /// Whether a vehicle of a replay moves as it was recorded.
    fn is_recorded(&self, vehicle: &Vehicle) -> bool {
        self.scenario.replay.is_asked() && vehicle.is_on_its_own_path()
    }

    fn facts(&self, vehicle: &Vehicle) -> DriverFacts {
        let facts = DriverFacts::of(self.world(), vehicle);
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
            style: self.style_of.get(driver.parameters as usize).copied().unwrap_or_default(),
            phase: driver.phase as u8,
            is_braking: vehicle.motion.acceleration < BRAKES || vehicle.speed() < HOLDS,
            signals: signals(driver, vehicle.lane_change).or_else(|| self.turns.side(self.world(), vehicle)),
            is_external: driver.is_external && !is_recorded,
            is_recorded,
            values: [
                if is_desire_wanted { desire(self.world(), vehicle.spot) } else { 0 },
                self.delay(vehicle),
                self.since_change(vehicle.id()),
                0,
            ],
        }
    }

    /// The delay of a vehicle as the byte of a frame.
    fn delay(&self, vehicle: &Vehicle) -> u8 {
        let Some(trip) = self.world().trip(vehicle.id()) else { return 0 };
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
        let pose = self.world().vehicle(VehicleId::try_from(id).ok()?)?.pose();
        Some([pose.at.x, pose.at.y])
    }
}

fn body(class: Class) -> Body {
    match class {
        Class::Car => Body::Car,
        Class::Truck => Body::Truck,
        Class::Bus => Body::Bus,
        Class::Motorcycle => Body::Motorcycle,
    }
}

/// The side to which a driver signals: it wants to change there, or does.
fn signals(driver: &DriverState, lane_change: &LaneChangeState) -> Option<Side> {
    matches!(driver.phase, Phase::Wants | Phase::Changes).then_some(lane_change.side)
}
