//! The lights switch. What they show is in `junction/signals.rs`, and actuated ones are in
//! `junction/actuated_signals.rs`.

use crate::junction::state::JunctionState;
use crate::route::roads::Roads;
use crate::state::traffic::Traffic;

/// Switches the lights to their states at this time.
pub(crate) fn switch_lights(roads: &Roads, traffic: &Traffic, junctions: &mut JunctionState) {
    junctions.switch(roads.network(), traffic.lanes(), traffic.clock());
}
