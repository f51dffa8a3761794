//! Drivers are guided.

use crate::route::guidance::SAMPLED_EVERY;
use crate::route::roads::Roads;
use crate::state::clock::Clock;
use crate::state::moving::Traffic;
use crate::step::world::World;

impl World {
    /// Measures and plans, if drivers are guided.
    pub(crate) fn guide(&mut self) {
        let World { roads, traffic, arrivals, .. } = self;
        let Roads { guidance, network, navigator, .. } = roads;
        let Traffic { clock, lanes, .. } = traffic;
        let Some(guidance) = guidance else { return };
        let Clock { step, dt } = *clock;
        if step.is_multiple_of(clock.steps(SAMPLED_EVERY)) {
            guidance.sample(lanes, navigator.links());
        }
        if step.is_multiple_of(guidance.period) {
            let times = guidance.measure(navigator.links(), dt);
            navigator.take_link_times(times.into_iter());
            guidance.look_who_drives(lanes, navigator);
        }
        guidance.plan(network, &arrivals.demand.destinations, navigator);
    }
}
