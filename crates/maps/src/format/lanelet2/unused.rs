//! What a Lanelet2 map holds and traffic does not use.

use std::collections::HashSet;

use super::osm::{Document, Relation, Tags};
use super::rules::{self, classes, is_known_participant};
use crate::rule::{Rule, RuleKind};
use crate::unused::{Meaning, Unused};

/// Keys of OpenStreetMap whose elements say nothing to traffic here.
const OSM_KEYS: [&str; 10] = [
    "highway", "railway", "building", "landuse", "amenity", "natural", "waterway", "barrier", "power",
    "leisure",
];

/// Tags of lanelets that change who may drive there, or how, in OpenStreetMap or in other programs.
const OTHER_TAGS: [&str; 9] = [
    "oneway",
    "maxspeed",
    "access",
    "maxheight",
    "maxweight",
    "maxwidth",
    "minspeed",
    "hgv",
    "motor_vehicle",
];

/// Tags of lanelets that say that they lie above or below others.
const LEVELS: [&str; 4] = ["layer", "level", "bridge", "tunnel"];

/// Types of ways that show a rule.
const SHOWN: [&str; 3] = ["stop_line", "traffic_light", "traffic_sign"];

/// Roles of members that are read.
const ROLES_OF_LANELETS: [&str; 3] = ["left", "right", "regulatory_element"];
const ROLES_OF_RULES: [&str; 6] =
    ["refers", "ref_line", "right_of_way", "yield", "light_bulbs", "crosswalk_polygon"];

const NO_VEHICLES: Meaning = (
    "no vehicle may drive there, and there are no pedestrians, bicycles or trains",
    "add participant:vehicle=yes if vehicles drive there",
);
const UNKNOWN_SUBTYPE: Meaning = (
    "the subtype is unknown, so it is not used as a road",
    "write road, highway or another of Lanelet2's subtypes, or add participant:vehicle=yes",
);
const NOBODY: Meaning = (
    "their tags participant:… allow no class of vehicles, so nobody drives there",
    "add participant:vehicle=yes, or name a class: car, truck, bus, motorcycle, taxi, emergency",
);
const AREA: Meaning = ("traffic drives on lanelets only", "draw lanelets through it if vehicles drive there");
const UNTYPED: Meaning = ("its type is none of Lanelet2's", "give it the type lanelet or regulatory_element");
const STREETS: Meaning = (
    "they are of OpenStreetMap, and nothing is taken from them",
    "give lanelets and rules what they say, such as speed limits and lights",
);
const UNKNOWN_RULE: Meaning = (
    "traffic does not know this rule and drives without it",
    "use a rule that is known: traffic_light, right_of_way, all_way_stop, speed_limit, traffic_sign with a stop sign, road_marking \
     with a stop line",
);
const NO_PEDESTRIANS: Meaning =
    ("there are no pedestrians, so nobody stops for them", "expect traffic without pedestrians");
const UNUSED_LIMIT: Meaning = (
    "no lanelet refers to it, so it has no effect",
    "add it as regulatory_element to the lanelets of that limit",
);
const UNKNOWN_TAG: Meaning = (
    "this tag is not read",
    "use Lanelet2's tags: participant:vehicle:CLASS, one_way, speed_limit, with CLASS one of car, truck, bus, motorcycle, taxi, \
     emergency",
);
const LEVEL: Meaning = (
    "this tag is not read, so lanelets that cross there are taken to cross at one level",
    "give the nodes of bridges and tunnels their heights as ele",
);
const UNKNOWN_ROLE: Meaning =
    ("members in this role are not read", "leave them, or give them a role that is read");
const NO_RULE: Meaning = (
    "no regulatory element refers to it, so no driver obeys it",
    "add it to a regulatory element, and this to the lanelets whose drivers obey it",
);
const OWN_CENTRE: Meaning =
    ("the centre line is computed from the borders instead", "correct the borders if it lies elsewhere");

