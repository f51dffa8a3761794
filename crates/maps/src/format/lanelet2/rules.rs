//! Traffic rules: who may use a lanelet, and which borders may be crossed.
//!
//! After the tagging guide of Lanelet2 (`LaneletAndAreaTagging`, `LinestringTagging`).

use laneweave_network::{Class, Classes};

use super::osm::Tags;
use crate::contents::MarkingPaint;
use crate::drawing::{Crossing, Paint, Surroundings};

/// A problem, and its remedy.
pub(super) type Flaw = (String, &'static str);

/// The beginning of the tags that allow, or forbid, a lanelet for somebody.
const PARTICIPANT: &str = "participant:";

/// The tags that say whether cars may use a lanelet in one direction only; the first one given decides.
pub(super) const ONE_WAY: [&str; 3] = ["one_way:vehicle:car", "one_way:vehicle", "one_way"];

/// Subtypes of lanelets: those of the tagging guide, and Autoware's `road_shoulder` and `pedestrian_lane`.
const SUBTYPES: [&str; 14] = [
    "road",
    "highway",
    "play_street",
    "exit",
    "bicycle_lane",
    "bus_lane",
    "crosswalk",
    "emergency_lane",
    "rail",
    "shared_walkway",
    "stairs",
    "walkway",
    "pedestrian_lane",
    "road_shoulder",
];

/// Subtypes of painted lines.
const LINES: [&str; 6] = ["solid", "solid_solid", "dashed", "dashed_solid", "solid_dashed", "dashed_dashed"];

/// The classes of vehicles that may use a lanelet with these tags.
///
/// Tags `participant:…` with yes name everyone who may. Those with no forbid it to some of those for whom the subtype
/// is, where nobody is named (ours: the reference library then allows nobody). A tag for a class comes before
/// `participant:vehicle`.
///
/// A hard shoulder (`emergency_lane`) is no lane to drive on, unless its tags name somebody.
pub(super) fn classes(lanelet: Tags) -> Classes {
    let keys = lanelet.all().filter(|(key, _)| key.starts_with(PARTICIPANT));
    let names_somebody = keys.map(|(key, _)| key).any(|it| flag(lanelet, it) == Some(true));
    let usual =
        if names_somebody { Classes::NONE } else { classes_of(lanelet.get("subtype").unwrap_or("road")) };
    let may_use = |class: &Class| {
        let mut flags = keys_of(*class).into_iter().filter_map(|key| flag(lanelet, &key));
        flags.next().unwrap_or(usual.has(*class))
    };
    Classes::ALL.iter().filter(may_use).collect()
}

/// Whether Lanelet2 has this subtype of lanelets.
pub(super) fn is_subtype(subtype: &str) -> bool {
    SUBTYPES.contains(&subtype)
}

/// Whether vehicles drive on lanelets of this subtype, if nothing else is said.
pub(super) fn is_road(subtype: &str) -> bool {
    !classes_of(subtype).is_empty()
}

/// Whether a tag `participant:…` names those for whom classes of vehicles stand.
pub(super) fn is_known_participant(key: &str) -> bool {
    Class::ALL.into_iter().any(|class| keys_of(class).iter().any(|it| it == key))
}

/// The classes for whom a lanelet of this subtype is.
fn classes_of(subtype: &str) -> Classes {
    match subtype {
        "road" | "highway" | "play_street" | "exit" => Classes::ALL,
        "bus_lane" => Classes::BUS_LANE,
        _ => Classes::NONE,
    }
}

/// The tags that allow, or forbid, a lanelet for a class; the first one given decides. Maps also have the second form,
/// which the tagging guide does not.
fn keys_of(class: Class) -> [String; 3] {
    let name = class.body().name;
    [format!("{PARTICIPANT}vehicle:{name}"), format!("{PARTICIPANT}{name}"), format!("{PARTICIPANT}vehicle")]
}

/// The tags from which [`classes`] returns these again.
pub(super) fn participants(classes: Classes) -> Vec<String> {
    if classes == Classes::ALL {
        return vec![format!("{PARTICIPANT}vehicle")];
    }
    classes.iter().map(|it| keys_of(it).into_iter().next().unwrap_or_default()).collect()
}

/// Whether cars may use a lanelet with these tags against its direction, too.
pub(super) fn is_two_way(lanelet: Tags) -> bool {
    ONE_WAY.into_iter().find_map(|key| flag(lanelet, key)).is_some_and(|one_way| !one_way)
}

/// The surroundings of a lanelet with these tags. Without a location it is a town.
pub(super) fn surroundings(lanelet: Tags) -> Surroundings {
    match (lanelet.get("subtype"), lanelet.get("location")) {
        (Some("highway"), _) => Surroundings::Motorway,
        (_, Some("nonurban")) => Surroundings::Country,
        _ => Surroundings::Town,
    }
}

/// The tags `subtype` and `location` from which [`surroundings`] returns these again.
pub(super) fn subtype_and_location(surroundings: Surroundings) -> (&'static str, &'static str) {
    match surroundings {
        Surroundings::Motorway => ("highway", "nonurban"),
        Surroundings::Town => ("road", "urban"),
        Surroundings::Country => ("road", "nonurban"),
    }
}

/// The visible form of a border with these tags.
pub(super) fn paint(border: Tags) -> Paint {
    if border.is("type", "virtual") { Paint::Virtual } else { Paint::Painted }
}

/// What a way with these tags looks like: none, if it is virtual or no line at all.
pub(super) fn marking(way: Tags) -> Option<(MarkingPaint, bool)> {
    let paint = match way.get("type")? {
        "line_thin" | "line_thick" => match way.get("subtype") {
            Some("dashed") => MarkingPaint::Dashed,
            Some("dashed_solid") => MarkingPaint::DashedSolid,
            Some("solid_dashed") => MarkingPaint::SolidDashed,
            Some("solid_solid") => MarkingPaint::SolidSolid,
            Some("dashed_dashed") => MarkingPaint::DashedDashed,
            _ => MarkingPaint::Solid,
        },
        "curbstone" => MarkingPaint::Curb,
        "guard_rail" | "wall" | "fence" | "jersey_barrier" => MarkingPaint::Barrier,
        "road_border" => MarkingPaint::Edge,
        _ => return None,
    };
    Some((paint, way.is("type", "line_thick")))
}

/// The directions in which a border with these tags may be crossed, seen along its points.
///
/// `lane_change` comes first. Then come `lane_change:left` and `lane_change:right`; a missing one of the two means
/// no. Then the marking decides. The first word of `dashed_solid` is the left half of the line: it may be crossed
/// from the left.
pub(super) fn crossing(border: Tags) -> Crossing {
    if border.get("lane_change").is_some() {
        let allowed = flag(border, "lane_change") == Some(true);
        return Crossing { to_left: allowed, to_right: allowed };
    }
    if border.any("lane_change:") {
        return Crossing {
            to_left: flag(border, "lane_change:left") == Some(true),
            to_right: flag(border, "lane_change:right") == Some(true),
        };
    }
    if !matches!(border.get("type"), Some("line_thin" | "line_thick")) {
        return Crossing::NEVER;
    }
    match border.get("subtype") {
        Some("dashed") => Crossing::BOTH_WAYS,
        Some("dashed_solid") => Crossing { to_left: false, to_right: true },
        Some("solid_dashed") => Crossing { to_left: true, to_right: false },
        _ => Crossing::NEVER,
    }
}

/// The subtype, for the type `line_thin`, from which [`crossing`] returns this again.
pub(super) fn line_subtype(crossing: Crossing) -> &'static str {
    match (crossing.to_left, crossing.to_right) {
        (true, true) => "dashed",
        (true, false) => "solid_dashed",
        (false, true) => "dashed_solid",
        (false, false) => "solid",
    }
}

