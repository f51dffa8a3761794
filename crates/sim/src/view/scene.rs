//! One instant of traffic, simulated or recorded: who is ahead and behind, on any lane, across the ends of chains.

use laneweave_models::Style;
use laneweave_models::change::{Flow, SIGHT, anticipated_speed};
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, LightIndex, LightState, Network, Reach, Sign, Stop};

use crate::junction::passages::{Passage, Passages};
use crate::junction::signals::Signals;
use crate::route::navigate::Navigator;
use crate::state::goal::Destination;
use crate::state::traffic::{Car, Lane, Mind, Motion, VehicleId};
use crate::state::vehicle::LONGEST;

/// One instant of traffic on a network.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The roads.
    pub network: &'a Network,
    /// The ways on them.
    pub navigator: &'a Navigator,
    /// The vehicles, by chain.
    pub lanes: &'a [Lane],
    /// The characters of the drivers.
    pub characters: &'a [Style],
    /// Who may pass the junctions.
    pub passages: &'a Passages,
    /// What the lights show.
    pub signals: &'a Signals,
}

/// An entry in a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// The chain.
    pub chain: ChainIndex,
    /// Its index in the lane.
    pub index: usize,
}

/// Where one looks from: a front bumper on a chain, and whose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// The chain.
    pub chain: ChainIndex,
    /// Front bumper along it [m].
    pub x: f64,
    /// Index of the first entry ahead.
    pub ahead: usize,
    /// The one who looks; its own entries are not seen.
    pub id: VehicleId,
    /// Where it goes.
    pub destination: Destination,
    /// Its vehicle is long.
    pub is_long: bool,
}

/// A vehicle that was found, and how far its front bumper is ahead of, or behind, one's own [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Where it stands.
    pub spot: Spot,
    /// Distance between the front bumpers [m], positive.
    pub distance: f64,
}

/// How far back a follower is looked for [m].
pub(crate) const REAR_SIGHT: f64 = 250.0;
/// T_h window ahead [m].
const WINDOW_AHEAD: f64 = 200.0;
/// T_h window back [m].
const WINDOW_BACK: f64 = 100.0;

/// What one sees along a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSight {
    /// The leader, or the end of the lane.
    pub ahead: Option<Ahead>,
    /// The leader's entry.
    pub leader: Option<Spot>,
    /// The follower.
    pub follower: Option<Found>,
    /// Least anticipated speed over the leaders [m/s].
    pub prospect: f64,
    /// Means over the window.
    pub flow: Flow,
}

/// Sums over a window.
#[derive(Default)]
struct Window {
    count: f64,
    speeds: f64,
    lengths: f64,
}

impl Window {
    #[inline]
    fn add(&mut self, other: &Motion) {
        self.count += 1.0;
        self.speeds += other.speed;
        self.lengths += f64::from(other.length);
    }

    /// Means over a window of `extent` [m]; an empty one looks like a road on which one drives as one likes.
    fn flow(&self, extent: f64, desired: f64, own_length: f64) -> Flow {
        if self.count == 0.0 {
            return Flow { spacing: extent, speed: desired, length: own_length };
        }
        Flow {
            spacing: extent / self.count,
            speed: self.speeds / self.count,
            length: self.lengths / self.count,
        }
    }
}

