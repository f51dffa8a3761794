use laneweave_network::ChainIndex;

use super::*;

const LENGTH: f64 = 4.5;
const ZONE: ZoneIndex = ZoneIndex(0);
const SECTION: StorageSection = StorageSection::first_of(ChainIndex(0));

/// Reservations of a network with one zone, and one chain beyond it.
fn of_one_zone() -> Reservations {
    Reservations {
        queues: vec![Vec::new()],
        priorities: vec![[None; 2]],
        numbers: Numbers::of_chains(1),
        kept: vec![0],
        ..Reservations::default()
    }
}

/// A survey over the zone from 10 m to 15 m ahead, with a light at 8 m, to a place beyond it.
fn over_the_zone(side: u8) -> Survey {
    Survey {
        lights: vec![(LightIndex(0), 8.0)],
        holds: vec![ZoneReservation { zone: ZONE, side, enter: 10.0, leave: 15.0 + LENGTH }],
        extent: 15.0 + LENGTH,
        needed: LENGTH + 2.0,
        ..Survey::default()
    }
}

fn order(reservations: &Reservations) -> Vec<VehicleId> {
    reservations.order(ZONE).map(|(_, reservation)| reservation.vehicle).collect()
}

#[test]
fn who_was_given_a_reservation_first_goes_first_until_its_rear_has_left_the_zone() {
    let mut reservations = of_one_zone();
    let first = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    reservations.grant(NO_RESERVATION, 3, LENGTH, &over_the_zone(1));
    assert_eq!(order(&reservations), [7, 3]);
    reservations.advance(first, 19.4, 10.0, 14.0);
    assert_eq!(order(&reservations), [7, 3]);
    reservations.advance(first, 0.1, 10.0, 14.0);
    assert_eq!(order(&reservations), [3]);
    assert!(reservations.of(first, 7).is_none());
}

#[test]
fn room_is_kept_beyond_the_zone_until_the_vehicle_is_there() {
    let mut reservations = of_one_zone();
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    reservations.grant(NO_RESERVATION, 3, LENGTH, &over_the_zone(0));
    assert_eq!(reservations.kept_on(SECTION), 13.0);
    reservations.advance(slot, 19.5, 10.0, 14.0);
    assert_eq!(reservations.kept_on(SECTION), 6.5);
}

#[test]
fn who_goes_in_a_wait_cycle_lacks_space_until_it_is_granted_more() {
    let mut reservations = of_one_zone();
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    let lacks_space = |it: &Reservations| it.of(slot, 7).map(|it| it.lacks_space);
    assert_eq!(lacks_space(&reservations), Some(false));
    reservations.goes_in_wait_cycle(slot);
    reservations.advance(slot, 9.0, 3.0, 14.0);
    assert_eq!(lacks_space(&reservations), Some(true));
    reservations.grant(slot, 7, LENGTH, &over_the_zone(0));
    assert_eq!(lacks_space(&reservations), Some(false));
}

#[test]
fn a_reservation_can_be_given_back_from_a_place_on() {
    let mut reservations = of_one_zone();
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    reservations.advance(slot, 2.0, 10.0, 14.0);
    assert_eq!(reservations.of(slot, 7).map(Reservation::left), Some(17.5));
    // Revoked beyond the place where it enters the zone, it keeps the zone and loses the storage space.
    reservations.revoke(slot, 12.0);
    assert_eq!(order(&reservations), [7]);
    assert_eq!(reservations.of(slot, 7).map(Reservation::left), Some(10.0));
    assert_eq!(reservations.kept_on(SECTION), 0.0);
    reservations.revoke(slot, 8.0);
    assert!(order(&reservations).is_empty() && reservations.of(slot, 7).is_none());
}

#[test]
fn what_a_light_can_take_back_is_not_certain() {
    let mut reservations = of_one_zone();
    let left = |it: &Reservations, slot| it.of(slot, 7).map(|it| it.left_for_certain(0.0));
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    assert_eq!(left(&reservations, slot), Some(8.0));
    // Who stops before the same line does not mind.
    assert_eq!(reservations.of(slot, 7).map(|it| it.left_for_certain(8.0)), Some(19.5));
    reservations.advance(slot, 8.0, 10.0, 14.0);
    assert_eq!(left(&reservations, slot), Some(11.5));
    reservations.end(slot, 7);
    // Before a line within the zone a vehicle stops where the zone begins. Within the zone it no longer stops.
    let within = Survey { lights: vec![(LightIndex(0), 12.0)], ..over_the_zone(0) };
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &within);
    assert_eq!(left(&reservations, slot), Some(10.0));
    reservations.advance(slot, 10.0, 10.0, 14.0);
    assert_eq!(left(&reservations, slot), Some(9.5));
    reservations.end(slot, 7);
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &within);
    reservations.goes_in_wait_cycle(slot);
    assert_eq!(left(&reservations, slot), Some(19.5));
}

