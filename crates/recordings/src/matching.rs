//! Matching to the map: the lanelet of each vehicle, by its position, its heading, and its path before and after.
//!
//! The most likely path through the lanelets around (Viterbi). A distance from the middle of a lane and an angle to
//! it cost per second. A lane change costs a little. A move without a link costs much.

use laneweave_network::{Lanelet, LaneletIndex, Network, Point, Side, turn};

use crate::lanes::Lanes;
use crate::moves::{Move, Moves};
use crate::presence::Presence;
use crate::recording::{Recording, State, Track};
use crate::smooth;

/// The position of a vehicle's centre in its lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The lanelet.
    pub lanelet: LaneletIndex,
    /// Along its centre line [m].
    pub station: f64,
    /// To the left of its centre line [m].
    pub offset: f64,
}

/// A recording with the position of each vehicle in each frame.
pub struct Matched<'a> {
    /// The roads.
    pub network: &'a Network,
    /// The recording.
    pub recording: &'a Recording,
    /// For each track and each of its states the position; `None` far from all lanelets, and for all road users that
    /// are no vehicles.
    pub places: Vec<Vec<Option<Place>>>,
    pub(crate) moves: Moves,
    presence: Presence,
}

/// A vehicle in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Present<'a> {
    /// The vehicle, through all its frames.
    pub track: &'a Track,
    /// Its state, among those of the track.
    pub state: &'a State,
    /// Its place.
    pub place: Place,
    /// Its acceleration, from the speeds half a second before and after [m/s²].
    pub acceleration: f64,
}

/// A centre further outside of a lane is not in it [m].
const MAXIMUM_OUTSIDE: f64 = 2.0;
/// Lanelets that follow each other may leave a gap of this [m].
const MAXIMUM_BEYOND: f64 = 3.0;
/// A vehicle at a larger angle to a lane does not drive on it [rad].
const MAXIMUM_TURN: f64 = 1.0;
/// An angle to the lane that costs as much as a position on its border [rad].
const TURN: f64 = 0.3;
/// Cost of a lane change; a position on the border costs 1/s. Ours: in a lane of 3.5 m, a change there and back is
/// cheaper from half a second at a decimetre beyond the line.
const ASIDE: f64 = 0.05;
/// Cost of a move to the other lanelet of a fork or a merge.
const OVER: f64 = 0.01;
/// Cost of a move without a link.
const ASTRAY: f64 = 10.0;
/// An acceleration is computed from the speeds this time before and after [s].
const ACCELERATION_REACH: f64 = 0.5;

impl<'a> Matched<'a> {
    /// Number of states of vehicles, and of those far from every lanelet.
    pub fn count_states(&self) -> (usize, usize) {
        let vehicles = self.places.iter().zip(&self.recording.tracks).filter(|(_, it)| it.class.is_vehicle());
        vehicles.fold((0, 0), |(states, unmatched), (places, _)| {
            (states + places.len(), unmatched + places.iter().filter(|it| it.is_none()).count())
        })
    }

    /// Matches the vehicles of `recording` to `network`; both have the same frame.
    pub fn new(network: &'a Network, recording: &'a Recording) -> Matched<'a> {
        let lanes = Lanes::new(&network.lanelets);
        let moves = Moves::new(network, recording.step);
        let matcher = Matcher { lanelets: &network.lanelets, lanes, moves: &moves, step: recording.step };
        let places = recording.tracks.iter().map(|it| matcher.places(it)).collect();
        Matched { network, recording, places, moves, presence: Presence::of(&recording.tracks) }
    }

    /// The tracks that have a state in `frame`, each with the number of that state, in order.
    pub fn present(&self, frame: i64) -> impl Iterator<Item = (usize, usize)> {
        let near = self.presence.near(frame);
        near.filter_map(move |track| Some((track, self.recording.tracks[track].at(frame)?)))
    }

    /// The lanelets beside `lanelet` on a side, whether or not the graph permits changes to them.
    pub fn beside(&self, lanelet: LaneletIndex, side: Side) -> impl Iterator<Item = LaneletIndex> {
        self.moves.beside(lanelet).iter().filter(move |it| it.change.side == side).map(|it| it.lanelet)
    }

    /// The vehicles in `frame` that have a position, by lanelet, in each lanelet from the last to the first in
    /// driving order.
    pub fn frame(&self, frame: i64) -> Vec<Present<'_>> {
        let mut present: Vec<Present<'_>> = Vec::new();
        for (number, at) in self.present(frame) {
            let track = &self.recording.tracks[number];
            let Some(place) = self.places[number][at] else { continue };
            let acceleration =
                smooth::acceleration(&track.states, at, ACCELERATION_REACH, self.recording.step);
            present.push(Present { track, state: &track.states[at], place, acceleration });
        }
        present.sort_by(|a, b| {
            let (a, b) = (a.place, b.place);
            a.lanelet.cmp(&b.lanelet).then(a.station.total_cmp(&b.station))
        });
        present
    }
}

