//! Twins as ghosts: the vehicles of the twin beside those of the traffic, and how far each is from its own in the
//! other.

use std::collections::HashMap;

use super::Wants;
use super::driven::Driven;
use crate::snapshot::{Seen, Snapshot};

/// Distances are told in steps of this [m].
const STEP: f64 = 0.5;
/// The byte of a frame for a vehicle that is where its twin is, and the one for the largest distance.
const SAME: u8 = 1;
const LARGEST: f64 = 254.0;

/// Where vehicles are, by their ids [m].
type Places = HashMap<i64, [f64; 3]>;

/// Adds the vehicles of `twin` to a snapshot as ghosts, and how far each vehicle is from its own in the other traffic.
pub(super) fn add(twin: &Driven, wants: &Wants, snapshot: &mut Snapshot) {
    let mut of_twin = Snapshot::default();
    twin.see(&Wants { desire: wants.desire, ..Wants::default() }, &mut of_twin);
    let [here, there] = [&*snapshot, &of_twin].map(places);
    snapshot.vehicles.iter_mut().for_each(|it| it.values[3] = difference(it, &there));
    let ghosts = of_twin.vehicles.into_iter().map(|it| ghost(it, &here));
    snapshot.vehicles.extend(ghosts);
    snapshot.twin_lights = of_twin.lights;
}

fn places(snapshot: &Snapshot) -> Places {
    snapshot.vehicles.iter().map(|it| (it.id, it.at)).collect()
}

/// A vehicle of the twin. Its id is that of no vehicle.
fn ghost(mut it: Seen, here: &Places) -> Seen {
    it.values[3] = difference(&it, here);
    Seen { id: -1 - it.id, is_external: true, is_recorded: true, ..it }
}

/// The distance of a vehicle from its own in the other traffic, as the byte of a frame; the largest byte stands for a
/// vehicle that is not there.
fn difference(it: &Seen, others: &Places) -> u8 {
    let [x, y, _] = it.at;
    others.get(&it.id).map_or(u8::MAX, |[other_x, other_y, _]| match (x - other_x).hypot(y - other_y) {
        0.0 => SAME,
        distance => (1.0 + (distance / STEP).round()).clamp(f64::from(SAME) + 1.0, LARGEST) as u8,
    })
}
