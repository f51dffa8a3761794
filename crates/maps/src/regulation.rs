//! The rules of a map as regulations for drivers at junctions.

use std::collections::{HashMap, HashSet};

use laneweave_network::{Id, LaneletIndex, Network, Priority, Regulations, StopKind, StopRule};

use crate::map::Map;
use crate::problem::Problem;
use crate::rule::{Rule, RuleKind};

/// The regulations for the junctions of `map`.
///
/// A light or stop sign to which no lanelet refers applies to the lanelets whose centre lines its stop lines cross.
/// Beside a light, a stop sign does not count.
pub fn regulations(map: &Map) -> Regulations {
    let lookup = Lookup::of(&map.network);
    let mut regulations = Regulations { programs: map.programs.clone(), ..Regulations::default() };
    for rule in &map.rules {
        if let RuleKind::RightOfWay { first, yielding } = &rule.kind {
            let priority = Priority { first: lookup.all(first), yielding: lookup.all(yielding) };
            regulations.stops.push(lookup.stop(rule, StopKind::Line, priority.yielding.clone()));
            regulations.priorities.push(priority);
        }
        regulations.stops.extend(match &rule.kind {
            RuleKind::TrafficLight => Some(lookup.stop(rule, StopKind::Light, lookup.obeying(rule))),
            RuleKind::StopSign => Some(lookup.stop(rule, StopKind::StopSign, lookup.obeying(rule))),
            RuleKind::AllWayStop { lanelets } => {
                Some(lookup.stop(rule, StopKind::AllWayStop, lookup.all(lanelets)))
            }
            _ => None,
        });
    }
    let lit: HashSet<LaneletIndex> = regulations
        .stops
        .iter()
        .filter(|it| it.kind == StopKind::Light)
        .flat_map(|it| it.lanelets.iter().copied())
        .collect();
    for rule in regulations.stops.iter_mut().filter(|it| it.kind != StopKind::Light) {
        rule.lanelets.retain(|it| !lit.contains(it));
    }
    regulations
}

const BY_LINE: (&str, &str) = (
    "no lanelet refers to it, so those obey it whose centre its stop lines cross",
    "add it as regulatory_element to the lanelets whose drivers must obey it",
);
const UNOBEYED: (&str, &str) = (
    "no lanelet for vehicles refers to it, and no stop line of it crosses one, so nobody obeys it",
    "add it as regulatory_element to the lanelets whose drivers must obey it",
);

/// The problems of lights, signs and priorities that nobody obeys, or only those whom their stop lines tell.
pub(crate) fn unobeyed(map: &Map) -> Vec<Problem> {
    let lookup = Lookup::of(&map.network);
    let mut problems = Vec::new();
    for rule in &map.rules {
        let obeying = match &rule.kind {
            RuleKind::TrafficLight | RuleKind::StopSign => lookup.obeying(rule),
            RuleKind::RightOfWay { yielding, .. } => lookup.all(yielding),
            RuleKind::AllWayStop { lanelets } => lookup.all(lanelets),
            RuleKind::Crosswalk { .. } | RuleKind::SpeedLimit | RuleKind::Other(_) => continue,
        };
        let is_by_line = matches!(rule.kind, RuleKind::TrafficLight | RuleKind::StopSign);
        let (what, remedy) = match () {
            () if obeying.is_empty() => UNOBEYED,
            () if rule.lanelets.is_empty() && is_by_line => BY_LINE,
            () => continue,
        };
        problems.push(Problem {
            element: format!("regulatory element {}", rule.id),
            line: rule.line,
            what: format!("{}: {what}", rule.kind.name()),
            remedy: remedy.into(),
        });
    }
    problems
}

struct Lookup<'a> {
    network: &'a Network,
    places: HashMap<Id, LaneletIndex>,
}

impl Lookup<'_> {
    fn of(network: &Network) -> Lookup<'_> {
        let places = network.lanelets.iter().zip(0..).map(|(it, index)| (it.id, LaneletIndex(index)));
        Lookup { network, places: places.collect() }
    }

    fn all(&self, ids: &[Id]) -> Vec<LaneletIndex> {
        ids.iter().filter_map(|id| self.places.get(id).copied()).collect()
    }

    fn obeying(&self, rule: &Rule) -> Vec<LaneletIndex> {
        if !rule.lanelets.is_empty() {
            return self.all(&rule.lanelets);
        }
        let is_crossed = |index: &LaneletIndex| {
            let centre = &self.network.lanelets[index.at()].centre;
            rule.stop_lines.iter().any(|line| centre.crossed_by(line).is_some())
        };
        (0..self.network.lanelets.len() as u32).map(LaneletIndex).filter(is_crossed).collect()
    }

    fn stop(&self, rule: &Rule, kind: StopKind, lanelets: Vec<LaneletIndex>) -> StopRule {
        StopRule { id: rule.id, kind, lanelets, lines: rule.stop_lines.clone() }
    }
}
