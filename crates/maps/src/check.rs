//! Checks for what is suspicious about a network although it can be used: one function for each check.

use std::f64::consts::TAU;

use laneweave_network::{Alongside, Id, Lanelet, LaneletIndex, Network, Polyline, Pose};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::problem::Problem;

/// Lanelets whose ends are nearer than this were probably meant to meet [m].
const NEARLY: f64 = 1.5;
/// Directions that differ by less than this continue each other [rad].
const STRAIGHT_ON: f64 = 0.5;

/// Lanelets of a fork or a merge that run beside each other for a smaller share of their length are no problem.
const SIDE_BY_SIDE: f64 = 0.6;

/// All that is suspicious.
pub fn check(network: &Network) -> Vec<Problem> {
    let mut problems = broken_joints(network);
    problems.extend(double_borders(network));
    problems
}

/// Lanelets that run side by side along borders of their own, so that no vehicle can change between them. Where lanes
/// part or come together, this is usual for a while.
fn double_borders(network: &Network) -> impl Iterator<Item = Problem> {
    let mut previous: Vec<Vec<LaneletIndex>> = vec![Vec::new(); network.lanelets.len()];
    for (lanelet, index) in network.lanelets.iter().zip(0..) {
        lanelet.following.iter().for_each(|it| previous[it.at()].push(LaneletIndex(index)));
    }
    let parts_or_meets = move |it: &Alongside| {
        let [left, right] = [it.left, it.right].map(|it| &network.lanelets[it.at()]);
        let share = (it.on_left[1] - it.on_left[0]) / left.length().min(right.length());
        share < SIDE_BY_SIDE
            && (are_together(network, &left.following, &right.following)
                || are_together(network, &previous[it.left.at()], &previous[it.right.at()]))
    };
    network.alongside().into_iter().filter(move |it| !parts_or_meets(it)).map(|it| {
        let id = |lanelet: LaneletIndex| network.lanelets[lanelet.at()].id;
        let length = it.on_left[1] - it.on_left[0];
        Problem {
            element: format!("lanelet {}", id(it.left)),
            line: None,
            what: format!(
                "lanelet {} lies beside it on the right for {length:.0} m, but they share no border, so lane changes between them \
                 are impossible",
                id(it.right)
            ),
            remedy: "use the same way as border of both, or keep it if there is a kerb".into(),
        }
    })
}

/// Whether one of the lanelets on the left is one of those on the right, or its neighbour.
fn are_together(network: &Network, left: &[LaneletIndex], right: &[LaneletIndex]) -> bool {
    left.iter().any(|it| {
        let Lanelet { right: beside, adjacent_right, .. } = &network.lanelets[it.at()];
        right.contains(it) || [beside, adjacent_right].into_iter().flatten().any(|it| right.contains(it))
    })
}

/// Lanelets that begin, or end, just where another one ends, or begins, but are joined neither to it nor to anything
/// else.
fn broken_joints(network: &Network) -> Vec<Problem> {
    let lanelets = &network.lanelets;
    let mut has_previous = vec![false; lanelets.len()];
    lanelets.iter().flat_map(|it| &it.following).for_each(|it| has_previous[it.at()] = true);
    let begins = Joints::of(lanelets, |it| first(&it.centre));
    let ends = Joints::of(lanelets, |it| last(&it.centre));
    let mut problems = Vec::new();
    for (lanelet, has_previous) in lanelets.iter().zip(has_previous) {
        let mut note = |what: String| {
            problems.push(Problem {
                element: format!("lanelet {}", lanelet.id),
                line: None,
                what,
                remedy: "connect the last points of the borders of the first with the first points of the borders of the second"
                    .into(),
            });
        };
        let next = begins.nearest(last(&lanelet.centre), lanelet);
        if let Some((next, distance)) = next.filter(|_| lanelet.following.is_empty()) {
            note(format!(
                "it ends {distance:.2} m from where lanelet {next} begins, but shares no points with it, so it leads nowhere"
            ));
        }
        let previous = ends.nearest(first(&lanelet.centre), lanelet);
        if let Some((previous, distance)) = previous.filter(|_| !has_previous) {
            note(format!(
                "it begins {distance:.2} m from where lanelet {previous} ends, and nothing leads there"
            ));
        }
    }
    problems
}

