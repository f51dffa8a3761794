//! Speed limits of lanelets.

use std::collections::HashMap;

use super::element::{LaneletElement, Sign, problem};
use crate::drawing::{KMH_PER_MPS, Surroundings};
use crate::law::Law;
use crate::problem::Problem;

/// Numbers of signs that show a maximum speed, in the catalogues that CommonRoad knows: of Germany (used for
/// China and Italy, too) and of zones there, of the USA, Spain, Russia, Argentina, Belgium, France, Greece
/// and Croatia.
pub(super) const SPEED_SIGNS: [&str; 10] =
    ["274", "274.1", "R2-1", "r301", "3.24", "R15", "C43", "B14", "\u{3a1}-32", "B31"];
/// Limits above this are taken as errors [km/h].
const MAXIMUM: f64 = 500.0;

/// The limits that the signs of a map show [m/s], by their ids. The lowest of several on one sign counts.
pub(super) struct SpeedSigns(HashMap<i64, Option<f64>>);

impl SpeedSigns {
    pub(super) fn of(signs: &[Sign], problems: &mut Vec<Problem>) -> SpeedSigns {
        let mut limits = HashMap::new();
        for sign in signs {
            if limits.contains_key(&sign.id) {
                let what = "another sign above has the same id, so this one is left out";
                problems.push(problem("traffic sign", sign.id, sign.line, what, "give it an id of its own"));
                continue;
            }
            limits.insert(sign.id, shown(sign, problems));
        }
        SpeedSigns(limits)
    }
}

fn shown(sign: &Sign, problems: &mut Vec<Problem>) -> Option<f64> {
    let mut limit: Option<f64> = None;
    for (_, value) in sign.shown.iter().filter(|(number, _)| SPEED_SIGNS.contains(&number.as_str())) {
        match value.filter(|it| is_limit(*it)) {
            Some(value) => limit = Some(limit.map_or(value, |it| it.min(value))),
            None => {
                let what = format!("its value is not a speed above 0 and up to {MAXIMUM} km/h");
                let remedy = "write its additionalValue in m/s, like 13.89";
                problems.push(problem("traffic sign", sign.id, sign.line, what, remedy));
            }
        }
    }
    limit
}

fn is_limit(speed: f64) -> bool {
    speed > 0.0 && speed <= MAXIMUM / KMH_PER_MPS
}

/// The limit of a lanelet [m/s].
///
/// Its own element `speedLimit` comes first, then the lowest limit on its signs, then the legal limit for its types,
/// which is added to `of_law` [km/h], in its surroundings.
pub(super) fn limit(
    lanelet: &LaneletElement,
    signs: &SpeedSigns,
    law: Law,
    surroundings: Surroundings,
    of_law: &mut Vec<f64>,
    problems: &mut Vec<Problem>,
) -> f64 {
    let default = match surroundings {
        Surroundings::Town => law.limit(Some("road"), Some("urban")),
        Surroundings::Motorway => law.limit(Some("highway"), Some("nonurban")),
        Surroundings::Country => law.limit(Some("road"), Some("nonurban")),
    };
    match lanelet.speed_limit {
        Some(limit) if is_limit(limit) => return limit,
        Some(_) => {
            let what = format!("its speedLimit is not a speed above 0 and up to {MAXIMUM} km/h");
            let remedy = format!("write it in m/s, like 13.89; the default is {default} km/h");
            problems.push(lanelet.problem(what, &remedy));
        }
        None => {}
    }
    let mut missing = lanelet.signs.iter().filter(|it| !signs.0.contains_key(it));
    if let Some(first) = missing.next() {
        let what = match missing.count() {
            0 => format!("it refers to traffic sign {first}, which is missing"),
            more => format!("it refers to traffic signs {first} and {more} more, which are missing"),
        };
        problems.push(lanelet.problem(what, "add the sign, or remove the reference"));
    }
    let shown = lanelet.signs.iter().filter_map(|it| *signs.0.get(it)?);
    shown.reduce(f64::min).unwrap_or_else(|| {
        of_law.push(default);
        default / KMH_PER_MPS
    })
}

#[cfg(test)]
mod tests {
    use super::super::rules::{surroundings, surroundings_of};
    use super::*;

