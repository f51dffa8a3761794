//! Which lanelets follow each other, and which lie side by side: the links of the file, checked.

use std::collections::{HashMap, HashSet};

use laneweave_network::{Lanelet, LaneletIndex, Polyline, Side};

use super::element::LaneletElement;
use crate::drawing::Crossing;
use crate::problem::Problem;

/// Lanelets whose common ends or bounds lie further apart do not touch [m]: more than the width of lanes, because
/// neighbours may part at a fork of the road.
const MAXIMUM_GAP: f64 = 20.0;

/// Maximum of lanelets that follow one, or that it follows: what is built from links grows quadratically.
const MAXIMUM_SHARING: usize = 32;

/// The index in the network of each id of the file; none if its lanelet was left out.
pub(super) type Places = HashMap<i64, Option<LaneletIndex>>;

/// Fills in the links of `lanelets`, which belong to `elements` in the same order.
///
/// Successors follow if they lie where the lanelet ends. Lanelets are neighbours if they name each other and lie side
/// by side; the marking decides whether a change is allowed between them ([`may_cross`]).
pub(super) fn connect(
    elements: &[&LaneletElement],
    places: &Places,
    lanelets: &mut [Lanelet],
    problems: &mut Vec<Problem>,
) {
    let links = Links::of(elements, places);
    let mut previous = vec![0; lanelets.len()];
    for (index, element) in elements.iter().enumerate() {
        let here = LaneletIndex(index as u32);
        problems.extend(missing(element, places));
        problems.extend(links.one_sided(element, here, places));
        lanelets[index].following = following(element, here, places, lanelets, &mut previous, problems);
        for side in Side::BOTH {
            let Some(there) = beside(element, here, side, elements, places, problems) else { continue };
            if !touch_sideways(&lanelets[index], &lanelets[there.at()], side) {
                let what = format!("its neighbour {} is not adjacent to it", elements[there.at()].id);
                problems.push(element.problem(what, "give one that shares a bound with it"));
                continue;
            }
            let lanelet = &mut lanelets[index];
            let (open, closed) = match side {
                Side::Left => (&mut lanelet.left, &mut lanelet.adjacent_left),
                Side::Right => (&mut lanelet.right, &mut lanelet.adjacent_right),
            };
            let may_cross = may_cross(element, elements[there.at()], side);
            *(if may_cross { open } else { closed }) = Some(there);
        }
    }
}

/// Links that both of their ends name, each from the lanelet behind to the one ahead.
struct Links {
    by_successor: HashSet<(LaneletIndex, LaneletIndex)>,
    by_predecessor: HashSet<(LaneletIndex, LaneletIndex)>,
}

impl Links {
    fn of(elements: &[&LaneletElement], places: &Places) -> Links {
        let mut links = Links { by_successor: HashSet::new(), by_predecessor: HashSet::new() };
        for (index, element) in elements.iter().enumerate() {
            let here = LaneletIndex(index as u32);
            links.by_successor.extend(present(&element.successors, places).map(|it| (here, it)));
            links.by_predecessor.extend(present(&element.predecessors, places).map(|it| (it, here)));
        }
        links
    }

    /// The problem if `element` and the lanelets that it names do not agree.
    fn one_sided(&self, element: &LaneletElement, here: LaneletIndex, places: &Places) -> Vec<Problem> {
        let ahead = element
            .successors
            .iter()
            .filter(|id| place(**id, places).is_some_and(|it| !self.by_predecessor.contains(&(here, it))));
        let behind = element
            .predecessors
            .iter()
            .filter(|id| place(**id, places).is_some_and(|it| !self.by_successor.contains(&(it, here))));
        let ahead = listed("successor", ahead).map(|it| {
            let what = format!("its {it} does not name it as a predecessor; the successor link is used");
            element.problem(what, "add the predecessor there, or remove the successor here")
        });
        let behind = listed("predecessor", behind).map(|it| {
            let what = format!("its {it} does not name it as a successor, so they are not connected");
            element.problem(what, "add the successor there, or remove the predecessor here")
        });
        ahead.into_iter().chain(behind).collect()
    }
}

fn place(id: i64, places: &Places) -> Option<LaneletIndex> {
    places.get(&id).copied().flatten()
}

fn present(ids: &[i64], places: &Places) -> impl Iterator<Item = LaneletIndex> {
    ids.iter().filter_map(|id| place(*id, places))
}

/// The first of some ids, and the number of the others.
fn listed<'a>(kind: &str, mut ids: impl Iterator<Item = &'a i64>) -> Option<String> {
    let first = ids.next()?;
    Some(match ids.count() {
        0 => format!("{kind} {first}"),
        more => format!("{kind} {first} (and {more} more)"),
    })
}

/// The problem if lanelets that `element` names are not in the file.
fn missing(element: &LaneletElement, places: &Places) -> Option<Problem> {
    let beside = Side::BOTH.into_iter().filter_map(|side| element.adjacent(side)).map(|it| it.id);
    let named: Vec<i64> =
        element.predecessors.iter().chain(&element.successors).copied().chain(beside).collect();
    let list = listed("lanelet", named.iter().filter(|id| !places.contains_key(id)))?;
    let what = format!("it refers to {list}, which is missing");
    Some(element.problem(what, "add the lanelet, or remove the reference"))
}

