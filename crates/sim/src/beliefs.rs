//! What drivers believe of travel times, and for what gain they would leave their route.

use laneweave_models::Guidance;

use crate::navigate::{Destination, Navigator};
use crate::normal::quantile;
use crate::random::{Purpose, Random};
use crate::traffic::VehicleId;

/// What a driver believes since travel times were measured last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beliefs {
    /// What it takes the time of its own way for, as a multiple.
    pub(crate) own: f64,
    /// The same of other ways.
    pub(crate) other: f64,
    /// Gain for which it leaves its route [s].
    pub(crate) band: f64,
}

impl Beliefs {
    /// Who is recommended no other way knows the times, and keeps its own.
    pub(crate) const SETTLED: Beliefs = Beliefs { own: 1.0, other: 1.0, band: f64::INFINITY };

    /// Those of the driver of `id`, who follows `destination`.
    #[inline]
    pub(crate) fn of(
        guidance: &Guidance,
        navigator: &Navigator,
        random: Random,
        id: VehicleId,
        destination: Destination,
    ) -> Beliefs {
        match navigator.recommended(destination) {
            None => Beliefs::SETTLED,
            Some(_) => Beliefs::drawn(guidance, random, id, navigator.measurements()),
        }
    }

    #[inline(never)]
    fn drawn(guidance: &Guidance, random: Random, id: VehicleId, measurement: u32) -> Beliefs {
        let keeps = random.uniform(id, Purpose::Habit, 0) < guidance.habit
            || random.uniform(id, Purpose::Compliance, measurement) >= guidance.compliance;
        let band = if keeps { f64::INFINITY } else { guidance.indifference };
        if guidance.route_error == 0.0 {
            return Beliefs { band, ..Beliefs::SETTLED };
        }
        let belief = |of: u32| {
            let count = measurement.wrapping_mul(2) + of;
            guidance.belief(quantile(random.uniform(id, Purpose::Belief, count)))
        };
        Beliefs { own: belief(0), other: belief(1), band }
    }
}