    fn sign(id: i64, shown: &[(&str, Option<f64>)]) -> Sign {
        Sign {
            id,
            line: 9,
            shown: shown.iter().map(|(number, value)| (number.to_string(), *value)).collect(),
        }
    }

    /// The limit [km/h], rounded, and the problems.
    fn limit_of(lanelet: LaneletElement, signs: &[Sign], tags: &[&str]) -> (f64, Vec<String>) {
        let tags: Vec<String> = tags.iter().map(|it| it.to_string()).collect();
        let mut problems = Vec::new();
        let signs = SpeedSigns::of(signs, &mut problems);
        let of_law = &mut Vec::new();
        let limit = limit(
            &lanelet,
            &signs,
            Law::Germany,
            surroundings(&lanelet, surroundings_of(&tags)),
            of_law,
            &mut problems,
        );
        ((limit * KMH_PER_MPS).round(), problems.iter().map(Problem::to_string).collect())
    }

    #[test]
    fn the_lowest_sign_outranks_the_default_and_the_element_the_signs() {
        let signs = [
            sign(1, &[("274", Some(25.0))]),
            sign(2, &[("R3-4", None), ("R2-1", Some(20.0)), ("274.1", Some(22.0))]),
            sign(3, &[("206", Some(5.0))]),
        ];
        let mut lanelet = LaneletElement { signs: vec![1, 2, 3], ..LaneletElement::default() };
        assert_eq!(limit_of(lanelet, &signs, &[]), (72.0, vec![]));
        lanelet = LaneletElement { signs: vec![3], ..LaneletElement::default() };
        assert_eq!(limit_of(lanelet, &signs, &["interstate", "multi_lane"]), (130.0, vec![]));
        lanelet = LaneletElement { signs: vec![1], speed_limit: Some(10.0), ..LaneletElement::default() };
        assert_eq!(limit_of(lanelet, &signs, &[]), (36.0, vec![]));
    }

    #[test]
    fn german_defaults_hold_without_a_sign() {
        let of = |types: &[&str], tags: &[&str]| {
            let types = types.iter().map(|it| it.to_string()).collect();
            limit_of(LaneletElement { types, ..LaneletElement::default() }, &[], tags).0
        };
        for (types, kmh) in [
            (&["interstate", "accessRamp"][..], 130.0),
            (&["urban", "mainCarriageWay"], 50.0),
            (&["country"], 100.0),
            (&["unknown"], 50.0),
        ] {
            assert_eq!((of(types, &["highway"]), of(types, &["urban"])), (kmh, kmh), "{types:?}");
        }
        // Where the type says little, the scenario's tags decide.
        for types in [&[][..], &["urban"]] {
            let by_tag =
                [of(types, &["highway", "comfort"]), of(types, &["highway", "urban"]), of(types, &[])];
            assert_eq!(by_tag, [130.0, 50.0, 50.0]);
        }
    }

    #[test]
    fn limits_that_are_none_are_problems() {
        for limit in [0.0, -1.0, f64::NAN, f64::INFINITY, 139.0] {
            let lanelet =
                LaneletElement { id: 8, line: 5, speed_limit: Some(limit), ..LaneletElement::default() };
            let (kmh, problems) = limit_of(lanelet, &[], &[]);
            assert_eq!(kmh, 50.0);
            assert_eq!(
                problems,
                ["lanelet 8 (line 5): its speedLimit is not a speed above 0 and up to 500 km/h; \
                  write it in m/s, like 13.89; the default is 50 km/h"]
            );
        }
        let signs = [sign(1, &[("274", None)]), sign(2, &[]), sign(2, &[("274", Some(300.0))])];
        let lanelet = LaneletElement { signs: vec![1, 2, 3, 4, 5], ..LaneletElement::default() };
        let (kmh, problems) = limit_of(lanelet, &signs, &[]);
        assert_eq!((kmh, problems.len()), (50.0, 3));
        assert!(problems[0].starts_with("traffic sign 1 (line 9): its value is not a speed"), "{problems:?}");
        assert!(problems[1].starts_with("traffic sign 2 (line 9): another sign above has the same id"));
        assert!(problems[2].contains("it refers to traffic signs 3 and 2 more, which are missing"));
    }
}
