//! Traffic rules for cars: which lanelets they may use, and which bounds they may cross.
//!
//! After the documentation of CommonRoad's XML format, version 2020a.

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

/// Types of lanelets that are not for cars.
const OTHERS: [&str; 10] = [
    "shoulder",
    "busLane",
    "busStop",
    "bicycleLane",
    "sidewalk",
    "crosswalk",
    "border",
    "parking",
    "restricted",
    "restricted_area",
];

/// Users that include cars.
const CAR_USERS: [&str; 2] = ["vehicle", "car"];

/// Whether the format has this type of lanelets.
pub(super) fn is_type(text: &str) -> bool {
    ROADS.contains(&text) || OTHERS.contains(&text)
}

/// Whether cars may use a lanelet.
///
/// Its users name everyone who may; without users, all of its types must be roads. A lanelet without types is a road.
pub(super) fn is_for_cars(lanelet: &LaneletElement) -> bool {
    if lanelet.users.is_empty() && lanelet.users_both_ways.is_empty() {
        return lanelet.types.iter().all(|it| ROADS.contains(&it.as_str()));
    }
    lanelet.users.iter().any(|it| CAR_USERS.contains(&it.as_str())) || is_two_way(lanelet)
}

/// Whether cars may use a lanelet against its direction, too.
pub(super) fn is_two_way(lanelet: &LaneletElement) -> bool {
    lanelet.users_both_ways.iter().any(|it| CAR_USERS.contains(&it.as_str()))
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
        assert!(is_for_cars(&lanelet(&[], &[], &[])));
        for road in ROADS {
            assert!(is_type(road) && is_for_cars(&lanelet(&[road], &[], &[])), "{road}");
            for other in OTHERS {
                assert!(is_type(other) && !is_for_cars(&lanelet(&[road, other], &[], &[])), "{other}");
            }
        }
        assert!(!is_type("canal") && !is_for_cars(&lanelet(&["canal"], &[], &[])));
    }

    #[test]
    fn named_users_outrank_the_type() {
        assert!(is_for_cars(&lanelet(&["busLane"], &["bus", "car"], &[])));
        assert!(is_for_cars(&lanelet(&["busLane"], &[], &["vehicle"])));
        assert!(!is_for_cars(&lanelet(&["urban"], &["bicycle"], &[])));
        assert!(!is_for_cars(&lanelet(&["urban"], &[], &["pedestrian"])));
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
