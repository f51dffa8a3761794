//! Speed limits of lanelets.

use super::osm::{Relation, Tags};
use crate::drawing::KMH_PER_MPS;
use crate::problem::Problem;

/// Kilometres an hour in a mile an hour.
const KMH_PER_MPH: f64 = 1.609_344;
/// Limits above are slips of the pen [km/h].
const MAXIMUM: f64 = 500.0;

/// The limit of a lanelet [km/h].
///
/// Its first rule of the subtype `speed_limit` that can be understood comes first, then its tags, then
/// [`german_default`]. `rule` finds a regulatory element by its id, `sign` the tags of a way.
pub(super) fn limit<'a>(
    lanelet: &'a Relation,
    rule: impl Fn(i64) -> Option<&'a Relation>,
    sign: impl Fn(i64) -> Option<&'a Tags>,
    problems: &mut Vec<Problem>,
) -> f64 {
    const KEYS: [&str; 3] = ["speed_limit:vehicle:car", "speed_limit:vehicle", "speed_limit"];
    let rules = lanelet
        .members("relation", "regulatory_element")
        .filter_map(rule)
        .filter(|it| it.tags.is("subtype", "speed_limit"));
    let by_rule = rules.map(|rule| (sign_text(rule, &sign), rule.line, "speed limit rule"));
    let by_tag = KEYS.into_iter().filter_map(|key| Some((lanelet.tags.get(key)?, lanelet.line, key)));
    let default = german_default(&lanelet.tags);
    for (text, line, source) in by_rule.chain(by_tag) {
        if let Some(limit) = sign_limit(text).or_else(|| speed(text)) {
            return limit;
        }
        problems.push(Problem {
            element: format!("lanelet {}", lanelet.id),
            line: Some(line),
            what: format!("its {source} {text:?} is no speed above 0 and up to {MAXIMUM} km/h"),
            remedy: format!("write it like 50, 50 km/h, 30 mph or 14 m/s; without one {default} km/h holds"),
        });
    }
    default
}

/// What a rule says: by a tag of its own, or by the sign to which it refers.
fn sign_text<'a>(rule: &'a Relation, sign: impl Fn(i64) -> Option<&'a Tags>) -> &'a str {
    let own = ["sign_type", "speed_limit", "max_speed"].into_iter().find_map(|key| rule.tags.get(key));
    let shown = || rule.members("way", "refers").filter_map(&sign).find_map(|tags| tags.get("subtype"));
    own.or_else(shown).unwrap_or_default()
}

/// The limit of a German sign: 274 with the speed behind a dash (a zone of 30 km/h without), 310 the town
/// sign.
fn sign_limit(text: &str) -> Option<f64> {
    match text.strip_prefix("de")? {
        "274" => Some(30.0),
        "310" => Some(50.0),
        sign => speed(sign.strip_prefix("274-")?),
    }
}

/// A speed with or without a unit [km/h].
fn speed(text: &str) -> Option<f64> {
    const UNITS: [(&str, f64); 6] = [
        ("km/h", 1.0),
        ("kmh", 1.0),
        ("mph", KMH_PER_MPH),
        ("m/s", KMH_PER_MPS),
        ("mps", KMH_PER_MPS),
        ("", 1.0),
    ];
    let text = text.trim().to_ascii_lowercase();
    let (number, factor) =
        UNITS.into_iter().find_map(|(unit, factor)| Some((text.strip_suffix(unit)?, factor)))?;
    let speed = number.trim().parse::<f64>().ok()? * factor;
    (speed > 0.0 && speed <= MAXIMUM).then_some(speed)
}

/// The limit in Germany where none is given [km/h]: 130 on a motorway (where it is only advised), 7 in a play
/// street, otherwise 100 outside of towns and 50 inside.
fn german_default(lanelet: &Tags) -> f64 {
    match (lanelet.get("subtype"), lanelet.get("location")) {
        (Some("highway"), _) => 130.0,
        (Some("play_street"), _) => 7.0,
        (_, Some("nonurban")) => 100.0,
        _ => 50.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanelet2::osm::Member;

    #[test]
    fn speeds_are_km_per_hour_unless_they_have_a_unit() {
        let equal = [("50", 50.0), ("50 km/h", 50.0), ("50kmh", 50.0), (" 7.5 ", 7.5), ("10 m/s", 36.0)];
        for (text, expected) in equal {
            assert_eq!(speed(text), Some(expected), "{text:?}");
        }
        assert_eq!(speed("30mph"), Some(30.0 * 1.609344));
        for text in ["", "km/h", "0", "-5", "nan", "inf", "5 kn", "none", "501", "1e300"] {
            assert_eq!(speed(text), None, "{text:?}");
        }
    }

    #[test]
    fn german_defaults_hold_without_a_tag() {
        let limit =
            |subtype, location| german_default(&Tags::from([("subtype", subtype), ("location", location)]));
        assert_eq!(limit("road", "urban"), 50.0);
        assert_eq!(limit("road", "nonurban"), 100.0);
        assert_eq!(limit("highway", "nonurban"), 130.0);
        assert_eq!(limit("play_street", "urban"), 7.0);
        assert_eq!(german_default(&Tags::default()), 50.0);
    }

    fn limit_of(lanelet: Relation, rule: Relation) -> (f64, Vec<Problem>) {
        let sign = Tags::from([("subtype", "de274-60")]);
        let mut problems = Vec::new();
        let limit = limit(&lanelet, |_| Some(&rule), |_| Some(&sign), &mut problems);
        (limit, problems)
    }

    #[test]
    fn a_rule_outranks_the_tag() {
        let member = |kind: &str, role: &str| vec![Member { kind: kind.into(), role: role.into(), id: 2 }];
        let lanelet = || Relation {
            members: member("relation", "regulatory_element"),
            tags: Tags::from([("speed_limit", "70")]),
            ..Relation::default()
        };
        let by_sign = Relation {
            members: member("way", "refers"),
            tags: Tags::from([("subtype", "speed_limit")]),
            ..Relation::default()
        };
        assert_eq!(limit_of(lanelet(), by_sign), (60.0, vec![]));
        let by_tag =
            |tag| Relation { tags: Tags::from([("subtype", "speed_limit"), tag]), ..Relation::default() };
        assert_eq!(limit_of(lanelet(), by_tag(("sign_type", "de274"))), (30.0, vec![]));
        assert_eq!(limit_of(lanelet(), by_tag(("max_speed", "20 mph"))), (20.0 * 1.609344, vec![]));
        let other = Relation { tags: Tags::from([("subtype", "traffic_light")]), ..Relation::default() };
        assert_eq!(limit_of(lanelet(), other), (70.0, vec![]));
    }

    #[test]
    fn a_limit_that_is_none_is_a_problem() {
        let lanelet =
            Relation { id: 8, line: 5, tags: Tags::from([("speed_limit", "-3")]), ..Relation::default() };
        let (limit, problems) = limit_of(lanelet, Relation::default());
        assert_eq!(limit, 50.0);
        assert_eq!(
            problems[0].to_string(),
            "lanelet 8 (line 5): its speed_limit \"-3\" is no speed above 0 and up to 500 km/h; \
             write it like 50, 50 km/h, 30 mph or 14 m/s; without one 50 km/h holds"
        );
    }
}
