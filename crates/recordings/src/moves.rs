//! The moves of a vehicle between lanelets within a frame, along the road or sideways.

use laneweave_network::{Lanelet, LaneletIndex, Network, Side};

/// Maximum speed of a vehicle [m/s].
const MAXIMUM_SPEED: f64 = 70.0;
/// Maximum of lanelets that one lanelet reaches within a frame, or forks into; further ones are ignored.
const MAXIMUM_AHEAD: usize = 32;
/// Tolerance at the ends of a stretch on which lanes lie side by side [m].
const MARGIN: f64 = 5.0;

/// The moves between the lanelets of a network.
pub(crate) struct Moves {
    /// For each lanelet the moves from it, ordered by their targets.
    from: Vec<Vec<(LaneletIndex, Move)>>,
    /// For each lanelet what lies beside it.
    beside: Vec<Vec<Neighbour>>,
    /// For each lanelet those that continue it.
    onward: Vec<Vec<LaneletIndex>>,
    /// For each lanelet those that fork off, or merge, with it, in order.
    siblings: Vec<Vec<LaneletIndex>>,
}

/// A move of a vehicle from one lanelet to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Move {
    /// It stays in its lane.
    Along,
    /// It moves to a lanelet that forks off, or merges, with its own: where they overlap they are one lane.
    Over,
    /// It changes lanes.
    Aside(Aside),
}

/// A change of lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aside {
    /// The side.
    pub(crate) side: Side,
    /// Whether the graph permits it.
    pub(crate) along_graph: bool,
    /// Stations of the old lanelet between which it is possible [m].
    pub(crate) stretch: [f64; 2],
}

/// A lanelet beside another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbour {
    pub(crate) lanelet: LaneletIndex,
    pub(crate) change: Aside,
}

impl Moves {
    /// The moves in `step` [s].
    pub(crate) fn new(network: &Network, step: f64) -> Moves {
        let lanelets = &network.lanelets;
        let beside = beside(network);
        let onward = laneweave_network::onward(lanelets);
        let ahead: Vec<Vec<LaneletIndex>> =
            (0..lanelets.len()).map(|it| ahead(lanelets, &onward, it, MAXIMUM_SPEED * step)).collect();
        let from = (0..lanelets.len()).map(|it| moves(it, &ahead, &beside)).collect();
        let siblings = siblings(&onward);
        Moves { from, beside, onward, siblings }
    }

    /// The move from one lanelet, at `station` [m], to another.
    pub(crate) fn get(&self, from: LaneletIndex, station: f64, to: LaneletIndex) -> Option<Move> {
        let moves = &self.from[from.at()];
        let found = moves.binary_search_by_key(&to, |(it, _)| *it).ok().map(|it| moves[it].1);
        let is_possible = |it: &Move| match it {
            Move::Aside(Aside { stretch: [start, end], .. }) => {
                (start - MARGIN..=end + MARGIN).contains(&station)
            }
            Move::Along | Move::Over => true,
        };
        let is_sibling = || self.siblings[from.at()].binary_search(&to).is_ok();
        found.filter(is_possible).or_else(|| is_sibling().then_some(Move::Over))
    }

    /// What lies beside `lanelet`.
    pub(crate) fn beside(&self, lanelet: LaneletIndex) -> &[Neighbour] {
        &self.beside[lanelet.at()]
    }

    /// The lanelets that continue `lanelet`.
    pub(crate) fn onward(&self, lanelet: LaneletIndex) -> &[LaneletIndex] {
        &self.onward[lanelet.at()]
    }
}

