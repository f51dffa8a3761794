//! The lights switch.

use crate::junction::state::JunctionState;
use crate::route::roads::Roads;
use crate::state::traffic::Traffic;

/// The lights show what they show from now on.
pub(crate) fn switch_lights(roads: &Roads, traffic: &Traffic, junctions: &mut JunctionState) {
    junctions.switch(roads.network(), traffic.lanes(), traffic.clock());
}
