use laneweave_network::ChainIndex;

use super::*;

const LENGTH: f64 = 4.5;
const ZONE: ZoneIndex = ZoneIndex(0);
const REFUGE: Refuge = Refuge::first_of(ChainIndex(0));

/// Passages of a network with one zone, and one chain beyond it.
fn of_one_zone() -> Passages {
    Passages {
        queues: vec![Vec::new()],
        claims: vec![[None; 2]],
        numbers: Numbers::of_chains(1),
        kept: vec![0],
        ..Passages::default()
    }
}

/// Over the zone from 10 m to 15 m ahead, with a light at 8 m, to a place beyond it.
fn over_the_zone(side: u8) -> Survey {
    Survey {
        lights: vec![(LightIndex(0), 8.0)],
        holds: vec![Hold { zone: ZONE, side, enter: 10.0, leave: 15.0 + LENGTH }],
        extent: 15.0 + LENGTH,
        needed: LENGTH + 2.0,
        ..Survey::default()
    }
}

fn order(passages: &Passages) -> Vec<VehicleId> {
    passages.order(ZONE).map(|(_, passage)| passage.vehicle).collect()
}

#[test]
fn who_was_given_a_passage_first_goes_first_until_its_rear_has_left_the_zone() {
    let mut passages = of_one_zone();
    let first = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
    passages.give(NO_PASSAGE, 3, LENGTH, &over_the_zone(1));
    assert_eq!(order(&passages), [7, 3]);
    passages.advance(first, 19.4, 10.0, 14.0);
    assert_eq!(order(&passages), [7, 3]);
    passages.advance(first, 0.1, 10.0, 14.0);
    assert_eq!(order(&passages), [3]);
    assert!(passages.of(first, 7).is_none());
}

#[test]
fn room_is_kept_beyond_the_zone_until_the_vehicle_is_there() {
    let mut passages = of_one_zone();
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
    passages.give(NO_PASSAGE, 3, LENGTH, &over_the_zone(0));
    assert_eq!(passages.kept_on(REFUGE), 13.0);
    passages.advance(slot, 19.5, 10.0, 14.0);
    assert_eq!(passages.kept_on(REFUGE), 6.5);
}

#[test]
fn a_passage_can_be_given_back_from_a_place_on() {
    let mut passages = of_one_zone();
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
    passages.advance(slot, 2.0, 10.0, 14.0);
    assert_eq!(passages.of(slot, 7).map(Passage::left), Some(17.5));
    // Beyond where it enters the zone it keeps the zone, and gives back the room.
    passages.take_back(slot, 12.0);
    assert_eq!(order(&passages), [7]);
    assert_eq!(passages.of(slot, 7).map(Passage::left), Some(10.0));
    assert_eq!(passages.kept_on(REFUGE), 0.0);
    passages.take_back(slot, 8.0);
    assert!(order(&passages).is_empty() && passages.of(slot, 7).is_none());
}

#[test]
fn what_a_light_can_take_back_is_not_certain() {
    let mut passages = of_one_zone();
    let left = |it: &Passages, slot| it.of(slot, 7).map(Passage::left_for_certain);
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
    assert_eq!(left(&passages, slot), Some(8.0));
    passages.advance(slot, 8.0, 10.0, 14.0);
    assert_eq!(left(&passages, slot), Some(11.5));
    passages.end(slot, 7);
    // Before a line within the zone one stops where the zone begins, and within it no more.
    let within = Survey { lights: vec![(LightIndex(0), 12.0)], ..over_the_zone(0) };
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &within);
    assert_eq!(left(&passages, slot), Some(10.0));
    passages.advance(slot, 10.0, 10.0, 14.0);
    assert_eq!(left(&passages, slot), Some(9.5));
    passages.end(slot, 7);
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &within);
    passages.make_certain(slot);
    assert_eq!(left(&passages, slot), Some(19.5));
}

#[test]
fn the_passage_of_who_leaves_the_road_ends_and_its_slot_is_used_again() {
    let mut passages = of_one_zone();
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
    // Not of somebody else.
    passages.end(slot, 8);
    assert_eq!(order(&passages), [7]);
    passages.end(slot, 7);
    assert!(order(&passages).is_empty());
    assert_eq!(passages.kept_on(REFUGE), 0.0);
    assert_eq!(passages.give(slot, 9, LENGTH, &over_the_zone(1)), slot);
    assert!(passages.of(slot, 7).is_none() && passages.of(slot, 9).is_some());
}

#[test]
fn room_comes_first_to_who_has_waited_for_it_longest() {
    let claim = |since, id| Claim { is_patient: false, since, id, is_long: false };
    let mut passages = Passages { wanted: vec![None], ..of_one_zone() };
    passages.note_want(REFUGE, claim(20, 1), 6.5);
    passages.note_want(REFUGE, claim(10, 2), 14.0);
    passages.note_want(REFUGE, claim(30, 3), 6.5);
    assert_eq!(passages.wanted_before(REFUGE, claim(20, 1)), 14.0);
    assert_eq!(passages.wanted_before(REFUGE, claim(10, 2)), 0.0);
    passages.clear_claims();
    assert_eq!(passages.wanted_before(REFUGE, claim(20, 1)), 0.0);
}

#[test]
fn a_further_passage_goes_on_from_where_the_vehicle_is() {
    let mut passages = of_one_zone();
    let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
    passages.advance(slot, 9.0, 10.0, 14.0);
    assert_eq!(passages.give(slot, 7, LENGTH, &over_the_zone(1)), slot);
    let passage = passages.of(slot, 7).expect("it was given");
    assert_eq!(passage.left(), 19.5);
    assert_eq!(passage.holds.iter().map(|it| it.enter).collect::<Vec<_>>(), [10.0, 19.0]);
    // The light of the first is passed.
    assert_eq!(passage.lights().collect::<Vec<_>>(), [(LightIndex(0), 8.0)]);
}

#[test]
fn of_those_who_wait_on_one_side_the_impatient_then_the_longest_waiting_claims_the_turn() {
    let claim = |is_patient, since, id| Claim { is_patient, since, id, is_long: false };
    let turn = |claim| Turn { claim, begins: 2.0 };
    let mut passages = of_one_zone();
    for it in [claim(true, 20, 1), claim(true, 10, 3), claim(true, 10, 2), claim(true, 30, 0)] {
        passages.note_claim(ZONE, 0, turn(it));
    }
    assert_eq!(passages.claim(ZONE, 0), Some(turn(claim(true, 10, 2))));
    assert_eq!(passages.claim(ZONE, 1), None);
    passages.note_claim(ZONE, 0, turn(claim(false, 40, 9)));
    assert_eq!(passages.claim(ZONE, 0), Some(turn(claim(false, 40, 9))));
    passages.clear_claims();
    assert_eq!(passages.claim(ZONE, 0), None);
}
