//! The lights switch.

use crate::step::world::World;

impl World {
    /// The lights show what they show from now on.
    pub(crate) fn switch_lights(&mut self) {
        self.junctions.signals.switch(&self.roads.network, &self.traffic.lanes, self.traffic.clock);
    }
}