/// The data for matching a track.
struct Matcher<'a> {
    lanelets: &'a [Lanelet],
    lanes: Lanes<'a>,
    moves: &'a Moves,
    step: f64,
}

/// A lanelet in which a state may be.
struct Candidate {
    place: Place,
    /// Cost of this state [1/s].
    rate: f64,
    /// Minimum cost of all paths that end there.
    cost: f64,
    /// The candidate of the state before on that path.
    before: usize,
}

impl Matcher<'_> {
    fn places(&self, track: &Track) -> Vec<Option<Place>> {
        let mut places = vec![None; track.states.len()];
        if !track.class.is_vehicle() {
            return places;
        }
        let mut way: Vec<Vec<Candidate>> = Vec::new();
        for (at, state) in track.states.iter().enumerate() {
            let mut candidates = self.candidates(state);
            if candidates.is_empty() {
                self.settle(&mut way, &mut places[..at]);
                continue;
            }
            if let Some(before) = way.last() {
                let time = smooth::elapsed(&track.states[at - 1], state, self.step);
                candidates.iter_mut().for_each(|it| self.extend(before, it, time));
            }
            way.push(candidates);
        }
        self.settle(&mut way, &mut places);
        places
    }

    /// Writes the cheapest path at the end of `places`, and begins a new one.
    fn settle(&self, way: &mut Vec<Vec<Candidate>>, places: &mut [Option<Place>]) {
        let cheapest = |it: &Vec<Candidate>| (0..it.len()).min_by(|a, b| it[*a].cost.total_cmp(&it[*b].cost));
        let mut at = way.last().and_then(cheapest).unwrap_or(0);
        for (candidates, place) in way.iter().rev().zip(places.iter_mut().rev()) {
            *place = Some(candidates[at].place);
            at = candidates[at].before;
        }
        way.clear();
    }

    /// The lanelets in which the vehicle may be.
    fn candidates(&self, state: &State) -> Vec<Candidate> {
        let point = Point::new(state.x, state.y, 0.0);
        let mut candidates = Vec::new();
        for (index, foot) in self.lanes.around(&point) {
            let lanelet = &self.lanelets[index.at()];
            let half_width = 0.5 * lanelet.width(foot.station);
            let turn = turn(lanelet.centre.heading(foot.station), state.heading);
            // This form also refuses NaN.
            let is_near = foot.offset.abs() <= half_width + MAXIMUM_OUTSIDE && foot.beyond <= MAXIMUM_BEYOND;
            if is_near && turn.abs() <= MAXIMUM_TURN {
                let square = |it: f64| it * it;
                // On the border of two lanes both cost the same, so that a change is found where the line is.
                let rate =
                    square(foot.offset / half_width.max(0.5)) + square(turn / TURN) + square(foot.beyond);
                let place = Place { lanelet: index, station: foot.station, offset: foot.offset };
                candidates.push(Candidate { place, rate, cost: rate * self.step, before: 0 });
            }
        }
        candidates
    }

    /// Finds the cheapest path to `candidate`, which takes `time` [s].
    fn extend(&self, before: &[Candidate], candidate: &mut Candidate, time: f64) {
        let to = candidate.place.lanelet;
        let mut least = f64::INFINITY;
        for (index, from) in before.iter().enumerate() {
            let price = match self.moves.get(from.place.lanelet, from.place.station, to) {
                Some(Move::Along) => 0.0,
                Some(Move::Over) => OVER,
                Some(Move::Aside(_)) => ASIDE,
                None => ASTRAY,
            };
            if from.cost + price < least {
                least = from.cost + price;
                candidate.before = index;
            }
        }
        candidate.cost = least + candidate.rate * time;
    }
}
