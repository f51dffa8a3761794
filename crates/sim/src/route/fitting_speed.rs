//! The speed that fits the road ahead: drivers slow down for bends and lower speed limits before they reach them.
//!
//! To a place with the fitting speed v_c that is d ahead, a driver may come with √(v_c² + 2 b d), where b is gentle
//! braking. The places are those on its route, as far as it sees (all ours).

use laneweave_models::change::SIGHT;
use laneweave_models::{Style, bends};
use laneweave_network::{Bend, Chain, ChainIndex, Limit, Network, Position};

use crate::route::navigate::Navigator;
use crate::state::clock::Clock;
use crate::state::goal::Destination;
use crate::state::vehicle::{Class, desired_speed};

/// A driver who looks ahead along its route.
#[derive(Clone, Copy)]
pub(crate) struct Outlook<'a> {
    pub(crate) network: &'a Network,
    pub(crate) navigator: &'a Navigator,
    pub(crate) style: &'a Style,
    pub(crate) class: Class,
    pub(crate) destination: Destination,
}

impl Outlook<'_> {
    /// The speed [m/s] that the driver desires `at` its position, if it drives `speed` [m/s] until its turn in step
    /// `due`.
    #[inline]
    pub(crate) fn until_turn(&self, at: Position, speed: f64, due: u32, clock: Clock) -> f32 {
        self.fitting_speed(at, speed * clock.until(due)) as f32
    }

    /// The speed [m/s] that the driver desires `at` its position, if it drives `way` [m] before it looks again.
    #[inline]
    pub(crate) fn fitting_speed(&self, at: Position, way: f64) -> f64 {
        let Outlook { network, style, class, .. } = *self;
        let here = network.chain(at.chain);
        let desired = desired_speed(class, style, here.limit(at.x), &network.law);
        let reach = (way + desired * desired / (2.0 * style.manner.anticipating())).min(SIGHT);
        let is_clear = !here.has_slow_places && at.x + reach < here.length + here.slow_beyond;
        if is_clear || !style.manner.looks_ahead() { desired } else { self.slowed(at, way, reach, desired) }
    }

    /// The speed [m/s] that the driver desires whose front is `x` [m] beyond the end of the `last` chain, because half
    /// of its vehicle is in a bend there; infinite if it is not.
    #[inline]
    pub(crate) fn leaving_speed(&self, last: Option<ChainIndex>, x: f64) -> f32 {
        let half = 0.5 * self.class.body().length;
        last.filter(|_| x < half).map_or(f32::INFINITY, |it| self.speed_before_the_end(it, half - x))
    }

    /// The speed [m/s] that bends on the last `way` [m] of a chain allow.
    #[inline(never)]
    fn speed_before_the_end(&self, chain: ChainIndex, way: f64) -> f32 {
        let chain = self.network.chain(chain);
        let bends = chain.bends.iter().rev().take_while(|it| it.end > chain.length - way);
        bends.map(|it| self.bend_speed(it) as f32).fold(f32::INFINITY, f32::min)
    }

    /// The speed [m/s] at which the driver drives through a bend; infinite for one who does not slow for bends.
    pub(crate) fn bend_speed(&self, bend: &Bend) -> f64 {
        if self.style.manner.lateral_acceleration > 0.0 {
            self.bend_speed_squared(bend).sqrt()
        } else {
            f64::INFINITY
        }
    }

    fn bend_speed_squared(&self, bend: &Bend) -> f64 {
        let largest = self.style.manner.lateral_acceleration;
        bends::speed_squared(largest, self.class.is_long(), bend.curvature)
    }

    /// The fitting speed where slow places may be within `reach` [m], for a driver who would otherwise desire `desired`
    /// [m/s].
    #[inline(never)]
    fn slowed(&self, at: Position, way: f64, reach: f64, desired: f64) -> f64 {
        let Outlook { network, navigator, style, class, destination } = *self;
        let braking = style.manner.anticipating();
        // Squares of speeds, so that there is one root for all places.
        let mut least = desired * desired;
        let mut slow = |place: f64, squared: f64| {
            least = least.min(squared + 2.0 * braking * (place - way).max(0.0));
        };
        for leg in navigator.walk(network, destination, at.chain, -at.x).within(reach) {
            let (chain, start, begins) = (network.chain(leg.chain), leg.start, leg.before().is_some());
            let from = if begins { 0.0 } else { at.x };
            if style.manner.comfortable_deceleration > 0.0 {
                for limit in limits_from(chain, from, begins) {
                    let speed = desired_speed(class, style, limit.speed, &network.law);
                    slow(start + limit.start, speed * speed);
                }
            }
            if style.manner.lateral_acceleration > 0.0 {
                // A bend lasts until half of the vehicle has left it.
                let middle = from - 0.5 * class.body().length;
                let first = chain.bends.partition_point(|it| it.end <= middle);
                for bend in chain.bends[first..].iter().take_while(|it| start + it.start < reach) {
                    slow(start + bend.start, self.bend_speed_squared(bend));
                }
            }
        }
        least.sqrt()
    }
}

/// The speed limits of `chain` that begin beyond `from` [m], and the first one if a driver has yet `to_enter` it.
fn limits_from(chain: &Chain, from: f64, to_enter: bool) -> &[Limit] {
    let first = if to_enter { 0 } else { chain.limits.partition_point(|it| it.start <= from).max(1) };
    &chain.limits[first..]
}
