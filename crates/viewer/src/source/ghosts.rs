//! The unchanged twin of a simulation: the same traffic without what is done by hand since the twin began.

use std::collections::HashMap;

use super::Wants;
use super::driven::Driven;
use crate::snapshot::{Seen, Snapshot};

/// Distances are told in steps of this [m].
const STEP: f64 = 0.5;

/// Adds the vehicles of `twin` to a snapshot as ghosts, and how far each vehicle is from its ghost.
pub(super) fn add(twin: &Driven, snapshot: &mut Snapshot) {
    let mut of_twin = Snapshot::default();
    twin.see(&Wants::default(), &mut of_twin);
    let places: HashMap<i64, [f64; 3]> = of_twin.vehicles.iter().map(|it| (it.id, it.at)).collect();
    for vehicle in &mut snapshot.vehicles {
        vehicle.values[3] = places.get(&vehicle.id).map_or(u8::MAX, |it| difference(vehicle.at, *it));
    }
    snapshot.vehicles.extend(of_twin.vehicles.into_iter().map(ghost));
}

/// A vehicle of the twin. Its id is that of no vehicle.
fn ghost(it: Seen) -> Seen {
    Seen { id: -1 - it.id, is_external: true, is_recorded: true, ..it }
}

/// A distance as the byte of a frame: 1 for none, 254 for the largest; 255 stands for a vehicle without a ghost.
fn difference([x, y, _]: [f64; 3], [other_x, other_y, _]: [f64; 3]) -> u8 {
    1 + ((x - other_x).hypot(y - other_y) / STEP).round().min(253.0) as u8
}
