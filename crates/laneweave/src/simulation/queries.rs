//! Questions about the traffic, which change nothing.

use laneweave_network::{Id, Position, Rectangle};
use laneweave_scenario::Fault;
use laneweave_sim::{Columns, Intention, Rows, Scene, Vehicle, VehicleId};

use super::{Simulation, VehicleState};

impl Simulation {
    /// The id of the external vehicle that the scenario calls `name`, as soon as it is on the road.
    pub fn external(&self, name: &str) -> Option<VehicleId> {
        self.prepared.script.external(name)
    }

    /// All vehicles on the road, in the order of their ids.
    pub fn vehicles(&self) -> Vec<VehicleState> {
        let world = self.world();
        let mut vehicles: Vec<VehicleState> =
            world.vehicles().map(|it| VehicleState::of(world, &it)).collect();
        vehicles.sort_by_key(|it| it.id);
        vehicles
    }

    /// The vehicles on the road without copies, lane by lane and in driving order: for programs that look at all of
    /// them after every step.
    pub fn views(&self) -> impl Iterator<Item = Vehicle<'_>> {
        self.world().vehicles()
    }

    /// The ids of the obstacles on the road, and the ground that they cover.
    pub fn obstacles(&self) -> impl Iterator<Item = (VehicleId, Rectangle)> + '_ {
        self.world().obstacles()
    }

    /// The vehicle with this id, without a copy. `None` if it is not on the road.
    pub fn view(&self, id: VehicleId) -> Option<Vehicle<'_>> {
        self.world().vehicle(id)
    }

    /// This instant as drivers perceive it.
    pub fn scene(&self) -> Scene<'_> {
        self.world().scene()
    }

    /// The vehicle with this id. `None` if it is not on the road.
    pub fn vehicle(&self, id: VehicleId) -> Option<VehicleState> {
        self.world().vehicle(id).map(|it| VehicleState::of(self.world(), &it))
    }

    /// The vehicles with their front bumper on a lanelet, in driving order: the last one is the foremost.
    ///
    /// # Errors
    /// If there is no such lanelet.
    pub fn vehicles_on(&self, lanelet: impl Into<Id>) -> Result<Vec<VehicleState>, Fault> {
        let (world, network, lanelet) = (self.world(), self.network(), lanelet.into());
        let index = network.lanelet_with(lanelet).ok_or_else(|| {
            let what = format!("there is no lanelet {lanelet}");
            Fault::new("vehicles_on", what, "choose one that vehicles may use")
        })?;
        let (chain, scene) = (network.start_of(index).chain, world.scene());
        let entries = scene.motions(chain).iter().zip(scene.drivers(chain));
        let there = entries.filter(|(motion, driver)| {
            !driver.is_shadow && network.lanelet_at(Position::new(chain, motion.x)).0.id == lanelet
        });
        Ok(there.filter_map(|(motion, _)| self.vehicle(motion.id)).collect())
    }

    /// The ids of all lanelets, in the order of the indices in [`Columns::lanelet`].
    pub fn lanelets(&self) -> Vec<Id> {
        self.network().lanelets.iter().map(|it| it.id).collect()
    }

    /// Fills `columns` with all vehicles: faster than [`Simulation::vehicles`], and without new memory from call to
    /// call.
    pub fn columns(&self, columns: &mut Columns) {
        self.world().columns(columns);
    }

    /// Fills as many of the next `rows` as there are vehicles.
    pub(crate) fn fill(&self, rows: &mut Rows) {
        self.world().fill(rows);
    }

    /// What the driver of a vehicle intends to do in the next step, whoever drives the vehicle. `None` if the vehicle
    /// is not on the road.
    pub fn intention(&self, id: VehicleId) -> Option<Intention> {
        self.world().intention(id)
    }

    /// What the driver of a vehicle makes of its lanes and is about to do, in words. `None` if the vehicle is not on
    /// the road.
    pub fn explain(&self, id: VehicleId) -> Option<String> {
        crate::explain::now(self.world(), id)
    }
}