/// All that traffic does not use of the elements of `document` and of its `rules`.
pub(super) fn unused(document: &Document, rules: &[Rule]) -> Unused {
    let mut unused = Unused::default();
    for relation in &document.relations {
        let tags = document.tags(relation.tags);
        let kind = tags.get("type");
        let place = (name_of(kind), relation.id, relation.line as usize);
        match kind {
            Some("lanelet") if classes(tags).is_empty() => {
                let (kind, meaning) = closed(tags);
                unused.add(&kind, place, meaning);
            }
            Some("lanelet") => {
                let members = other_roles(document, relation, &ROLES_OF_LANELETS);
                members.for_each(|it| {
                    unused.add(
                        &format!("lanelets with a member in the role {it}"),
                        place,
                        meaning_of_role(it),
                    )
                });
                unread_tags(tags).for_each(|(it, meaning)| {
                    unused.add(&format!("lanelets with the tag {it}"), place, meaning);
                });
            }
            Some("regulatory_element") => {
                let members = other_roles(document, relation, &ROLES_OF_RULES);
                members.for_each(|it| {
                    unused.add(
                        &format!("regulatory elements with a member in the role {it}"),
                        place,
                        UNKNOWN_ROLE,
                    )
                });
            }
            Some(kind @ ("multipolygon" | "area")) => {
                unused.add(&format!("areas (relations of the type {kind})"), place, AREA);
            }
            kind => {
                unused.add(&format!("relations of the type {}", kind.unwrap_or("(none)")), place, UNTYPED)
            }
        }
    }
    let ways = document.ways.iter().map(|it| ("way", it.id, it.line, it.tags));
    for (kind, id, line, tags) in
        ways.chain(document.nodes.iter().map(|it| ("node", it.id, it.line, it.tags)))
    {
        let mut keys = document.tags(tags).all().map(|(key, _)| key);
        if let Some(key) = keys.find(|it| OSM_KEYS.contains(it)) {
            unused.add(&format!("{kind}s with the tag {key}"), (kind, id, line as usize), STREETS);
        }
    }
    add_ways_of_no_rule(&mut unused, document);
    rules.iter().for_each(|it| add_rule(&mut unused, it));
    unused
}

/// Adds the signs, lights and stop lines to which no rule refers.
fn add_ways_of_no_rule(unused: &mut Unused, document: &Document) {
    let rules = document
        .relations
        .iter()
        .filter(|it| document.tags(it.tags).get("type") == Some("regulatory_element"));
    let members = rules.flat_map(|it| document.members_of(it));
    let of_rules: HashSet<i64> =
        members.filter(|it| document.get(it.kind) == "way").map(|it| it.id).collect();
    for way in document.ways.iter().filter(|it| !of_rules.contains(&it.id)) {
        if let Some(kind) = document.tags(way.tags).get("type").filter(|it| SHOWN.contains(it)) {
            unused.add(&format!("ways of the type {kind}"), ("way", way.id, way.line as usize), NO_RULE);
        }
    }
}

/// What a relation of this type is called.
fn name_of(kind: Option<&str>) -> &'static str {
    match kind {
        Some("lanelet") => "lanelet",
        Some("regulatory_element") => "regulatory element",
        _ => "relation",
    }
}

/// The kind of a lanelet that no vehicle may use.
fn closed(lanelet: Tags) -> (String, Meaning) {
    let subtype = lanelet.get("subtype").unwrap_or("road");
    let meaning = match () {
        () if lanelet.any("participant:") && rules::is_road(subtype) => NOBODY,
        () if !lanelet.any("participant:") && !rules::is_subtype(subtype) => UNKNOWN_SUBTYPE,
        () => NO_VEHICLES,
    };
    (format!("lanelets of the subtype {subtype}"), meaning)
}

fn other_roles<'d>(
    document: &'d Document,
    relation: &Relation,
    known: &'static [&'static str],
) -> impl Iterator<Item = &'d str> + use<'d> {
    let roles = document.members_of(relation).iter().map(|it| document.get(it.role));
    let mut others: Vec<&str> = roles.filter(|it| !known.contains(it)).collect();
    others.sort_unstable();
    others.dedup();
    others.into_iter()
}

fn meaning_of_role(role: &str) -> Meaning {
    if role == "centerline" { OWN_CENTRE } else { UNKNOWN_ROLE }
}

/// The tags of a lanelet that would change its traffic, and are not read.
fn unread_tags<'d>(lanelet: Tags<'d>) -> impl Iterator<Item = (&'d str, Meaning)> {
    let is_slow = |key: &str| ["bicycle", "pedestrian"].iter().any(|it| key.contains(it));
    let is_unread = move |key: &str| match key {
        _ if is_slow(key) => false,
        _ if key.starts_with("participant:") => !is_known_participant(key),
        _ if key.starts_with("one_way") => !rules::ONE_WAY.contains(&key),
        _ if key.starts_with("speed_limit") => !super::speed::KEYS.contains(&key),
        _ => OTHER_TAGS.contains(&key),
    };
    lanelet.all().map(|(key, _)| key).filter_map(move |key| match key {
        _ if LEVELS.contains(&key) => Some((key, LEVEL)),
        _ if is_unread(key) => Some((key, UNKNOWN_TAG)),
        _ => None,
    })
}

fn add_rule(unused: &mut Unused, rule: &Rule) {
    let place = ("regulatory element", rule.id, rule.line.unwrap_or_default());
    match &rule.kind {
        RuleKind::Other(name) => {
            unused.add(&format!("regulatory elements of the subtype {name}"), place, UNKNOWN_RULE)
        }
        RuleKind::Crosswalk { .. } => {
            unused.add("regulatory elements of the subtype crosswalk", place, NO_PEDESTRIANS)
        }
        RuleKind::SpeedLimit if rule.lanelets.is_empty() => {
            unused.add("regulatory elements of the subtype speed_limit", place, UNUSED_LIMIT);
        }
        _ => {}
    }
}