/// Where lanelets begin, or where they end.
struct Joints<'a> {
    lanelets: &'a [Lanelet],
    poses: Vec<Pose>,
    index: RTree<GeomWithData<[f64; 2], u32>>,
}

impl<'a> Joints<'a> {
    fn of(lanelets: &'a [Lanelet], pose: impl Fn(&Lanelet) -> Pose) -> Joints<'a> {
        let poses: Vec<Pose> = lanelets.iter().map(pose).collect();
        let points = poses.iter().zip(0..).map(|(it, index)| GeomWithData::new([it.at.x, it.at.y], index));
        Joints { lanelets, index: RTree::bulk_load(points.collect()), poses }
    }

    /// The lanelet other than `own` whose joint is nearest to `pose` and points the same way, and how far it is [m].
    fn nearest(&self, pose: Pose, own: &Lanelet) -> Option<(Id, f64)> {
        let near = self.index.locate_within_distance([pose.at.x, pose.at.y], NEARLY * NEARLY);
        let found = near.filter_map(|it| {
            let (other, joint) = (&self.lanelets[it.data as usize], self.poses[it.data as usize]);
            let goes_on = other.id != own.id && turn(pose, joint) < STRAIGHT_ON;
            goes_on.then(|| (other.id, joint.at.distance(&pose.at)))
        });
        found.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
    }
}

/// Difference of two directions [rad].
fn turn(a: Pose, b: Pose) -> f64 {
    let turn = (a.heading - b.heading).rem_euclid(TAU);
    turn.min(TAU - turn)
}

fn first(line: &Polyline) -> Pose {
    Pose { at: line.at(0.0), heading: line.heading(0.0) }
}

fn last(line: &Polyline) -> Pose {
    Pose { at: line.at(line.length()), heading: line.heading(line.length()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, lanelet2};

    /// Two lanelets one behind the other, of which the second one begins at `x`, with points of its own.
    fn row(x: f64) -> Vec<String> {
        let mut text = String::from("<osm>");
        for (id, (x, y)) in
            [(0.0, 0.0), (50.0, 0.0), (0.0, 3.0), (50.0, 3.0), (x, 0.0), (99.0, 0.0), (x, 3.0), (99.0, 3.0)]
                .into_iter()
                .enumerate()
        {
            text += &format!("<node id='{}' x='{x}' y='{y}'/>", id + 1);
        }
        for (id, [from, to]) in [(11, [1, 2]), (12, [3, 4]), (13, [5, 6]), (14, [7, 8])] {
            text += &format!("<way id='{id}'><nd ref='{from}'/><nd ref='{to}'/></way>");
        }
        for (id, right) in [(21, 11), (22, 13)] {
            text += &format!(
                "<relation id='{id}'><member type='way' ref='{}' role='left'/><member type='way' ref='{right}' \
                 role='right'/><tag k='type' v='lanelet'/></relation>",
                right + 1
            );
        }
        let map = lanelet2::read((text + "</osm>").as_bytes(), &ReadOptions::default()).unwrap();
        check(&map.network).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn lanelets_that_nearly_meet_are_suspicious() {
        let found = row(50.25);
        assert_eq!(found.len(), 2);
        assert!(found[0].starts_with(
            "lanelet 21: it ends 0.25 m from where lanelet 22 begins, but shares no points with it"
        ));
        assert!(found[1].starts_with("lanelet 22: it begins 0.25 m from where lanelet 21 ends"));
        assert!(row(52.0).is_empty());
    }
}