/// The tags of a lanelet that cannot be understood, and what is assumed.
pub(super) fn flaws_of_lanelet(lanelet: Tags) -> Vec<Flaw> {
    let mut flaws = Vec::new();
    let mut keys: Vec<String> = Class::ALL.into_iter().flat_map(keys_of).collect();
    keys.sort_unstable();
    keys.dedup();
    for key in keys.iter().map(String::as_str).chain(ONE_WAY) {
        if let Some(value) = lanelet.get(key).filter(|_| flag(lanelet, key).is_none()) {
            flaws.push((format!("its tag {key} is {value:?}, so it is ignored"), "write yes or no"));
        }
    }
    flaws
}

/// The tags of a border that cannot be understood, and what is assumed.
pub(super) fn flaws_of_border(border: Tags) -> Vec<Flaw> {
    let mut flaws = Vec::new();
    for key in ["lane_change", "lane_change:left", "lane_change:right"] {
        if let Some(value) = border.get(key).filter(|_| flag(border, key).is_none()) {
            flaws.push((
                format!("its tag {key} is {value:?}, so lane changes are not allowed there"),
                "write yes or no",
            ));
        }
    }
    let is_line = matches!(border.get("type"), Some("line_thin" | "line_thick"));
    let decided = border.get("lane_change").is_some() || border.any("lane_change:");
    if let Some(subtype) = border.get("subtype").filter(|it| is_line && !decided && !LINES.contains(it)) {
        let what = format!("its subtype {subtype:?} is unknown, so lane changes across it are not allowed");
        flaws.push((what, "write dashed, solid, dashed_solid or solid_dashed"));
    }
    flaws
}

