//! Where drivers may have to stop: lights, signs, lines, and the beginnings of zones.

use std::collections::{BTreeSet, HashMap};

use crate::chain::{ChainIndex, Position};
use crate::geometry::{Point, Polyline};
use crate::junction::{
    Crossing, Junctions, Light, LightIndex, OnChain, Place, PlaceKind, Program, Reach, Regulations, Sign,
    Stop, StopKind, StopRule, ZoneKind,
};
use crate::lanelet::LaneletIndex;
use crate::network::Network;

impl Junctions {
    pub(super) fn place_stops(&mut self, network: &Network, regulations: &Regulations) {
        for (rules, number) in sharing(&regulations.stops).into_iter().zip(0..) {
            let Some(id) = rules.iter().map(|it| it.id).min() else { continue };
            let program = regulations.programs.get(&id);
            self.programmed.extend(program.map(|_| LightIndex(number)));
            let program = program.cloned().unwrap_or(Program::ALWAYS_GREEN);
            self.lights.push(Light { id, program, plan: None });
            for rule in rules {
                self.place(network, rule, Sign::Light(LightIndex(number)));
            }
        }
        for rule in &regulations.stops {
            match rule.kind {
                StopKind::Light => {}
                StopKind::StopSign | StopKind::AllWayStop => self.place(network, rule, Sign::Stop),
                StopKind::Line => self.place(network, rule, Sign::Line),
            }
        }
        for chain in &mut self.chains {
            chain.stops.sort_by(|a, b| a.station.total_cmp(&b.station));
            chain.stops.dedup_by(|b, a| a.sign == b.sign && b.station - a.station < 1.0);
        }
    }

    pub(super) fn note_places(&mut self) {
        let Junctions { zones, chains, .. } = self;
        let place = |crossing: &Crossing| {
            let (zone, side) = (&zones[crossing.zone.at()], usize::from(crossing.side));
            let merge = match zone.kind {
                ZoneKind::Merging(stations) => Some(stations[side]),
                ZoneKind::Crossing => None,
            };
            let Reach { start, end, .. } = zone.sides[side];
            Place {
                station: start,
                what: PlaceKind::Zone { crossing: *crossing, touch: zone.touch, end, merge },
            }
        };
        for chain in chains {
            let stops =
                chain.stops.iter().map(|it| Place { station: it.station, what: PlaceKind::Sign(it.sign) });
            chain.places = stops.chain(chain.crossings.iter().map(place)).collect();
            chain.places.sort_by(|a, b| a.station.total_cmp(&b.station));
            if let [first, .., last] | [first @ last] = &chain.places[..] {
                chain.extent = [first.station, last.station];
            }
        }
    }

    /// Spreads the distances to the next places backwards until none becomes shorter.
    pub(super) fn look_beyond(&mut self, network: &Network) {
        let chains = &mut self.chains;
        let mut open: Vec<usize> = (0..chains.len()).collect();
        while let Some(index) = open.pop() {
            let to_place = |it: &ChainIndex| {
                let OnChain { extent: [first, _], beyond, .. } = chains[it.at()];
                first.min(network.chain(*it).length + beyond)
            };
            let here = &network.chains[index];
            let beyond = here.following.iter().map(to_place).fold(f64::INFINITY, f64::min);
            if beyond < chains[index].beyond {
                chains[index].beyond = beyond;
                open.extend(here.previous.iter().map(|it| it.at()));
            }
        }
    }

    fn place(&mut self, network: &Network, rule: &StopRule, sign: Sign) {
        for lanelet in &rule.lanelets {
            let Position { chain, x: start } = network.start_of(*lanelet);
            let centre = &network.lanelets[lanelet.at()].centre;
            let along = rule.lines.iter().find_map(|line| centre.crossed_by(line));
            // A line before the lanelet belongs to a lanelet within the junction.
            let is_before = rule.lines.iter().any(|line| is_nearer_to_start(centre, line));
            let station = start + along.unwrap_or(if is_before { 0.0 } else { centre.length() });
            self.chains[chain.at()].stops.push(Stop { station, sign });
        }
    }
}

fn is_nearer_to_start(centre: &Polyline, line: &[Point]) -> bool {
    let nearest = |to: Point| line.iter().map(|it| it.distance(&to)).fold(f64::INFINITY, f64::min);
    nearest(centre.at(0.0)) < nearest(centre.at(centre.length()))
}

/// The rules of lights. Lights that the drivers on one lanelet obey are together, ordered by their smallest ids.
fn sharing(stops: &[StopRule]) -> Vec<Vec<&StopRule>> {
    // A group that has become part of a later one is empty.
    let mut groups: Vec<Vec<&StopRule>> = Vec::new();
    let mut group_of: HashMap<LaneletIndex, usize> = HashMap::new();
    for rule in stops.iter().filter(|it| it.kind == StopKind::Light && !it.lanelets.is_empty()) {
        let together: BTreeSet<usize> =
            rule.lanelets.iter().filter_map(|it| group_of.get(it)).copied().collect();
        let mut group: Vec<&StopRule> = Vec::new();
        together.into_iter().for_each(|it| group.append(&mut groups[it]));
        group.push(rule);
        group_of.extend(group.iter().flat_map(|it| &it.lanelets).map(|it| (*it, groups.len())));
        groups.push(group);
    }
    groups.retain(|it| !it.is_empty());
    groups.sort_by_key(|group| group.iter().map(|it| it.id).min());
    groups
}
