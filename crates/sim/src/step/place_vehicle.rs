//! Vehicles are placed outside of the demand, by programs that know where they want them.

use crate::demand::error::WorldError;
use crate::route::roads::Roads;
use crate::state::lane::VehicleId;
use crate::state::setup::Placement;
use crate::step::put_vehicle::{Named, put};
use crate::step::world::World;

impl World {
    /// Places a vehicle on the road outside of the demand. Its place must be free. Returns its id.
    ///
    /// # Errors
    /// If it is not on a chain of the network, its speed is negative or no number, or there are no such driver
    /// parameters or destination.
    pub fn place(&mut self, vehicle: Placement) -> Result<VehicleId, WorldError> {
        self.index.forget();
        let World { roads, traffic, arrivals, log, .. } = self;
        check_new(roads, arrivals.demand().destinations.len(), &vehicle)?;
        let id = arrivals.new_id();
        let (now, length) = (traffic.clock().time(), vehicle.class.body().length);
        put(roads, traffic, log, vehicle, Named { id, arrived: now, length, line: None });
        Ok(id)
    }
}

fn check_new(roads: &Roads, destinations: usize, vehicle: &Placement) -> Result<(), WorldError> {
    let Placement { chain, x, speed, class: _, parameters, destination } = *vehicle;
    let length = roads.network().chains.get(chain.at()).map(|it| it.length);
    let refused = [
        (length.is_none(), "there is no such chain"),
        (!length.is_some_and(|it| (0.0..=it).contains(&x)), "it would not be on its chain"),
        (!(speed.is_finite() && speed >= 0.0), "its speed is no number from 0 on"),
        (roads.driver_parameters().len() <= parameters as usize, "there are no such driver parameters"),
        (destination.is_some_and(|it| usize::from(it) >= destinations), "there is no such destination"),
    ];
    refused.into_iter().find(|it| it.0).map_or(Ok(()), |it| Err(WorldError::Vehicle(it.1)))
}
