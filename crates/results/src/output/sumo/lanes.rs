//! Lanelets as lanes of SUMO: `EDGE_INDEX`. Lanelets of a SUMO net have the ids of its lanes. Elsewhere an edge is a
//! group of lanelets side by side, named by the smallest of their ids; lanes count from 0 on the slow side.

use super::xml::attribute;
use laneweave_network::{LaneletIndex, Network, Sections, Side};

/// The names of the lanes of all lanelets: as text, and as XML.
pub(in crate::output) struct Lanes([Vec<String>; 2]);

impl Lanes {
    pub(in crate::output) fn of(network: &Network) -> Lanes {
        let mut names = vec![String::new(); network.lanelets.len()];
        let slow = network.driving_side.overtaking().opposite();
        for section in Sections::of(network).all() {
            let id = |it: &LaneletIndex| network.lanelets[it.at()].id;
            let Some(edge) = section.lanelets.iter().map(id).min() else { continue };
            let mut lanes = section.lanelets.clone();
            // Where the map contradicts itself, the ids decide.
            lanes.sort_by_key(|it| (lanes_beyond(network, *it, slow, section.lanelets.len()), id(it)));
            for (index, lanelet) in lanes.iter().enumerate() {
                let own = id(lanelet);
                names[lanelet.at()] = match own.number() {
                    Some(_) => format!("{edge}_{index}"),
                    None => own.to_string(),
                };
            }
        }
        let in_xml = names.iter().map(|it| attribute(it)).collect();
        Lanes([names, in_xml])
    }

    /// The lane of a lanelet.
    pub(in crate::output) fn name(&self, lanelet: LaneletIndex) -> &str {
        &self.0[0][lanelet.at()]
    }

    /// The lane of a lanelet, as the value of an attribute.
    pub(in crate::output) fn xml(&self, lanelet: LaneletIndex) -> &str {
        &self.0[1][lanelet.at()]
    }
}

/// Number of lanelets side by side to one side, `most` at most.
fn lanes_beyond(network: &Network, from: LaneletIndex, side: Side, most: usize) -> usize {
    let beside = |it: &LaneletIndex| {
        let lanelet = &network.lanelets[it.at()];
        match side {
            Side::Left => lanelet.left.or(lanelet.adjacent_left),
            Side::Right => lanelet.right.or(lanelet.adjacent_right),
        }
    };
    std::iter::successors(Some(from), beside).take(most).count()
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Motorway, motorway};

    use super::*;

    #[test]
    fn lanes_count_from_the_slow_side_of_an_edge_that_is_named_by_its_smallest_id() {
        let plan = Motorway { lanes: 3, length_m: 300.0, ..Motorway::default() };
        let network = motorway(&plan).unwrap().build().unwrap().network;
        let lanes = Lanes::of(&network);
        let of = |id: i64| {
            let place = network.lanelets.iter().position(|it| it.id == id).unwrap();
            (lanes.name(LaneletIndex(place as u32)), network.lanelets[place].right.is_none())
        };
        // Numbered row by row from the slow lane on.
        assert_eq!([1, 2, 3].map(of), [("1_0", true), ("1_1", false), ("1_2", false)]);
        assert_eq!([4, 5, 6].map(of), [("4_0", true), ("4_1", false), ("4_2", false)]);
    }
}
