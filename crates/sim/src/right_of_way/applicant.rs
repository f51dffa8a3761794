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

    /// Whether its vehicle is within a zone, and would still be if it stopped after `stop` [m]. Around a roundabout
    /// wherever it stops is in the way of others.
    pub(crate) fn waits_within_a_zone(&self, scene: &Scene, stop: f64) -> bool {
        let is_round = scene.reservations.roundabouts.touches(self.from.chain);
        self.reservation.is_some_and(|own| {
            let stays = |it: &ZoneReservation| is_round || own.travelled + stop < it.leave;
            own.holds.iter().any(|it| it.enter < own.travelled && stays(it))
        })
    }

    /// Time until its front is `distance` ahead [s].
    pub(crate) fn time_to(&self, distance: f64) -> f64 {
        time_to_cover(distance, self.speed, self.desired)
    }
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Motorway, motorway};
    use laneweave_network::ZoneIndex;

    use super::*;
    use crate::junction::waiting_priority::ZoneReservation;
    use crate::right_of_way::survey::tests::standing;
    use crate::route::navigate::Navigator;
    use crate::state::some_style::some_style;
    use crate::view::snapshot::Snapshot;

    #[test]
    fn a_vehicle_waits_within_a_zone_that_it_has_entered_and_would_not_have_left_where_it_stops() {
        let network = motorway(&Motorway::default()).unwrap().build().unwrap().network;
        let (navigator, styles) = (Navigator::new(&network), [some_style()]);
        let snapshot = Snapshot::new(&network, [standing()]);
        let scene = snapshot.scene(&network, &navigator, &styles);
        let applicant = Applicant::at(&scene, snapshot.spot(1).unwrap());
        assert!(!applicant.waits_within_a_zone(&scene, 0.0));
        let waits_within = |travelled: f64, stop: f64| {
            let mut own = Reservation::default();
            own.travelled = travelled;
            own.holds = vec![ZoneReservation { zone: ZoneIndex(0), side: 0, enter: 20.0, leave: 40.0 }];
            Applicant { reservation: Some(&own), ..applicant }.waits_within_a_zone(&scene, stop)
        };
        assert!(!waits_within(19.9, 0.0) && !waits_within(20.0, 0.0) && waits_within(20.1, 0.0));
        assert!(waits_within(30.0, 9.9) && !waits_within(30.0, 10.0));
    }
}