/// The successors of `element` that lie where it ends; `previous` counts the lanelets that lead to each.
fn following(
    element: &LaneletElement,
    here: LaneletIndex,
    places: &Places,
    lanelets: &[Lanelet],
    previous: &mut [usize],
    problems: &mut Vec<Problem>,
) -> Vec<LaneletIndex> {
    let mut following = Vec::new();
    let (mut elsewhere, mut too_many) = (Vec::new(), Vec::new());
    for id in &element.successors {
        let Some(next) = place(*id, places).filter(|it| !following.contains(it)) else { continue };
        if !touch_lengthways(&lanelets[here.at()], &lanelets[next.at()]) {
            elsewhere.push(*id);
        } else if following.len() >= MAXIMUM_SHARING || previous[next.at()] >= MAXIMUM_SHARING {
            too_many.push(*id);
        } else {
            previous[next.at()] += 1;
            following.push(next);
        }
    }
    problems.extend(listed("successor", elsewhere.iter()).map(|it| {
        let what = format!("its {it} begins elsewhere, so they are not connected");
        element.problem(what, "give lanelets that begin where it ends")
    }));
    problems.extend(listed("successor", too_many.iter()).map(|it| {
        let what = format!(
            "its {it} is not connected: {MAXIMUM_SHARING} other lanelets already fork or merge there"
        );
        element.problem(what, "delete lanelets that were drawn twice")
    }));
    following
}

fn touch_lengthways(behind: &Lanelet, ahead: &Lanelet) -> bool {
    let gap = |behind: &Polyline, ahead: &Polyline| behind.at(behind.length()).distance(&ahead.at(0.0));
    let left = gap(&behind.left_border, &ahead.left_border);
    left.max(gap(&behind.right_border, &ahead.right_border)) <= MAXIMUM_GAP
}

fn touch_sideways(lanelet: &Lanelet, other: &Lanelet, side: Side) -> bool {
    let (mine, theirs) = match side {
        Side::Left => (&lanelet.left_border, &other.right_border),
        Side::Right => (&lanelet.right_border, &other.left_border),
    };
    let starts = mine.at(0.0).distance(&theirs.at(0.0));
    let ends = mine.at(mine.length()).distance(&theirs.at(theirs.length()));
    starts.max(ends) <= MAXIMUM_GAP
}

/// The neighbour of `element` on `side` that runs in the same direction, if both agree.
fn beside(
    element: &LaneletElement,
    here: LaneletIndex,
    side: Side,
    elements: &[&LaneletElement],
    places: &Places,
    problems: &mut Vec<Problem>,
) -> Option<LaneletIndex> {
    let adjacent = element.adjacent(side)?;
    let there = place(adjacent.id, places)?;
    // For an oncoming lanelet, its left is also on our left.
    let back_side = if adjacent.same_direction { side.opposite() } else { side };
    let back = elements[there.at()].adjacent(back_side);
    let agrees = back.is_some_and(|it| it.id == element.id && it.same_direction == adjacent.same_direction);
    if !agrees || there == here {
        let what =
            format!("its neighbour {} does not name it in return, so they are not neighbours", adjacent.id);
        problems.push(element.problem(what, "make neighbours name each other, with the same drivingDir"));
        return None;
    }
    adjacent.same_direction.then_some(there)
}

/// Whether a driver on `element` may cross to `other` on `side`.
///
/// The line between them belongs to both. The marking of the own bound counts; where it is not known, that of
/// the neighbour's bound; where neither is, the line may be crossed.
fn may_cross(element: &LaneletElement, other: &LaneletElement, side: Side) -> bool {
    let known = element.bound(side).crossing.or(other.bound(side.opposite()).crossing);
    let crossing = known.unwrap_or(Crossing::BOTH_WAYS);
    match side {
        Side::Left => crossing.to_left,
        Side::Right => crossing.to_right,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::commonroad::element::Bound;

    #[test]
    fn the_own_bound_counts_before_the_neighbours() {
        let (never, dashed) = (Some(Crossing::NEVER), Some(Crossing::BOTH_WAYS));
        let half = Some(Crossing { to_left: false, to_right: true });
        let allowed = |mine, theirs, side| {
            let bound = |crossing| Bound { crossing, ..Bound::default() };
            let element =
                LaneletElement { left: bound(mine), right: bound(mine), ..LaneletElement::default() };
            let other =
                LaneletElement { left: bound(theirs), right: bound(theirs), ..LaneletElement::default() };
            may_cross(&element, &other, side)
        };
        for side in Side::BOTH {
            assert!(allowed(None, None, side));
            assert!(!allowed(None, never, side) && !allowed(never, None, side));
            assert!(allowed(dashed, never, side) && !allowed(never, dashed, side));
        }
        assert!(!allowed(half, None, Side::Left) && allowed(half, None, Side::Right));
    }

    #[test]
    fn ids_are_listed_by_the_first() {
        assert_eq!(listed("successor", [].iter()), None);
        assert_eq!(listed("successor", [4].iter()).as_deref(), Some("successor 4"));
        assert_eq!(listed("successor", [4, 5, 6].iter()).as_deref(), Some("successor 4 (and 2 more)"));
    }
}
