//! Traffic rules: who may use a lanelet, and which bounds may be crossed.
//!
//! After the documentation of CommonRoad's XML format, version 2020a.

use laneweave_network::{Class, Classes};

use super::element::LaneletElement;
use crate::drawing::{Crossing, Surroundings};

/// Types of lanelets on which cars drive.
const ROADS: [&str; 10] = [
    "urban",
    "country",
    "highway",
    "interstate",
    "driveWay",
    "mainCarriageWay",
    "accessRamp",
    "exitRamp",
    "intersection",
    "unknown",
];

/// The type of lanelets for buses.
const BUS_LANE: &str = "busLane";

/// Types of lanelets on which nobody drives.
const OTHERS: [&str; 9] = [
    "shoulder",
    "busStop",
    "bicycleLane",
    "sidewalk",
    "crosswalk",
    "border",
    "parking",
    "restricted",
    "restricted_area",
];

/// Whether the format has this type of lanelets.
pub(super) fn is_type(text: &str) -> bool {
    text == BUS_LANE || ROADS.contains(&text) || OTHERS.contains(&text)
}

/// The classes of vehicles that may use a lanelet.
///
/// Its users name everyone who may; without users, its types decide: all of them must be roads, or lanes for buses. A
/// lanelet without types is a road.
pub(super) fn classes(lanelet: &LaneletElement) -> Classes {
    if lanelet.users.is_empty() && lanelet.users_both_ways.is_empty() {
        let is_driven_on = |it: &String| it == BUS_LANE || ROADS.contains(&it.as_str());
        return match () {
            () if !lanelet.types.iter().all(is_driven_on) => Classes::NONE,
            () if lanelet.types.iter().any(|it| it == BUS_LANE) => Classes::BUS_LANE,
            () => Classes::ALL,
        };
    }
    named(&lanelet.users).and(named(&lanelet.users_both_ways))
}

/// The classes of vehicles among these users.
fn named(users: &[String]) -> Classes {
    users.iter().map(|it| classes_of_user(it)).fold(Classes::NONE, Classes::and)
}

/// The classes of vehicles that a user of this name has.
fn classes_of_user(user: &str) -> Classes {
    match user {
        "vehicle" => Classes::ALL,
        "priorityVehicle" => Classes::from_iter([Class::Emergency]),
        _ => Classes::ALL.iter().filter(|it| it.body().name == user).collect(),
    }
}

/// Whether vehicles may use a lanelet against its direction, too.
pub(super) fn is_two_way(lanelet: &LaneletElement) -> bool {
    !named(&lanelet.users_both_ways).is_empty()
}

/// The surroundings of a lanelet, by its types. For a lanelet without types, or with only `urban`, those of the
/// scenario count: version 2020a requires a type, and files made from older ones say `urban` even on a motorway.
pub(super) fn surroundings(lanelet: &LaneletElement, of_scenario: Surroundings) -> Surroundings {
    let says_little = lanelet.types.iter().all(|it| it == "urban");
    if says_little { of_scenario } else { surroundings_of(&lanelet.types) }
}

/// The surroundings that these types of lanelets, or tags of a scenario, stand for; where nothing is known, a town.
pub(super) fn surroundings_of(kinds: &[String]) -> Surroundings {
    let any = |known: &[&str]| kinds.iter().any(|it| known.contains(&it.as_str()));
    match () {
        () if any(&["urban"]) => Surroundings::Town,
        () if any(&["highway", "interstate", "mainCarriageWay", "accessRamp", "exitRamp"]) => {
            Surroundings::Motorway
        }
        () if any(&["country", "rural"]) => Surroundings::Country,
        () => Surroundings::Town,
    }
}

/// The directions in which a line may be crossed, seen along the bound's points. For an `unknown` line nothing is
/// known; an error says that the format has no such marking.
///
/// The first word of `dashed_solid` is the left half of the line: it may be crossed from the left.
pub(super) fn crossing(marking: &str) -> Result<Option<Crossing>, ()> {
    match marking {
        "dashed" | "broad_dashed" | "dashed_dashed" | "no_marking" => Ok(Some(Crossing::BOTH_WAYS)),
        "dashed_solid" => Ok(Some(Crossing { to_left: false, to_right: true })),
        "solid_dashed" => Ok(Some(Crossing { to_left: true, to_right: false })),
        "solid" | "broad_solid" | "solid_solid" | "curb" | "lowered_curb" => Ok(Some(Crossing::NEVER)),
        "unknown" => Ok(None),
        _ => Err(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lanelet(types: &[&str], users: &[&str], users_both_ways: &[&str]) -> LaneletElement {
        let [types, users, users_both_ways] =
            [types, users, users_both_ways].map(|it| it.iter().map(|it| it.to_string()).collect());
        LaneletElement { types, users, users_both_ways, ..LaneletElement::default() }
    }

    #[test]
    fn all_types_must_be_roads() {
        let of_types = |types: &[&str]| classes(&lanelet(types, &[], &[]));
        assert_eq!(of_types(&[]), Classes::ALL);
        for road in ROADS {
            assert!(is_type(road) && of_types(&[road]) == Classes::ALL, "{road}");
            for other in OTHERS {
                assert!(is_type(other) && of_types(&[road, other]).is_empty(), "{other}");
            }
        }
        assert!(!is_type("canal") && of_types(&["canal"]).is_empty());
        assert!(is_type("busLane"));
        assert_eq!(of_types(&["urban", "busLane"]).names(), "bus, taxi, emergency");
    }

    #[test]
    fn named_users_outrank_the_type() {
        let named = |kind, users, both_ways| classes(&lanelet(kind, users, both_ways)).names();
        assert_eq!(named(&["busLane"], &["bus", "car"], &[]), "car, bus");
        assert_eq!(classes(&lanelet(&["busLane"], &[], &["vehicle"])), Classes::ALL);
        assert_eq!(named(&["urban"], &["priorityVehicle", "bicycle"], &["taxi"]), "taxi, emergency");
        assert_eq!(named(&["urban"], &["bicycle"], &[]), "");
        assert_eq!(named(&["urban"], &[], &["pedestrian"]), "");
    }

    #[test]
    fn lanelets_run_one_way_unless_cars_may_use_both() {
        assert!(is_two_way(&lanelet(&[], &[], &["car"])));
        assert!(!is_two_way(&lanelet(&[], &["car"], &["bicycle"])));
    }

    #[test]
    fn the_painted_line_tells_who_may_cross() {
        let seen = |marking| crossing(marking).unwrap().map(|it| (it.to_left, it.to_right));
        for marking in ["dashed", "broad_dashed", "dashed_dashed", "no_marking"] {
            assert_eq!(seen(marking), Some((true, true)), "{marking}");
        }
        for marking in ["solid", "broad_solid", "solid_solid", "curb", "lowered_curb"] {
            assert_eq!(seen(marking), Some((false, false)), "{marking}");
        }
        assert_eq!(seen("dashed_solid"), Some((false, true)));
        assert_eq!(seen("solid_dashed"), Some((true, false)));
        assert_eq!(seen("unknown"), None);
        assert!(crossing("wavy").is_err());
    }
}