impl<'a> Scene<'a> {
    /// The vehicles on `chain`, as others see them.
    #[inline]
    pub fn motions(&self, chain: ChainIndex) -> &'a [Motion] {
        self.lanes[chain.at()].motions()
    }

    /// The drivers on `chain`.
    #[inline]
    pub fn cars(&self, chain: ChainIndex) -> &'a [Car] {
        self.lanes[chain.at()].cars()
    }

    /// The warm parts of the drivers on `chain`, the foremost last.
    pub fn minds(&self, chain: ChainIndex) -> &'a [Mind] {
        self.lanes[chain.at()].minds()
    }

    /// What a light shows.
    #[inline]
    pub fn light(&self, light: LightIndex) -> LightState {
        self.signals.shown(light)
    }

    /// Whether the vehicle at `spot` has a passage that leads further than `distance` [m]: nobody may come before it there.
    pub(crate) fn has_passage(&self, spot: Spot, distance: f64) -> bool {
        self.passage(spot).is_some_and(|it| it.left() > distance)
    }

    /// The passage of the vehicle at `spot`.
    #[inline]
    pub(crate) fn passage(&self, spot: Spot) -> Option<&'a Passage> {
        // Who has one heeds it: the mind of others is not worth a look into cold memory.
        let mind = self.car(spot).heeds_more.then(|| self.mind(spot))?;
        self.passages.of(mind.passage, self.motion(spot).id)
    }

    /// How the entry at `spot` moves.
    #[inline]
    pub fn motion(&self, spot: Spot) -> &'a Motion {
        &self.motions(spot.chain)[spot.index]
    }

    /// The hot part of the entry at `spot`.
    #[inline]
    pub fn car(&self, spot: Spot) -> &'a Car {
        &self.cars(spot.chain)[spot.index]
    }

    /// The warm part of the entry at `spot`.
    #[inline]
    pub(crate) fn mind(&self, spot: Spot) -> &'a Mind {
        &self.lanes[spot.chain.at()].minds()[spot.index]
    }

    /// The viewpoint of an entry.
    #[inline]
    pub fn viewpoint(&self, spot: Spot) -> Viewpoint {
        let Motion { x, id, .. } = *self.motion(spot);
        let Car { goal, class, .. } = self.car(spot);
        let (destination, is_long) = (goal.destination(), class.is_long());
        Viewpoint { chain: spot.chain, x, ahead: spot.index + 1, id, destination, is_long }
    }

    /// What who looks `from` would see from `x` on another chain.
    #[inline]
    pub fn viewpoint_at(&self, from: Viewpoint, chain: ChainIndex, x: f64) -> Viewpoint {
        Viewpoint { chain, x, ahead: self.lanes[chain.at()].ahead_of(x), ..from }
    }

    /// The chain on which a driver goes on.
    #[inline]
    pub fn next(&self, destination: Destination, chain: ChainIndex) -> Option<ChainIndex> {
        self.navigator.next(self.network, destination, chain)
    }

    /// The leader within sight.
    #[inline]
    pub fn ahead(&self, from: Viewpoint) -> Option<Ahead> {
        let motions = self.motions(from.chain);
        let on_way = match motions[from.ahead..].iter().find(|it| it.id != from.id) {
            Some(it) => Some(it.ahead(it.rear() - from.x)),
            None => self.ahead_beyond(from),
        };
        let is_in_fork = from.x < self.network.chain(from.chain).fork_clearance;
        if is_in_fork { self.nearest_in_fork(from, on_way) } else { on_way }
    }

    /// The nearer of who is ahead on one's way, and who forked off to another chain before and is still in the way.
    #[inline(never)]
    fn nearest_in_fork(&self, from: Viewpoint, on_way: Option<Ahead>) -> Option<Ahead> {
        let beside = self.beside_in_fork(from);
        nearer(on_way, beside.map(|(spot, rear)| self.rear_ahead(spot, rear - from.x)))
    }

    /// The nearest vehicle ahead that forked off to another chain before and is still in the way, and where its rear bumper is
    /// from the fork on [m].
    fn beside_in_fork(&self, from: Viewpoint) -> Option<(Spot, f64)> {
        let siblings = self.siblings(from.chain);
        nearest(siblings.filter_map(|(back, it)| self.last_in_fork(back, it, from.id, from.x)))
    }

    /// The vehicle at `spot`, whose rear bumper is `gap` ahead [m].
    fn rear_ahead(&self, spot: Spot, gap: f64) -> Ahead {
        self.motion(spot).ahead(gap)
    }

    /// The chains that fork off together with `chain`, each with the one before the fork.
    fn siblings(&self, chain: ChainIndex) -> impl Iterator<Item = (ChainIndex, ChainIndex)> + 'a {
        let network = self.network;
        network.chain(chain).previous.iter().flat_map(move |back| {
            let following = network.chain(*back).following.iter();
            following.filter(move |it| **it != chain).map(move |it| (*back, *it))
        })
    }

    /// The last vehicle beyond `x` that went from `back` to `sibling` and has not parted from the others yet, and where its rear
    /// bumper is from the fork on [m].
    #[inline]
    fn last_in_fork(
        &self,
        back: ChainIndex,
        sibling: ChainIndex,
        id: VehicleId,
        x: f64,
    ) -> Option<(Spot, f64)> {
        let chain = self.network.chain(sibling);
        let last = |on: ChainIndex, came_from: ChainIndex, base: f64| {
            let lane = &self.lanes[on.at()];
            let mut all = lane.motions().iter().zip(lane.minds()).enumerate();
            let is_ahead = |it: &Motion| it.id != id && (base + it.x, id) > (x, it.id);
            let came = |mind: &Mind| mind.trail.last() == Some(came_from);
            let (index, (it, _)) = all.find(|(_, (it, mind))| came(mind) && is_ahead(it))?;
            let rear = base + it.rear();
            (rear < chain.fork_clearance).then_some((Spot { chain: on, index }, rear))
        };
        let own = last(sibling, back, 0.0);
        if chain.length >= chain.fork_clearance + LONGEST {
            return own;
        }
        let hanging = chain.following.iter().filter_map(|it| last(*it, sibling, chain.length));
        nearest(own.into_iter().chain(hanging))
    }

    /// The next vehicle on one's way within sight, or beside it in a fork, wherever it comes from.
    pub(crate) fn leader_spot(&self, from: Viewpoint) -> Option<Spot> {
        let (mut chain, mut index, mut base) = (from.chain, from.ahead, -from.x);
        let is_in_fork = from.x < self.network.chain(chain).fork_clearance;
        let mut beside = if is_in_fork { self.beside_in_fork(from) } else { None };
        loop {
            let motions = &self.motions(chain)[index..];
            let place = motions.iter().position(|it| it.id != from.id);
            let on_way = place.map(|it| (Spot { chain, index: index + it }, motions[it].rear()));
            if let Some((spot, _)) = nearest(on_way.into_iter().chain(beside)) {
                return Some(spot);
            }
            base += self.network.chain(chain).length;
            let next = self.next(from.destination, chain).filter(|_| base < SIGHT)?;
            beside = self.beyond_the_fork(chain, next, from.id);
            (chain, index) = (next, 0);
        }
    }

    /// The last vehicle that forked off from `chain` to another one than `next` and is still in the way, and where its rear
    /// bumper is from the fork on [m].
    fn beyond_the_fork(&self, chain: ChainIndex, next: ChainIndex, id: VehicleId) -> Option<(Spot, f64)> {
        let following = &self.network.chain(chain).following[..];
        if following.len() < 2 {
            return None;
        }
        let siblings = following.iter().filter(|it| **it != next);
        nearest(siblings.filter_map(|it| self.last_in_fork(chain, *it, id, f64::NEG_INFINITY)))
    }

    /// The leader beyond the end of the chain.
    fn ahead_beyond(&self, from: Viewpoint) -> Option<Ahead> {
        let mut chain = from.chain;
        let mut base = self.network.chain(chain).length - from.x;
        while base < SIGHT {
            let next = self.next(from.destination, chain)?;
            let lane = &self.lanes[next.at()];
            let on_way = lane.motions().iter().position(|it| it.id != from.id);
            let leader = on_way.map(|index| {
                let (it, mind) = (&lane.motions()[index], &lane.minds()[index]);
                it.ahead(self.gap_to(chain, base, it, mind))
            });
            let beside = self.beyond_the_fork(chain, next, from.id);
            let beside = beside.map(|(spot, rear)| self.rear_ahead(spot, base + rear));
            if let Some(nearest) = nearer(leader, beside) {
                return Some(nearest);
            }
            chain = next;
            base += self.network.chain(chain).length;
        }
        None
    }

    /// Rear bumper of a vehicle that forked off from `chain` to another one than `next`, is still in the way, and has no
    /// passage out of it, from the fork on [m].
    #[inline]
    pub(crate) fn waits_in_fork(&self, chain: ChainIndex, next: ChainIndex, id: VehicleId) -> Option<f64> {
        let siblings = self.network.chain(chain).following.iter().filter(|it| **it != next);
        siblings.filter_map(|it| self.waits_on(chain, *it, id, f64::NEG_INFINITY)).reduce(f64::min)
    }

    /// The same for who is within the fork itself.
    #[inline]
    pub(crate) fn waits_beside_in_fork(&self, from: Viewpoint) -> Option<f64> {
        let chain = self.network.chain(from.chain);
        if from.x >= chain.fork_clearance {
            return None;
        }
        self.siblings(from.chain)
            .filter_map(|(back, it)| self.waits_on(back, it, from.id, from.x))
            .reduce(f64::min)
    }

    /// Rear bumper of the first vehicle beyond `x` that came from `back` onto `sibling`, if it is in the way of those who
    /// forked off, and no passage leads it out of it [m].
    fn waits_on(&self, back: ChainIndex, sibling: ChainIndex, id: VehicleId, x: f64) -> Option<f64> {
        let lane = &self.lanes[sibling.at()];
        let mut came = lane.motions().iter().zip(lane.minds());
        let is_ahead = |it: &Motion| it.id != id && (it.x, id) > (x, it.id);
        let (other, mind) = came.find(|(it, mind)| is_ahead(it) && mind.trail.last() == Some(back))?;
        let goes_on = self.passages.of(mind.passage, other.id).map_or(0.0, |it| it.left().max(0.0));
        let stays = other.rear() + goes_on < self.network.chain(sibling).fork_clearance;
        stays.then(|| other.rear())
    }

    /// Distance to the vehicle `it`, `base` before the start of the chain that it is on [m]. Whose rear is still on
    /// another way into that chain is in the way from where the ways meet on.
    fn gap_to(&self, chain: ChainIndex, base: f64, it: &Motion, mind: &Mind) -> f64 {
        let gap = base + it.rear();
        if it.rear() >= 0.0 {
            return gap;
        }
        match mind.trail.last() {
            Some(other) if other != chain => {
                let junctions = &self.network.junctions;
                let crossings = junctions.on(chain).crossings.iter();
                let shared = crossings.filter(|it| junctions.other_side(**it).chain == other);
                let merge = shared
                    .map(|it| junctions.reach(*it))
                    .find(|it| it.end >= self.network.chain(chain).length);
                let to_merge = |reach: &Reach| base - self.network.chain(chain).length + reach.start;
                gap.max(merge.map_or(gap, to_merge))
            }
            _ => gap,
        }
    }

    /// The follower within sight.
    pub fn follower(&self, from: Viewpoint) -> Option<Found> {
        let motions = &self.motions(from.chain)[..from.ahead];
        let here = motions.iter().enumerate().rev().find(|(_, it)| it.id != from.id);
        if let Some((index, it)) = here {
            let found = Found { spot: Spot { chain: from.chain, index }, distance: from.x - it.x };
            return (found.distance < REAR_SIGHT).then_some(found);
        }
        let (mut chain, mut base) = (from.chain, from.x);
        while base < REAR_SIGHT {
            let (back, found) = self.last_on_previous(chain, base, from.id)?;
            if let Some(found) = found {
                return (found.distance < REAR_SIGHT).then_some(found);
            }
            chain = back;
            base += self.network.chain(chain).length;
        }
        None
    }

    /// Who is behind the vehicle that was found behind another, `id`, and how far it is behind that one.
    pub(crate) fn next_behind(&self, found: Found, id: VehicleId) -> Option<Found> {
        let from = self.viewpoint(found.spot);
        let next = self.follower(Viewpoint { ahead: found.spot.index, id, ..from })?;
        Some(Found { distance: found.distance + next.distance, ..next })
    }

    /// The foremost vehicle that comes from a previous chain onto `chain`, and the chain to look on from.
    fn last_on_previous(
        &self,
        chain: ChainIndex,
        base: f64,
        id: VehicleId,
    ) -> Option<(ChainIndex, Option<Found>)> {
        let previous = &self.network.chain(chain).previous;
        let mut nearest: Option<(ChainIndex, Option<Found>)> = previous.first().map(|it| (*it, None));
        for back in previous {
            let mut foremost = self.motions(*back).iter().zip(self.cars(*back)).enumerate().rev();
            let comes = |car: &Car| self.next(car.goal.destination(), *back) == Some(chain);
            let found = foremost.find(|(_, (it, car))| it.id != id && comes(car)).map(|(index, (it, _))| {
                let distance = base + self.network.chain(*back).length - it.x;
                Found { spot: Spot { chain: *back, index }, distance }
            });
            let is_nearer = match (&nearest, &found) {
                (Some((_, Some(old))), Some(new)) => new.distance < old.distance,
                (_, Some(_)) => true,
                _ => false,
            };
            if is_nearer {
                nearest = Some((*back, found));
            }
        }
        nearest
    }

    /// All that a driver who wants `desired` [m/s] and sees `sight` [m] ahead sees along the lane it looks at.
    pub fn look(&self, from: Viewpoint, desired: f64, own_length: f64, sight: f64) -> LaneSight {
        let mut view = View {
            sight,
            window_ahead: WINDOW_AHEAD.min(sight),
            window: Window::default(),
            ahead: None,
            leader: None,
            prospect: desired,
        };
        let ahead = self.look_ahead(from, desired, &mut view);
        let (follower, back) = self.look_back(from, &mut view.window);
        let View { window, ahead: leader_ahead, leader, prospect, .. } = view;
        let flow = window.flow(ahead + back, desired, own_length);
        LaneSight { ahead: leader_ahead, leader, follower, prospect, flow }
    }

    /// Looks at what is ahead; returns the window's extent [m].
    #[inline]
    fn look_ahead(&self, from: Viewpoint, desired: f64, view: &mut View) -> f64 {
        let (mut chain, mut index, mut base) = (from.chain, from.ahead, -from.x);
        let window_ahead = view.window_ahead;
        loop {
            let stops = &self.network.junctions.on(chain).stops[..];
            if !stops.is_empty() {
                self.heed_red(stops, base, desired, view);
            }
            if view.pass(&self.motions(chain)[index..], chain, index, base, from.id, desired) {
                return window_ahead;
            }
            base += self.network.chain(chain).length;
            if base > view.sight {
                return window_ahead;
            }
            let Some(next) = self.next(from.destination, chain) else {
                if self.network.chain(chain).is_lane_drop {
                    let end = Ahead::standing(base);
                    view.ahead = view.ahead.or(Some(end));
                    view.prospect = view.prospect.min(anticipated_speed(end, desired));
                }
                return base.clamp(1.0, window_ahead);
            };
            (chain, index) = (next, 0);
        }
    }

    /// The first line ahead at which a light stops drivers counts as a standing leader. The `stops` are those of a chain whose
    /// start is `base` ahead [m].
    #[inline(never)]
    fn heed_red(&self, stops: &[Stop], base: f64, desired: f64, view: &mut View) {
        let is_red = |sign: Sign| matches!(sign, Sign::Light(it) if self.light(it) == LightState::Red);
        let red = stops.iter().find(|it| base + it.station > 0.0 && is_red(it.sign));
        if let Some(line) = red.map(|it| base + it.station).filter(|it| *it <= view.sight) {
            view.prospect = view.prospect.min(anticipated_speed(Ahead::standing(line), desired));
        }
    }

    /// Looks at what is behind; returns the follower and the window's extent [m].
    #[inline]
    fn look_back(&self, from: Viewpoint, window: &mut Window) -> (Option<Found>, f64) {
        let motions = &self.motions(from.chain)[..from.ahead];
        let mut follower = None;
        for (index, it) in motions.iter().enumerate().rev() {
            let distance = from.x - it.x;
            let is_in_window = distance <= WINDOW_BACK;
            if !is_in_window && (follower.is_some() || distance >= REAR_SIGHT) {
                return (follower, WINDOW_BACK);
            }
            if it.id == from.id {
                continue;
            }
            if follower.is_none() {
                follower = Some(Found { spot: Spot { chain: from.chain, index }, distance });
            }
            if is_in_window {
                window.add(it);
            }
        }
        if follower.is_none() {
            follower = self.follower(Viewpoint { ahead: 0, ..from });
        }
        (follower, self.look_back_beyond(from, window))
    }

    /// Looks at the window on the chain before; returns the window's extent [m].
    fn look_back_beyond(&self, from: Viewpoint, window: &mut Window) -> f64 {
        let missing = WINDOW_BACK - from.x;
        let Some(back) = self.network.chain(from.chain).previous.first().filter(|_| missing > 0.0) else {
            return from.x.clamp(0.0, WINDOW_BACK);
        };
        let length = self.network.chain(*back).length;
        let within = self.motions(*back).iter().rev().take_while(|it| length - it.x <= missing);
        within.filter(|it| it.id != from.id).for_each(|it| window.add(it));
        (from.x + length).min(WINDOW_BACK)
    }
}