/// Yes or no, if the tag is given and is one of them.
fn flag(tags: Tags, key: &str) -> Option<bool> {
    match tags.get(key)? {
        "yes" | "true" | "1" => Some(true),
        "no" | "false" | "0" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::lanelet2::osm::{Document, with_tags};

    #[test]
    fn the_subtype_tells_who_may_use_a_lanelet() {
        for subtype in ["road", "highway", "play_street", "exit"] {
            assert_eq!(with_tags([("subtype", subtype)], classes), Classes::ALL, "{subtype}");
        }
        for subtype in ["walkway", "crosswalk", "bicycle_lane", "emergency_lane", "stairs", "x"] {
            assert_eq!(with_tags([("subtype", subtype)], classes), Classes::NONE, "{subtype}");
        }
        assert_eq!(with_tags([("subtype", "bus_lane")], classes).names(), "bus, taxi, emergency");
        assert_eq!(with_tags([], classes), Classes::ALL);
    }

    #[test]
    fn named_participants_outrank_the_subtype() {
        let names = |tags| with_tags(tags, |it| classes(it).names());
        assert_eq!(
            names([("subtype", "walkway"), ("participant:vehicle", "yes")]),
            "car, truck, bus, motorcycle, taxi, emergency"
        );
        assert_eq!(names([("subtype", "bus_lane"), ("participant:vehicle:car", "yes")]), "car");
        assert_eq!(names([("subtype", "road"), ("participant:bicycle", "yes")]), "");
        assert_eq!(names([("subtype", "road"), ("participant:vehicle", "no")]), "");
        assert_eq!(names([("subtype", "road"), ("participant:taxi", "yes")]), "taxi");
    }

    #[test]
    fn who_is_forbidden_a_lanelet_is_not_among_those_who_may() {
        let names = |tags| with_tags(tags, |it| classes(it).names());
        let all_but_trucks = "car, bus, motorcycle, taxi, emergency";
        assert_eq!(names([("subtype", "road"), ("participant:vehicle:truck", "no")]), all_but_trucks);
        assert_eq!(
            names([("participant:vehicle", "yes"), ("participant:vehicle:truck", "no")]),
            all_but_trucks
        );
        assert_eq!(names([("participant:vehicle", "no"), ("participant:vehicle:bus", "yes")]), "bus");
        assert_eq!(names([("subtype", "bus_lane"), ("participant:vehicle:taxi", "no")]), "bus, emergency");
    }

    #[test]
    fn all_sets_of_classes_have_tags_to_write() {
        let wanted = [Classes::ALL, Classes::BUS_LANE, Classes::from_iter([Class::Car, Class::Motorcycle])];
        for set in wanted {
            let mut document = Document::default();
            let tags = participants(set);
            let tags: Vec<(&str, &dyn std::fmt::Display)> =
                tags.iter().map(|it| (it.as_str(), &"yes" as &dyn std::fmt::Display)).collect();
            let span = document.keep_tags(&tags);
            assert_eq!(classes(document.tags(span)), set);
        }
    }

    #[test]
    fn lanelets_run_one_way_unless_they_say_otherwise() {
        assert!(!with_tags([], is_two_way));
        assert!(!with_tags([("one_way:bicycle", "no")], is_two_way));
        assert!(with_tags([("one_way", "no")], is_two_way));
        assert!(with_tags([("one_way:vehicle", "no")], is_two_way));
    }

    #[test]
    fn a_way_looks_as_its_type_and_subtype_say() {
        let look = |kind, subtype| with_tags([("type", kind), ("subtype", subtype)], marking);
        assert_eq!(look("line_thin", "dashed"), Some((MarkingPaint::Dashed, false)));
        assert_eq!(look("line_thick", "solid_dashed"), Some((MarkingPaint::SolidDashed, true)));
        assert_eq!(look("line_thin", "unknown"), Some((MarkingPaint::Solid, false)));
        assert_eq!(look("curbstone", "high"), Some((MarkingPaint::Curb, false)));
        assert_eq!(look("guard_rail", ""), Some((MarkingPaint::Barrier, false)));
        assert_eq!([look("virtual", ""), look("stop_line", "")], [None; 2]);
    }

    #[test]
    fn the_painted_line_tells_who_may_cross() {
        let line = |kind, subtype| {
            let crossing = with_tags([("type", kind), ("subtype", subtype)], crossing);
            (crossing.to_left, crossing.to_right)
        };
        for kind in ["line_thin", "line_thick"] {
            assert_eq!(line(kind, "dashed"), (true, true));
            assert_eq!(line(kind, "solid"), (false, false));
            assert_eq!(line(kind, "dashed_solid"), (false, true));
            assert_eq!(line(kind, "solid_dashed"), (true, false));
        }
        assert_eq!(line("virtual", "dashed"), (false, false));
        assert_eq!(line("curbstone", "low"), (false, false));
    }

    #[test]
    fn lane_change_tags_outrank_the_line() {
        let over = |key, value| {
            let crossing = with_tags([("type", "line_thin"), ("subtype", "dashed"), (key, value)], crossing);
            (crossing.to_left, crossing.to_right)
        };
        assert_eq!(over("lane_change", "yes"), (true, true));
        assert_eq!(over("lane_change", "no"), (false, false));
        assert_eq!(over("lane_change", "perhaps"), (false, false));
        assert_eq!(over("lane_change:left", "yes"), (true, false));
        assert_eq!(over("lane_change:right", "yes"), (false, true));
        assert_eq!(over("lane_change:right", "no"), (false, false));
    }

    #[test]
    fn slips_of_the_pen_are_flaws() {
        let lanelet = |key, value| with_tags([(key, value)], |it| flaws_of_lanelet(it).len());
        assert_eq!([lanelet("participant:vehicle", "yse"), lanelet("participant:bicycle", "yes")], [1, 0]);
        assert_eq!([lanelet("one_way", "nope"), lanelet("one_way", "no")], [1, 0]);
        let border =
            |key, value| with_tags([("type", "line_thin"), (key, value)], |it| flaws_of_border(it).len());
        assert_eq!([border("subtype", "dahsed"), border("subtype", "dashed")], [1, 0]);
        assert_eq!([border("lane_change", "maybe"), border("lane_change:left", "yes")], [1, 0]);
    }

    #[test]
    fn all_surroundings_have_tags_to_write() {
        for wanted in [Surroundings::Motorway, Surroundings::Town, Surroundings::Country] {
            let (subtype, location) = subtype_and_location(wanted);
            assert_eq!(with_tags([("subtype", subtype), ("location", location)], surroundings), wanted);
        }
        assert_eq!(with_tags([], surroundings), Surroundings::Town);
    }

    #[test]
    fn every_crossing_has_a_line_to_write() {
        for to_left in [false, true] {
            for to_right in [false, true] {
                let wanted = Crossing { to_left, to_right };
                let tags = [("type", "line_thin"), ("subtype", line_subtype(wanted))];
                assert_eq!(with_tags(tags, crossing), wanted);
            }
        }
    }
}
