//! Speed limits of lanelets.

use std::collections::HashMap;

use super::lookup::Lookup;
use super::osm::{Document, Relation};
use crate::drawing::KMH_PER_MPS;
use crate::law::{KMH_PER_MPH, Law};
use crate::problem::Problem;

/// Limits above this are taken as errors [km/h].
const MAXIMUM: f64 = 500.0;

/// The tags of a lanelet with its limit; the first one given counts.
pub(super) const KEYS: [&str; 3] = ["speed_limit:vehicle:car", "speed_limit:vehicle", "speed_limit"];

/// The speed limit rules of a document.
pub(super) struct SpeedRules<'d> {
    document: &'d Document<'d>,
    lookup: &'d Lookup<'d>,
    /// By their indices in the document.
    rules: HashMap<usize, Said<'d>>,
}

/// A speed limit as text.
#[derive(Clone, Copy)]
struct Said<'d> {
    line: u32,
    text: &'d str,
    /// Its value [km/h].
    limit: Option<f64>,
}

impl<'d> Said<'d> {
    fn new(line: u32, text: &'d str) -> Said<'d> {
        Said { line, text: excerpt(text), limit: sign_limit(text).or_else(|| speed(text)) }
    }
}

impl<'d> SpeedRules<'d> {
    /// Reads the rules of the subtype `speed_limit`, each once, however many lanelets name it.
    pub(super) fn of(document: &'d Document<'d>, lookup: &'d Lookup<'d>) -> SpeedRules<'d> {
        let all = document.relations.iter().enumerate();
        let rules = all.filter(|(_, it)| document.tags(it.tags).is("subtype", "speed_limit"));
        let rules = rules.map(|(place, it)| (place, Said::new(it.line, sign_text(document, lookup, it))));
        SpeedRules { document, lookup, rules: rules.collect() }
    }

    /// The limit of a lanelet [km/h].
    ///
    /// Its first rule that can be understood comes first, then its tags, then the legal limit, which is added to
    /// `of_law`.
    pub(super) fn limit(
        &self,
        lanelet: &Relation,
        law: Law,
        of_law: &mut Vec<f64>,
        problems: &mut Vec<Problem>,
    ) -> f64 {
        let tags = self.document.tags(lanelet.tags);
        let rules = self.document.members(lanelet, "relation", "regulatory_element");
        let by_rule = rules.filter_map(|id| self.rules.get(&self.lookup.relation(id)?));
        let by_rule = by_rule.map(|said| (*said, "speed limit rule"));
        let by_tag = KEYS.into_iter().filter_map(|key| Some((Said::new(lanelet.line, tags.get(key)?), key)));
        let default = law.limit(tags.get("subtype"), tags.get("location"));
        for (Said { line, text, limit }, source) in by_rule.chain(by_tag) {
            if let Some(limit) = limit {
                return limit;
            }
            problems.push(Problem {
                element: format!("lanelet {}", lanelet.id),
                line: Some(line as usize),
                what: format!("its {source} {text:?} is not a speed above 0 and up to {MAXIMUM} km/h"),
                remedy: format!("write it like 50, 50 km/h, 30 mph or 14 m/s; the default is {default} km/h"),
            });
        }
        of_law.push(default);
        default
    }
}

/// The beginning of a text, for messages.
fn excerpt(text: &str) -> &str {
    const LETTERS: usize = 40;
    text.char_indices().nth(LETTERS).map_or(text, |(end, _)| &text[..end])
}

/// The limit of a rule: by a tag of its own, or by the sign to which it refers.
fn sign_text<'d>(document: &'d Document<'d>, lookup: &Lookup, rule: &Relation) -> &'d str {
    let tags = document.tags(rule.tags);
    let own = ["sign_type", "speed_limit", "max_speed"].into_iter().find_map(|key| tags.get(key));
    let signs = document.members(rule, "way", "refers").filter_map(|id| lookup.way(id));
    let mut shown = signs.filter_map(|way| document.tags(document.ways[way].tags).get("subtype"));
    own.or_else(|| shown.next()).unwrap_or_default()
}

/// The limit of a German sign: 274 with the speed after a dash (a zone of 30 km/h without), 310 is the town sign.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::lanelet2::parse::parse;

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

    /// The limit of a lanelet with these tags and a rule with those; the rule refers to a sign of 60 km/h.
    fn limit_of(lanelet: &str, rule: &str) -> (f64, Vec<Problem>) {
        let (limit, _, problems) = limit_and_law(lanelet, rule);
        (limit, problems)
    }

    /// The same, with the legal limits that were used.
    fn limit_and_law(lanelet: &str, rule: &str) -> (f64, Vec<f64>, Vec<Problem>) {
        let text = format!(
            "<osm><node id='1' x='0' y='0'/><way id='4'><tag k='subtype' v='de274-60'/></way>\n\n\n\n\
             <relation id='8'><member type='relation' ref='2' role='regulatory_element'/>{lanelet}</relation>\
             <relation id='2'><member type='way' ref='4' role='refers'/>{rule}</relation></osm>"
        );
        let mut problems = Vec::new();
        let document = parse(text.as_bytes(), &mut problems).unwrap();
        let (lookup, _) = Lookup::new(&document, None, &mut problems).unwrap();
        let rules = SpeedRules::of(&document, &lookup);
        let mut of_law = Vec::new();
        let limit = rules.limit(&document.relations[0], Law::Germany, &mut of_law, &mut problems);
        (limit, of_law, problems)
    }

    #[test]
    fn a_rule_outranks_the_tag() {
        let tag = "<tag k='speed_limit' v='70'/>";
        let rule = "<tag k='subtype' v='speed_limit'/>";
        assert_eq!(limit_of(tag, rule), (60.0, vec![]));
        assert_eq!(limit_of(tag, &format!("{rule}<tag k='sign_type' v='de274'/>")), (30.0, vec![]));
        let miles = format!("{rule}<tag k='max_speed' v='20 mph'/>");
        assert_eq!(limit_of(tag, &miles), (20.0 * 1.609344, vec![]));
        assert_eq!(limit_of(tag, "<tag k='subtype' v='traffic_light'/>"), (70.0, vec![]));
    }

    #[test]
    fn a_limit_that_only_the_law_gives_is_noted() {
        let tag = "<tag k='speed_limit' v='70'/>";
        let highway = "<tag k='subtype' v='highway'/>";
        assert_eq!(limit_and_law(tag, "").1, []);
        assert_eq!(limit_and_law(highway, "").1, [130.0]);
        assert_eq!(limit_and_law("<tag k='speed_limit' v='-3'/>", "").1, [50.0]);
    }

    #[test]
    fn a_long_text_is_a_problem_that_begins_like_it() {
        let rule =
            format!("<tag k='subtype' v='speed_limit'/><tag k='sign_type' v='{}'/>", "ä".repeat(100_000));
        let (limit, problems) = limit_of("", &rule);
        assert_eq!(limit, 50.0);
        assert!(
            problems[0].what.contains(&format!("speed limit rule \"{}\" is not a speed", "ä".repeat(40)))
        );
    }

    #[test]
    fn a_limit_that_is_none_is_a_problem() {
        let (limit, problems) = limit_of("<tag k='speed_limit' v='-3'/>", "");
        assert_eq!(limit, 50.0);
        assert_eq!(
            problems[0].to_string(),
            "lanelet 8 (line 5): its speed_limit \"-3\" is not a speed above 0 and up to 500 km/h; \
             write it like 50, 50 km/h, 30 mph or 14 m/s; the default is 50 km/h"
        );
    }
}