/// What is gathered while looking ahead.
struct View {
    /// How far one sees [m].
    sight: f64,
    /// How far the window reaches ahead [m].
    window_ahead: f64,
    window: Window,
    ahead: Option<Ahead>,
    leader: Option<Spot>,
    prospect: f64,
}

impl View {
    /// Looks along `motions`, the first of which has the index `first` on `chain`, whose start is `base` ahead [m].
    /// Returns whether the end of sight was reached.
    #[inline]
    fn pass(
        &mut self,
        motions: &[Motion],
        chain: ChainIndex,
        first: usize,
        base: f64,
        id: VehicleId,
        desired: f64,
    ) -> bool {
        for (index, it) in (first..).zip(motions) {
            let front = base + it.x;
            let ahead = it.ahead(front - f64::from(it.length));
            if ahead.gap > self.sight {
                return true;
            }
            if it.id == id {
                continue;
            }
            if self.leader.is_none() {
                self.ahead = Some(ahead);
                self.leader = Some(Spot { chain, index });
            }
            let anticipated = anticipated_speed(ahead, desired);
            self.prospect = if anticipated < self.prospect { anticipated } else { self.prospect };
            if front <= self.window_ahead {
                self.window.add(it);
            }
        }
        false
    }
}

/// The one whose rear bumper is nearest; of those that are as near the first.
#[inline]
fn nearest(rears: impl Iterator<Item = (Spot, f64)>) -> Option<(Spot, f64)> {
    rears.reduce(|nearest, it| if it.1 < nearest.1 { it } else { nearest })
}

/// The nearer of two.
pub(crate) fn nearer(one: Option<Ahead>, other: Option<Ahead>) -> Option<Ahead> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.gap < one.gap { other } else { one }),
        (one, other) => one.or(other),
    }
}
