//! One part of a map: to scale, but for long roads without bends, which are wider.

use std::collections::HashSet;
use std::fmt::{Arguments, Write};

use laneweave_maps::{Map, Rule, RuleKind};
use laneweave_network::{Gate, Lanelet, Point, Polyline, Side};
use laneweave_study::Panel;

use super::{colours, in_plan};

/// A part of the map with its position on the page.
pub(super) struct MapPanel<'a> {
    pub(super) map: &'a Map,
    pub(super) panel: Panel,
}

impl MapPanel<'_> {
    /// Draws all of it.
    pub(super) fn draw(&self, svg: &mut String, named: &HashSet<&str>) {
        self.crosswalks(svg);
        self.lanes(svg);
        self.rules(svg);
        let network = &self.map.network;
        self.gates(svg, &network.entrances, colours::ENTRANCE, true);
        self.gates(svg, &network.exits, colours::EXIT, false);
        self.problems(svg, named);
        svg.push_str(&self.panel.bar());
    }

    fn place(&self, point: &Point) -> (f64, f64) {
        self.panel.place(in_plan(point))
    }

    /// The path along points as SVG, without invisible points.
    fn path<'p>(&self, points: impl IntoIterator<Item = &'p Point>) -> String {
        self.panel.path(points.into_iter().map(in_plan))
    }

    /// Whether `point` lies in the panel, or close to it.
    fn is_near(&self, point: &Point) -> bool {
        self.panel.bounds.is_near(in_plan(point))
    }

    fn crosswalks(&self, svg: &mut String) {
        for outline in &self.map.contents.crosswalks {
            if outline.iter().all(|it| self.is_near(it)) {
                let (path, colour) = (self.path(outline), colours::CROSSWALK);
                add(
                    svg,
                    format_args!(
                        "<path d=\"{path}Z\" fill=\"none\" stroke=\"{colour}\" stroke-dasharray=\"2 2\"/>"
                    ),
                );
            }
        }
    }

    fn lanes(&self, svg: &mut String) {
        self.panel.members.iter().for_each(|it| self.surface(svg, *it));
        svg.push_str("<g pointer-events=\"none\">\n");
        for lanelet in self.panel.members.iter().map(|it| &self.map.network.lanelets[*it]) {
            for (side, border) in Side::BOTH.into_iter().zip(borders(lanelet)) {
                let dashes = if lanelet.beside(side).is_some() { " stroke-dasharray=\"4 5\"" } else { "" };
                let (path, colour) = (self.path(border.points()), colours::MARKING);
                add(
                    svg,
                    format_args!(
                        "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"0.8\"{dashes}/>"
                    ),
                );
            }
        }
        svg.push_str("</g>\n");
    }

    /// The area of a lanelet, which says what it is when it is pointed at.
    fn surface(&self, svg: &mut String, index: usize) {
        let lanelet = &self.map.network.lanelets[index];
        let [left, right] = borders(lanelet);
        let path = self.path(left.points().iter().chain(right.points().iter().rev()));
        let (id, road, conflict) = (lanelet.id, colours::ROAD, colours::CONFLICT);
        let (length, limit) = (lanelet.length(), lanelet.speed_limit * 3.6);
        let over = match self.map.graph.conflicting[index].is_empty() {
            true => String::new(),
            false => format!("<path d=\"{path}Z\" fill=\"{conflict}\" fill-opacity=\"0.22\"/>"),
        };
        add(
            svg,
            format_args!(
                "<g data-lanelet=\"{id}\"><title>lanelet {id}: {length:.0} m, {limit:.0} km/h</title>\
                 <path d=\"{path}Z\" fill=\"{road}\"/>{over}</g>"
            ),
        );
    }

    /// Stop lines in the colour of their rule, and the lights themselves.
    fn rules(&self, svg: &mut String) {
        for rule in &self.map.rules {
            let colour = match rule.kind {
                RuleKind::TrafficLight => colours::LIGHT,
                RuleKind::RightOfWay { .. } | RuleKind::AllWayStop { .. } | RuleKind::StopSign => {
                    colours::PRIORITY
                }
                _ => continue,
            };
            for line in self.stop_lines(rule).iter().filter(|it| it.iter().all(|p| self.is_near(p))) {
                let path = self.path(line);
                add(
                    svg,
                    format_args!(
                        "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\"/>"
                    ),
                );
            }
            for sign in rule.signs.iter().filter_map(|it| it.first()) {
                if self.is_near(sign) {
                    let (x, y) = self.place(sign);
                    add(svg, format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>"));
                }
            }
        }
    }

    /// Where drivers stop for a rule: at its lines, or else where their lanelets end.
    fn stop_lines(&self, rule: &Rule) -> Vec<Vec<Point>> {
        if !rule.stop_lines.is_empty() {
            return rule.stop_lines.clone();
        }
        let stopping = match &rule.kind {
            RuleKind::RightOfWay { yielding, .. } => yielding,
            _ => &rule.lanelets,
        };
        let own = self.panel.members.iter().map(|it| &self.map.network.lanelets[*it]);
        let ends = own
            .filter(|it| stopping.contains(&it.id))
            .map(|it| borders(it).into_iter().filter_map(|border| border.points().last()).copied().collect());
        ends.collect()
    }

    /// An arrow into, or out of, each lane of the gates.
    fn gates(&self, svg: &mut String, gates: &[Gate], colour: &str, is_entrance: bool) {
        for chain in gates.iter().flat_map(|it| &it.chains).map(|it| self.map.network.chain(*it)) {
            let station = if is_entrance { 0.0 } else { chain.length };
            let at = chain.centre.at(station);
            if !self.is_near(&at) {
                continue;
            }
            let (x, y) = self.place(&at);
            // The arrow has the direction that the road has on the page.
            let (heading, [across, upwards]) = (chain.centre.heading(station), self.panel.scale());
            let degrees = -(upwards * heading.sin()).atan2(across * heading.cos()).to_degrees();
            // The arrow of an entrance ends where the road begins; that of an exit begins where the road ends.
            let tip = if is_entrance { 0.0 } else { 14.0 };
            add(
                svg,
                format_args!(
                    "<path transform=\"translate({x:.1} {y:.1}) rotate({degrees:.1})\" fill=\"{colour}\" \
                 d=\"M{tip} 0l-6 -4v2.5h-8v3h8v2.5z\"/>"
                ),
            );
        }
    }

    /// A circle around the middle of each lanelet with a problem.
    fn problems(&self, svg: &mut String, named: &HashSet<&str>) {
        for lanelet in self.panel.members.iter().map(|it| &self.map.network.lanelets[*it]) {
            if named.contains(format!("lanelet {}", lanelet.id).as_str()) {
                let (x, y) = self.place(&lanelet.centre.at(lanelet.length() / 2.0));
                let radius = (0.4 * self.panel.scale()[0] * lanelet.length()).clamp(2.5, 7.0);
                add(
                    svg,
                    format_args!(
                        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>",
                        colours::PROBLEM
                    ),
                );
            }
        }
    }
}

/// Adds an element.
fn add(svg: &mut String, element: Arguments) {
    // Writing to a string never fails.
    let _ = svg.write_fmt(element);
    svg.push('\n');
}

/// Left and right border.
fn borders(lanelet: &Lanelet) -> [&Polyline; 2] {
    [&lanelet.left_border, &lanelet.right_border]
}
