//! What reactive drivers do from the moment on in which they become drivers, and what was recorded of them: both are
//! seen in the same way in a world.

use std::collections::{BTreeMap, BTreeSet};

use laneweave::sim::Vehicle;
use laneweave::{Simulation, VehicleId};
use laneweave_network::{ChainIndex, Pose};
use laneweave_scenario::Played;

/// Vehicles are followed in detail for this time [s].
pub(super) const HORIZON: f64 = 10.0;
/// A leader further ahead counts as being there [m].
pub(super) const FARTHEST: f64 = 200.0;

/// A vehicle at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    /// Speed [m/s].
    pub(super) speed: f64,
    /// Gap to its leader, at most [`FARTHEST`] [m].
    pub(super) gap: f64,
    /// Its centre [m].
    pub(super) at: [f64; 2],
    /// Its heading [rad].
    pub(super) heading: f64,
}

/// A vehicle from the step on in which it becomes a driver, as long as it is comparable with its record: until a
/// recorded vehicle is handed over because of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trace {
    /// That step.
    pub(super) from: u32,
    /// It in every step of the first seconds.
    pub(super) samples: Vec<Sample>,
    /// The last step in which it is seen.
    pub(super) until: u32,
    /// A recorded vehicle was handed over because of it: what it does afterwards is not compared.
    pub(super) is_cut: bool,
    /// The step in which it first came into the lane beside its own.
    pub(super) changed: Option<u32>,
    chain: ChainIndex,
}

/// Which vehicles are followed.
pub(super) enum Followed<'a> {
    /// Those that have become drivers.
    Drivers,
    /// The recorded ones with these ids, from these steps on.
    Recorded(&'a BTreeMap<i64, Trace>),
}

/// Traces by the ids of the recording.
#[derive(Default)]
pub(super) struct Tracer {
    pub(super) traces: BTreeMap<i64, Trace>,
}

impl Tracer {
    /// Follows the vehicles of the recording in `simulation`, once after each step, but not those that are
    /// `not_compared` from now on.
    pub(super) fn observe(
        &mut self,
        simulation: &Simulation,
        followed: &Followed,
        not_compared: &BTreeSet<VehicleId>,
    ) {
        let now = simulation.clock().step;
        for Played { recorded, vehicle, is_reactive, .. } in simulation.played() {
            let known = self.traces.get_mut(&recorded);
            let is_compared = !not_compared.contains(&vehicle);
            let is_due = match (known, followed) {
                (Some(known), _) => {
                    let is_due = known.until + 1 == now && !known.is_cut;
                    known.is_cut |= is_due && !is_compared;
                    is_due && is_compared
                }
                (None, Followed::Drivers) => is_reactive && is_compared,
                (None, Followed::Recorded(drivers)) => {
                    drivers.get(&recorded).is_some_and(|it| it.from == now)
                }
            };
            let Some(vehicle) = simulation.view(vehicle).filter(|_| is_due) else { continue };
            if vehicle.is_on_its_own_path() == matches!(followed, Followed::Recorded(_)) {
                self.see(recorded, &vehicle, simulation);
            }
        }
    }

    fn see(&mut self, recorded: i64, vehicle: &Vehicle, simulation: &Simulation) {
        let (now, chain) = (simulation.clock().step, vehicle.spot.chain);
        let trace = self.traces.entry(recorded).or_insert_with(|| Trace {
            from: now,
            samples: Vec::new(),
            until: now,
            is_cut: false,
            changed: None,
            chain,
        });
        trace.until = now;
        let last = std::mem::replace(&mut trace.chain, chain);
        if last != chain && !simulation.network().chain(last).following.contains(&chain) {
            trace.changed.get_or_insert(now);
        }
        if f64::from(now - trace.from) * simulation.step_s() <= HORIZON + 0.5 * simulation.step_s() {
            trace.samples.push(sample(vehicle, simulation));
        }
    }
}

fn sample(vehicle: &Vehicle, simulation: &Simulation) -> Sample {
    let scene = simulation.scene();
    let ahead = vehicle.is_in_lane().then(|| scene.ahead(scene.viewpoint(vehicle.spot))).flatten();
    let Pose { at, heading } = vehicle.pose();
    Sample {
        speed: vehicle.speed(),
        gap: ahead.map_or(FARTHEST, |it| it.gap.clamp(0.0, FARTHEST)),
        at: [at.x, at.y],
        heading,
    }
}