/// For each lanelet its neighbours in the graph, then those that merely lie alongside.
fn beside(network: &Network) -> Vec<Vec<Neighbour>> {
    const ANYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
    let known = |lanelet: &Lanelet| {
        let neighbour = |lanelet, side, along_graph| Neighbour {
            lanelet,
            change: Aside { side, along_graph, stretch: ANYWHERE },
        };
        [
            lanelet.left.map(|it| neighbour(it, Side::Left, true)),
            lanelet.right.map(|it| neighbour(it, Side::Right, true)),
            lanelet.adjacent_left.map(|it| neighbour(it, Side::Left, false)),
            lanelet.adjacent_right.map(|it| neighbour(it, Side::Right, false)),
        ]
    };
    let mut all: Vec<Vec<Neighbour>> =
        network.lanelets.iter().map(|it| known(it).into_iter().flatten().collect()).collect();
    for pair in network.alongside() {
        let mut add = |from: LaneletIndex, lanelet, side, stretch: [f64; 2]| {
            match all[from.at()].iter_mut().find(|it| it.lanelet == lanelet) {
                // Several stretches count as one, from the first to the last.
                Some(Neighbour { change: Aside { stretch: [start, end], .. }, .. }) => {
                    (*start, *end) = (start.min(stretch[0]), end.max(stretch[1]));
                }
                None => {
                    let change = Aside { side, along_graph: false, stretch };
                    all[from.at()].push(Neighbour { lanelet, change });
                }
            }
        };
        add(pair.left, pair.right, Side::Right, pair.on_left);
        add(pair.right, pair.left, Side::Left, pair.on_right);
    }
    all
}

/// For each lanelet those that begin or end together with it.
fn siblings(onward: &[Vec<LaneletIndex>]) -> Vec<Vec<LaneletIndex>> {
    let mut previous = vec![Vec::new(); onward.len()];
    for (index, following) in onward.iter().enumerate() {
        for next in following {
            previous[next.at()].push(LaneletIndex(index as u32));
        }
    }
    let mut siblings = vec![Vec::new(); onward.len()];
    for group in onward.iter().chain(&previous).map(|it| &it[..it.len().min(MAXIMUM_AHEAD)]) {
        for one in group {
            siblings[one.at()].extend(group.iter().filter(|it| *it != one));
        }
    }
    for list in &mut siblings {
        list.sort();
        list.dedup();
    }
    siblings
}

/// The lanelet itself and those that follow, as far as their beginnings are within `reach` of its end [m].
fn ahead(lanelets: &[Lanelet], onward: &[Vec<LaneletIndex>], from: usize, reach: f64) -> Vec<LaneletIndex> {
    let mut found = vec![(LaneletIndex(from as u32), 0.0)];
    let mut next = 0;
    while next < found.len() {
        let (lanelet, end) = found[next];
        next += 1;
        for following in &onward[lanelet.at()] {
            let is_new = found.iter().all(|(it, _)| it != following);
            if is_new && end <= reach && found.len() < MAXIMUM_AHEAD {
                found.push((*following, end + lanelets[following.at()].length()));
            }
        }
    }
    found.into_iter().map(|(lanelet, _)| lanelet).collect()
}

/// The moves from a lanelet: straight on, then to the lanelets beside it and their continuations, then to the
/// lanelets beside those that follow.
fn moves(from: usize, ahead: &[Vec<LaneletIndex>], beside: &[Vec<Neighbour>]) -> Vec<(LaneletIndex, Move)> {
    let mut moves: Vec<(LaneletIndex, Move)> = ahead[from].iter().map(|it| (*it, Move::Along)).collect();
    for neighbour in &beside[from] {
        moves.extend(ahead[neighbour.lanelet.at()].iter().map(|it| (*it, Move::Aside(neighbour.change))));
    }
    for following in &ahead[from][1..] {
        for neighbour in &beside[following.at()] {
            // The vehicle crosses beyond the end of the lanelet that it leaves.
            let begins_there = neighbour.change.stretch[0] <= MARGIN;
            let change = Aside { stretch: [f64::NEG_INFINITY, f64::INFINITY], ..neighbour.change };
            moves.extend(begins_there.then_some((neighbour.lanelet, Move::Aside(change))));
        }
    }
    // Stable, so that of several moves to one lanelet the first counts.
    moves.sort_by_key(|(to, _)| *to);
    moves.dedup_by_key(|(to, _)| *to);
    moves
}
