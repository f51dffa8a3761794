//! Regulatory elements: lights, signs and priorities, with the lanelets that obey them.

use std::collections::HashMap;

use laneweave_network::{Id, Point};

use super::lookup::Lookup;
use super::osm::{Document, Relation};
use super::sharing::{MAXIMUM_SHARING, Sharing};
use crate::problem::Problem;
use crate::rule::{Rule, RuleKind};

/// The rules of a map, in the order of the file. Missing elements that they name become problems.
pub(super) fn rules(document: &Document, lookup: &Lookup, problems: &mut Vec<Problem>) -> Vec<Rule> {
    let mut obeying: HashMap<i64, Vec<i64>> = HashMap::new();
    for lanelet in document.relations_of_type("lanelet") {
        for rule in document.members(lanelet, "relation", "regulatory_element") {
            obeying.entry(rule).or_default().push(lanelet.id);
        }
    }
    let (mut rules, mut shared) = (Vec::new(), Sharing::default());
    for relation in document.relations_of_type("regulatory_element").filter(|it| lookup.is_first(it)) {
        let lanelets = obeying.remove(&relation.id).unwrap_or_default().into_iter().map(Id::from);
        let reader = Reader { document, lookup, relation, shared: &mut shared, problems };
        rules.push(reader.rule(lanelets.collect()));
    }
    let mut missing: Vec<(i64, Vec<i64>)> =
        obeying.into_iter().filter(|(id, _)| lookup.relation(*id).is_none()).collect();
    missing.sort_unstable();
    for (id, lanelets) in missing {
        let place = lanelets.first().and_then(|it| lookup.relation(*it));
        problems.push(Problem {
            element: format!("lanelet {}", lanelets.first().copied().unwrap_or_default()),
            line: place.map(|it| document.relations[it].line as usize),
            what: format!("its regulatory element {id} is missing, so it has no effect"),
            remedy: "add the element, or remove it from the members of the lanelet".into(),
        });
    }
    rules
}

/// Reads one regulatory element.
struct Reader<'a> {
    document: &'a Document<'a>,
    lookup: &'a Lookup<'a>,
    relation: &'a Relation,
    /// The number of rules that name each way, by its index in the document.
    shared: &'a mut Sharing<usize>,
    problems: &'a mut Vec<Problem>,
}

impl Reader<'_> {
    fn rule(mut self, lanelets: Vec<Id>) -> Rule {
        let kind = self.kind();
        let mut stop_lines = self.lines("ref_line");
        let mut signs = self.lines("refers");
        let shows_line = self.refers_to("stop_line");
        if kind == RuleKind::StopSign && stop_lines.is_empty() && shows_line {
            std::mem::swap(&mut stop_lines, &mut signs);
        }
        Rule {
            id: self.relation.id.into(),
            line: Some(self.relation.line as usize),
            kind,
            lanelets,
            stop_lines,
            signs,
        }
    }

    fn kind(&mut self) -> RuleKind {
        let subtype = self.document.tags(self.relation.tags).get("subtype").unwrap_or_default();
        match subtype {
            "traffic_light" => RuleKind::TrafficLight,
            "right_of_way" => RuleKind::RightOfWay {
                first: self.lanelets("right_of_way"),
                yielding: self.lanelets("yield"),
            },
            "all_way_stop" => RuleKind::AllWayStop { lanelets: self.lanelets("yield") },
            "traffic_sign" if self.refers_to("stop_sign") => RuleKind::StopSign,
            "road_marking" if self.refers_to("stop_line") => RuleKind::StopSign,
            "crosswalk" => RuleKind::Crosswalk { lanelets: self.lanelets("refers") },
            "speed_limit" => RuleKind::SpeedLimit,
            "" => {
                self.complain("it has no subtype, so it has no effect", "add the tag subtype");
                RuleKind::Other("no subtype".into())
            }
            other => RuleKind::Other(other.into()),
        }
    }

    /// Whether the element that it refers to is a way of this type, or subtype.
    fn refers_to(&self, kind: &str) -> bool {
        let ways = self.document.members(self.relation, "way", "refers");
        ways.filter_map(|it| self.lookup.way(it)).any(|way| {
            let tags = self.document.tags(self.document.ways[way].tags);
            tags.is("type", kind) || tags.is("subtype", kind)
        })
    }

    /// The ids of the lanelets with `role` that are in the map.
    fn lanelets(&mut self, role: &'static str) -> Vec<Id> {
        let named: Vec<i64> = self.document.members(self.relation, "relation", role).collect();
        named
            .into_iter()
            .filter(|id| self.is_there(*id, self.lookup.relation(*id), "relation", role))
            .map(Id::from)
            .collect()
    }

    /// The ways with `role` that are in the map.
    fn lines(&mut self, role: &'static str) -> Vec<Vec<Point>> {
        let named: Vec<i64> = self.document.members(self.relation, "way", role).collect();
        let (mut lines, mut left_out) = (Vec::new(), 0);
        for id in named {
            let way = self.lookup.way(id);
            if let Some(way) = way.filter(|_| self.is_there(id, way, "way", role)) {
                if !self.shared.admits(way) {
                    left_out += 1;
                    continue;
                }
                let nodes = self.document.nodes_of(&self.document.ways[way]);
                lines.push(nodes.iter().filter_map(|it| self.lookup.point(*it)).collect());
            }
        }
        if left_out > 0 {
            let what = format!(
                "{left_out} of its {role} are ways that {MAXIMUM_SHARING} others already use, so they are ignored"
            );
            self.complain(&what, "use each way once");
        }
        lines
    }

    fn is_there(&mut self, id: i64, place: Option<usize>, kind: &str, role: &str) -> bool {
        if place.is_none() {
            let what = format!("its {role} is {kind} {id}, which is missing, so it is ignored");
            self.complain(&what, "add that element, or refer to another");
        }
        place.is_some()
    }

    fn complain(&mut self, what: &str, remedy: &str) {
        self.problems.push(Problem {
            element: format!("regulatory element {}", self.relation.id),
            line: Some(self.relation.line as usize),
            what: what.into(),
            remedy: remedy.into(),
        });
    }
}
