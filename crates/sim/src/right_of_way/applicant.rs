//! The applicant for a reservation: all that the right of way depends on. The vehicle is on the road, or waits to
//! enter it.

use laneweave_models::Style;
use laneweave_models::yielding::time_to_cover;

use crate::junction::reservations::Reservation;
use crate::junction::waiting_priority::ZoneReservation;
use crate::view::scene::{Scene, Spot, Viewpoint};

/// A vehicle whose driver asks for a reservation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Applicant<'a> {
    /// Where it is, and its destination.
    pub(crate) from: Viewpoint,
    /// Length [m].
    pub(crate) length: f64,
    /// Speed [m/s].
    pub(crate) speed: f64,
    /// Desired speed [m/s].
    pub(crate) desired: f64,
    /// The style of its driver.
    pub(crate) style: &'a Style,
    /// The reservation that it already has.
    pub(crate) reservation: Option<&'a Reservation>,
}

impl<'a> Applicant<'a> {
    /// The driver at `spot`.
    #[inline]
    pub(crate) fn at(scene: &Scene<'a>, spot: Spot) -> Applicant<'a> {
        let (motion, driver) = (scene.motion(spot), scene.driver(spot));
        Applicant {
            from: scene.viewpoint(spot),
            length: f64::from(motion.length),
            speed: motion.speed,
            desired: f64::from(driver.desired),
            style: scene.style_of(driver),
            reservation: scene.reservations.of(scene.lane_change(spot).reservation, motion.id),
        }
    }

    /// Whether its vehicle is within a zone, and would still be if it stopped after `stop` [m].
    pub(crate) fn waits_within_a_zone(&self, stop: f64) -> bool {
        self.reservation.is_some_and(|own| {
            let is_within =
                |it: &ZoneReservation| it.enter < own.travelled && own.travelled + stop < it.leave;
            own.holds.iter().any(is_within)
        })
    }

    /// Time until its front is `distance` ahead [s].
    pub(crate) fn time_to(&self, distance: f64) -> f64 {
        time_to_cover(distance, self.speed, self.desired)
    }
}
