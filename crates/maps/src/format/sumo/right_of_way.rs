//! Who gives way to whom, and where drivers wait: the requests of junctions as rules.

use std::collections::HashMap;

use laneweave_network::{Id, Lanelet, LaneletIndex, Point};

use super::movement::Movement;
use super::net::{Junction, Net};
use crate::rule::{Rule, RuleKind};

/// Kinds of junctions where priority follows from the side from which somebody comes.
const BY_SIDE: [&str; 2] = ["right_before_left", "left_before_right"];

/// Adds the signs and the priorities of all junctions.
pub(super) fn add(net: &Net, movements: &[Movement], rules: &mut Rules) {
    let by_last: HashMap<&str, &Movement> =
        movements.iter().filter_map(|it| Some((net.lanes[it.last?].id.as_str(), it))).collect();
    for junction in &net.junctions {
        let of_junction: Vec<Option<&Movement>> =
            junction.internal_lanes.iter().map(|it| by_last.get(it.as_str()).copied()).collect();
        rules.add_signs(&of_junction);
        if !BY_SIDE.contains(&junction.kind.as_str()) {
            rules.add_priorities(junction, &of_junction);
        }
    }
}

/// Rules that grow.
pub(super) struct Rules<'a> {
    pub(super) all: Vec<Rule>,
    lanelets: &'a [Lanelet],
}

impl Rules<'_> {
    /// None yet, for these lanelets.
    pub(super) fn of(lanelets: &[Lanelet]) -> Rules<'_> {
        Rules { all: Vec::new(), lanelets }
    }

    /// Adds a light for the drivers of some movements, who obey it where these begin.
    pub(super) fn add_light(&mut self, id: Id, movements: &[LaneletIndex]) {
        let lines: Vec<Vec<Point>> = movements.iter().map(|it| self.line(*it, 0.0)).collect();
        let lanelets = movements.iter().map(|it| self.id(*it)).collect();
        let signs = lines.clone();
        self.all.push(Rule {
            id,
            line: None,
            kind: RuleKind::TrafficLight,
            lanelets,
            stop_lines: lines,
            signs,
        });
    }

    /// Stop signs, and all-way stops.
    fn add_signs(&mut self, movements: &[Option<&Movement>]) {
        let with = |state: char| {
            let all = movements.iter().flatten().filter(move |it| it.connection.state == state);
            all.copied().collect::<Vec<&Movement>>()
        };
        for movement in with('s') {
            let line = self.line(movement.lanelet, 0.0);
            self.add(RuleKind::StopSign, vec![self.id(movement.lanelet)], vec![line]);
        }
        let all_way = with('w');
        if !all_way.is_empty() {
            let lanelets = all_way.iter().map(|it| self.id(it.lanelet)).collect();
            let lines = all_way.iter().map(|it| self.line(it.lanelet, 0.0)).collect();
            self.add(RuleKind::AllWayStop { lanelets }, Vec::new(), lines);
        }
    }

    /// What the requests say, for each movement.
    fn add_priorities(&mut self, junction: &Junction, movements: &[Option<&Movement>]) {
        for request in &junction.requests {
            let Some(Some(yielding)) = movements.get(request.index) else { continue };
            let others = request.response.iter().zip(movements).filter(|(gives_way, _)| **gives_way);
            let first: Vec<Id> = others.filter_map(|(_, it)| Some(self.id(it.as_ref()?.lanelet))).collect();
            if first.is_empty() {
                continue;
            }
            let inside = yielding.inside.filter(|_| request.waits_inside);
            let line = self.line(yielding.lanelet, inside.unwrap_or(0.0));
            let kind = RuleKind::RightOfWay { first, yielding: vec![self.id(yielding.lanelet)] };
            self.add(kind, Vec::new(), vec![line]);
        }
    }

    fn id(&self, lanelet: LaneletIndex) -> Id {
        self.lanelets[lanelet.at()].id
    }

    /// A line across a lanelet, so far along it [m].
    fn line(&self, lanelet: LaneletIndex, along: f64) -> Vec<Point> {
        const HALF_WIDTH: f64 = 1.0;
        let centre = &self.lanelets[lanelet.at()].centre;
        [HALF_WIDTH, -HALF_WIDTH].map(|it| centre.beside(along, it)).to_vec()
    }

    fn add(&mut self, kind: RuleKind, lanelets: Vec<Id>, stop_lines: Vec<Vec<Point>>) {
        let id = Id::from(self.all.len() as i64 + 1);
        self.all.push(Rule { id, line: None, kind, lanelets, stop_lines, signs: Vec::new() });
    }
}
