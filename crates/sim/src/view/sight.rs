//! What a driver sees along a lane.

use laneweave_models::change::{Flow, anticipated_speed};
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, Crossing, LightState, Place, PlaceKind, Sign};

use crate::junction::need::LINE_TO_ZONE;
use crate::route::walk::Leg;
use crate::state::lane::{Kinematics, VehicleId};
use crate::state::standstill::STANDS;
use crate::view::scene::{Found, REAR_SIGHT, Scene, Spot, Viewpoint};

/// Length of the window of T_h ahead [m].
const WINDOW_AHEAD: f64 = 200.0;
/// Length of the window of T_h behind [m].
const WINDOW_BACK: f64 = 100.0;

/// What a driver sees along a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSight {
    /// The leader, or the end of the lane.
    pub ahead: Option<Ahead>,
    /// The leader's entry.
    pub leader: Option<Spot>,
    /// The follower.
    pub follower: Option<Found>,
    /// Least anticipated speed over the leaders [m/s].
    pub anticipated_speed: f64,
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
    fn add(&mut self, other: &Kinematics) {
        self.count += 1.0;
        self.speeds += other.speed;
        self.lengths += f64::from(other.length);
    }

    /// Means over a window of `extent` [m]. An empty window looks like a free road with the desired speed.
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

impl Scene<'_> {
    /// What a driver sees along a lane. It desires the speed `desired` [m/s] and sees `sight` [m] ahead.
    pub fn look(&self, from: Viewpoint, desired: f64, own_length: f64, sight: f64) -> LaneSight {
        let mut view = View {
            sight,
            window_ahead: WINDOW_AHEAD.min(sight),
            window: Window::default(),
            ahead: None,
            leader: None,
            anticipated_speed: desired,
            line: None,
        };
        let ahead = self.look_ahead(from, desired, &mut view);
        let (follower, back) = self.look_back(from, &mut view.window);
        let View { window, ahead: leader_ahead, leader, anticipated_speed, .. } = view;
        let flow = window.flow(ahead + back, desired, own_length);
        LaneSight { ahead: leader_ahead, leader, follower, anticipated_speed, flow }
    }

    /// Looks ahead; returns the window's extent [m].
    #[inline]
    fn look_ahead(&self, from: Viewpoint, desired: f64, view: &mut View) -> f64 {
        let window_ahead = view.window_ahead;
        let mut walk = self.walk(from).within(view.sight);
        let mut first = from.ahead;
        for Leg { chain, start, .. } in walk.by_ref() {
            let on = self.network.junctions.on(chain);
            if !on.stops.is_empty() || (view.line.is_some() && !on.crossings.is_empty()) {
                self.stop_before_a_junction(&on.places, start, from, desired, view);
            }
            if view.pass(&self.motions(chain)[first..], chain, first, start, from.id, desired) {
                return window_ahead;
            }
            first = 0;
        }
        let end = walk.end();
        if end >= view.sight {
            return window_ahead;
        }
        if self.network.chain(walk.at()).ends_for.has(from.class) {
            let end = Ahead::standing(end);
            view.ahead = view.ahead.or(Some(end));
            view.anticipated_speed = view.anticipated_speed.min(anticipated_speed(end, desired));
        }
        end.clamp(1.0, window_ahead)
    }

    /// Counts a line ahead as a standing leader, for the anticipated speed, if its light is red or if others stand in
    /// the junction behind it. The `places` are those of a chain that starts `base` ahead [m].
    #[inline(never)]
    fn stop_before_a_junction(
        &self,
        places: &[Place],
        base: f64,
        from: Viewpoint,
        desired: f64,
        view: &mut View,
    ) {
        let passed = places.partition_point(|it| base + it.station <= 0.0);
        for place in &places[passed..] {
            let at = base + place.station;
            if at > view.sight {
                return;
            }
            let is_closed = match place.what {
                PlaceKind::Sign(sign) => {
                    view.line = Some(at);
                    matches!(sign, Sign::Light(it) if self.light(it) == LightState::Red)
                }
                PlaceKind::Zone { crossing, touch, .. } => {
                    view.line = view.line.filter(|line| at - line <= LINE_TO_ZONE);
                    touch.concerns(from.class.is_long()) && self.is_occupied(crossing, from.id)
                }
            };
            if let Some(line) = view.line.filter(|_| is_closed) {
                let stopped = anticipated_speed(Ahead::standing(line), desired);
                view.anticipated_speed = view.anticipated_speed.min(stopped);
                return;
            }
        }
    }

    /// Whether another vehicle that stands may pass a crossing before the vehicle `id`, which has no reservation there.
    fn is_occupied(&self, crossing: Crossing, id: VehicleId) -> bool {
        let others = || self.reservations.order(crossing.zone);
        others().any(|(it, other)| it.side != crossing.side && other.speed < STANDS)
            && others().all(|(_, it)| it.vehicle != id)
    }

    /// Looks back; returns the follower and the window's extent [m].
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

    /// Adds the part of the window on the previous chain; returns the window's extent [m].
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

/// What a look ahead collects.
struct View {
    /// Range of sight [m].
    sight: f64,
    /// Length of the window ahead [m].
    window_ahead: f64,
    window: Window,
    ahead: Option<Ahead>,
    leader: Option<Spot>,
    anticipated_speed: f64,
    /// The last place to stop ahead, if a junction may follow [m].
    line: Option<f64>,
}

impl View {
    /// Looks along `motions`. The first of them has the index `first` on `chain`, which starts `base` ahead [m].
    /// Returns whether the range of sight was reached.
    #[inline]
    fn pass(
        &mut self,
        motions: &[Kinematics],
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
            self.anticipated_speed =
                if anticipated < self.anticipated_speed { anticipated } else { self.anticipated_speed };
            if front <= self.window_ahead {
                self.window.add(it);
            }
        }
        false
    }
}