#[test]
fn the_reservation_of_who_leaves_the_road_ends_and_its_slot_is_used_again() {
    let mut reservations = of_one_zone();
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    // Another vehicle does not end it.
    reservations.end(slot, 8);
    assert_eq!(order(&reservations), [7]);
    reservations.end(slot, 7);
    assert!(order(&reservations).is_empty());
    assert_eq!(reservations.kept_on(SECTION), 0.0);
    assert_eq!(reservations.grant(slot, 9, LENGTH, &over_the_zone(1)), slot);
    assert!(reservations.of(slot, 7).is_none() && reservations.of(slot, 9).is_some());
}

#[test]
fn room_comes_first_to_who_has_waited_for_it_longest() {
    let priority = |since, id| WaitingPriority { is_patient: false, since, id, is_long: false };
    let mut reservations = Reservations { requested: vec![None], ..of_one_zone() };
    reservations.note_space_request(SECTION, priority(20, 1), 6.5);
    reservations.note_space_request(SECTION, priority(10, 2), 14.0);
    reservations.note_space_request(SECTION, priority(30, 3), 6.5);
    assert_eq!(reservations.requested_before(SECTION, priority(20, 1)), 14.0);
    assert_eq!(reservations.requested_before(SECTION, priority(10, 2)), 0.0);
    reservations.clear_priorities();
    assert_eq!(reservations.requested_before(SECTION, priority(20, 1)), 0.0);
}

#[test]
fn a_further_reservation_goes_on_from_where_the_vehicle_is() {
    let mut reservations = of_one_zone();
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &over_the_zone(0));
    reservations.advance(slot, 9.0, 10.0, 14.0);
    assert_eq!(reservations.grant(slot, 7, LENGTH, &over_the_zone(1)), slot);
    let reservation = reservations.of(slot, 7).expect("it was given");
    assert_eq!(reservation.left(), 19.5);
    assert_eq!(reservation.holds.iter().map(|it| it.enter).collect::<Vec<_>>(), [10.0, 19.0]);
    // The vehicle has passed the light of the first grant.
    assert_eq!(reservation.lights().collect::<Vec<_>>(), [(LightIndex(0), 8.0)]);
}

#[test]
fn of_those_who_wait_on_one_side_the_impatient_then_the_longest_waiting_claims_the_turn() {
    let priority = |is_patient, since, id| WaitingPriority { is_patient, since, id, is_long: false };
    let turn = |priority| WaitingTurn { priority, begins: 2.0, enters: false, is_within: false };
    let mut reservations = of_one_zone();
    for it in [priority(true, 20, 1), priority(true, 10, 3), priority(true, 10, 2), priority(true, 30, 0)] {
        reservations.note_priority(ZONE, 0, turn(it));
    }
    assert_eq!(reservations.priority(ZONE, 0), Some(turn(priority(true, 10, 2))));
    assert_eq!(reservations.priority(ZONE, 1), None);
    reservations.note_priority(ZONE, 0, turn(priority(false, 40, 9)));
    assert_eq!(reservations.priority(ZONE, 0), Some(turn(priority(false, 40, 9))));
    reservations.clear_priorities();
    assert_eq!(reservations.priority(ZONE, 0), None);
}

#[test]
fn a_new_reservation_has_no_lights_of_an_earlier_one() {
    let mut reservations = of_one_zone();
    let far_light = Survey { lights: vec![(LightIndex(0), 30.0)], ..over_the_zone(0) };
    let slot = reservations.grant(NO_RESERVATION, 7, LENGTH, &far_light);
    reservations.advance(slot, 19.5, 10.0, 14.0);
    let second = reservations.grant(NO_RESERVATION, 3, LENGTH, &over_the_zone(0));
    assert_eq!(second, slot);
    let lights: Vec<f64> = reservations.of(slot, 3).unwrap().lights().map(|it| it.1).collect();
    assert_eq!(lights, [8.0]);
}
