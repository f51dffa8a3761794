//! The flow of one lane: in a stream, of drivers who start from rest, and through a light.

use std::cell::OnceCell;

use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_models::{Style, bends};
use laneweave_network::RoadLaw;
use laneweave_sim::{Class, Fleet, STANDS_BEFORE_A_LINE, STOPS_AT_YELLOW, desired_speed};

/// Vehicles of one class with drivers of one style.
struct Kind<'a> {
    /// Their share of all.
    share: f64,
    style: &'a Style,
    class: Class,
    /// Desired speed [m/s].
    desired: f64,
    /// Gap in a standing queue [m]; computed when a queue needs it.
    standing_gap: OnceCell<f64>,
}

impl Kind<'_> {
    fn standing_gap(&self) -> f64 {
        let standing = Pace::new(0.0, self.desired);
        *self.standing_gap.get_or_init(|| self.style.follow.equilibrium_gap(standing))
    }
}

/// The vehicles on a lane under one limit, by kind.
pub(super) struct Mixture<'a>(Vec<Kind<'a>>);

impl<'a> Mixture<'a> {
    /// The vehicles of `fleet` with `drivers`, each style with its weight, under `limit` [m/s] and `law`.
    pub(super) fn new(limit: f64, drivers: &'a [(Style, f64)], fleet: &Fleet, law: &RoadLaw) -> Mixture<'a> {
        let total: f64 = drivers.iter().map(|(_, weight)| weight).sum();
        let classes = fleet.shares();
        let pairs = drivers.iter().flat_map(|driver| classes.iter().map(move |class| (driver, *class)));
        let all = pairs.map(|((style, weight), (class, share))| Kind {
            share: share * weight / total,
            style,
            class,
            desired: desired_speed(class, style, limit, law),
            standing_gap: OnceCell::new(),
        });
        Mixture(all.filter(|it| it.share > 0.0).collect())
    }

    /// The same in a bend of this `curvature` [1/m]; 0: on a straight lane.
    pub(super) fn in_bend(mut self, curvature: f64) -> Mixture<'a> {
        for kind in
            self.0.iter_mut().filter(|it| curvature > 0.0 && it.style.manner.lateral_acceleration > 0.0)
        {
            let largest = kind.style.manner.lateral_acceleration;
            let squared = bends::speed_squared(largest, kind.class.is_long(), curvature);
            kind.desired = kind.desired.min(squared.sqrt());
        }
        self
    }

    /// The mean of a quantity over all vehicles.
    fn mean(&self, of: impl Fn(&Kind) -> f64) -> f64 {
        self.0.iter().map(|it| it.share * of(it)).sum()
    }

    /// Mean of a function of a vehicle's length [m] and desired speed [m/s].
    pub(super) fn mean_of(&self, of: impl Fn(f64, f64) -> f64) -> f64 {
        self.mean(|it| of(it.class.body().length, it.desired))
    }

    /// The share of long vehicles.
    pub(super) fn share_of_long(&self) -> f64 {
        self.mean(|it| if it.class.is_long() { 1.0 } else { 0.0 })
    }

    /// The mean of the same function over long vehicles; 0 if there are none.
    pub(super) fn mean_of_long(&self, of: impl Fn(f64, f64) -> f64) -> f64 {
        let long = |it: &Kind| if it.class.is_long() { of(it.class.body().length, it.desired) } else { 0.0 };
        let share = self.share_of_long();
        if share > 0.0 { self.mean(long) / share } else { 0.0 }
    }

    /// Mean critical gap of the drivers [s].
    pub(super) fn critical_gap(&self) -> f64 {
        self.mean(|it| it.style.yielding.critical_gap)
    }

    /// Flow of a long queue that drives off on an empty road [veh/s]: the long-term flow of a lane without
    /// overtaking.
    pub(super) fn stream(&self) -> f64 {
        const STEP_S: f64 = 0.2;
        /// The first vehicles of a queue drive off more slowly.
        const LEFT_OUT: usize = 20;
        const COUNTED: usize = 60;
        /// Maximum duration, for very slow vehicles [steps].
        const LONGEST: u32 = 100_000;
        let mut queue = Queue::default();
        (0..LEFT_OUT + COUNTED).for_each(|_| queue.push(self.drawn(0.0, queue.vehicles.len())));
        let mut steps = 0_u32;
        let mut until_passed = |count: usize| {
            while queue.beyond_the_line() < count && steps < LONGEST {
                queue.drive(STEP_S);
                steps += 1;
            }
            f64::from(steps) * STEP_S
        };
        let [from, to] = [LEFT_OUT, LEFT_OUT + COUNTED].map(&mut until_passed);
        COUNTED as f64 / (to - from)
    }

    /// Flow of vehicles that start from rest, each as soon as the one before has left space for it, on an empty road
    /// [veh/s].
    pub(super) fn starts(&self) -> f64 {
        let time = |it: &Kind| {
            let free = Pace::new(0.0, it.desired);
            let acceleration = it.style.follow.acceleration(free, None).min(it.class.strength());
            (2.0 * (it.class.body().length + it.style.follow.jam_gap()) / acceleration).sqrt()
        };
        1.0 / self.mean(time)
    }

    /// Number of vehicles of a standing queue that pass in one green [s] and the yellow after it, mean over queues.
    pub(super) fn pass_at_green(&self, green: f64) -> f64 {
        const QUEUES: u32 = 16;
        let queues = (0..QUEUES).map(|it| self.queue_passes(f64::from(it) / f64::from(QUEUES), green));
        queues.sum::<f64>() / f64::from(QUEUES)
    }

    /// The same for one queue; its kinds are in an even order that begins at a position of their cycle (0 to 1).
    fn queue_passes(&self, from: f64, green: f64) -> f64 {
        const STEP_S: f64 = 0.1;
        let mut queue = Queue::default();
        while queue.may_reach_the_line(green) {
            queue.push(self.drawn(from, queue.vehicles.len()));
        }
        for _ in 0..(green / STEP_S).round() as u32 {
            queue.drive(STEP_S);
        }
        queue.passed()
    }

    /// The kind of the vehicle with this `number` in a queue; its kinds are in an even order that begins at the
    /// position `from` of their cycle (0 to 1).
    fn drawn(&self, from: f64, number: usize) -> &Kind<'a> {
        let mut at = (from + number as f64 * GOLDEN_RATIO).fract();
        let chosen = self.0.iter().position(|it| {
            at -= it.share;
            at < 0.0
        });
        &self.0[chosen.unwrap_or(self.0.len() - 1)]
    }
}

/// Its multiples are evenly spread over the unit interval.
const GOLDEN_RATIO: f64 = 0.618_033_988_749_895;

/// A queue that starts from rest before a line.
#[derive(Default)]
struct Queue<'a> {
    vehicles: Vec<Queued<'a>>,
    /// So many have started.
    started: usize,
}

struct Queued<'a> {
    kind: &'a Kind<'a>,
    /// Front beyond the line [m].
    x: f64,
    speed: f64,
    /// Acceleration of the last step [m/s²].
    acceleration: f64,
}

impl<'a> Queue<'a> {
    /// Position of the next vehicle's front [m].
    fn next(&self) -> f64 {
        self.vehicles.last().map_or(-STANDS_BEFORE_A_LINE, |Queued { kind, x, .. }| {
            x - kind.class.body().length - kind.standing_gap()
        })
    }

    fn push(&mut self, kind: &'a Kind<'a>) {
        self.vehicles.push(Queued { kind, x: self.next(), speed: 0.0, acceleration: 0.0 });
    }

    /// Whether one more vehicle might reach the line in this time [s].
    fn may_reach_the_line(&self, time: f64) -> bool {
        /// Upper bound of the acceleration from rest [m/s²], and lower bound of the headway [s].
        const ACCELERATION: f64 = 5.0;
        const HEADWAY: f64 = 0.5;
        -self.next() < 0.5 * ACCELERATION * time * time && (self.vehicles.len() as f64) < time / HEADWAY + 2.0
    }

    fn drive(&mut self, dt: f64) {
        // The rear bumper of the vehicle before, and the speed that the next driver sees.
        let mut leader: Option<(f64, Ahead)> = None;
        // Who has not started yet does not before the one ahead has.
        let may_move = self.started + 1;
        for Queued { kind, x, speed, acceleration: chosen } in self.vehicles.iter_mut().take(may_move) {
            let ahead = leader.map(|(rear, it)| Ahead { gap: rear - *x, ..it });
            let (gap, rear) = (0.0, *x - kind.class.body().length);
            leader = Some((rear, Ahead { gap, speed: *speed, acceleration: *chosen }));
            let pace = Pace::new(*speed, kind.desired);
            let acceleration = kind.style.follow.acceleration(pace, ahead).min(kind.class.strength());
            *chosen = acceleration;
            let after = (*speed + acceleration * dt).max(0.0);
            *x += 0.5 * (*speed + after) * dt;
            *speed = after;
        }
        let starts = self.vehicles.get(self.started).is_some_and(|it| it.speed > 0.0);
        self.started += usize::from(starts);
    }

    fn beyond_the_line(&self) -> usize {
        self.vehicles.iter().filter(|it| it.x > 0.0).count()
    }

    /// Vehicles that are beyond the line, or too near and too fast to stop before it.
    fn passed(&self) -> f64 {
        let goes = |it: &&Queued| it.x > 0.0 || it.speed * it.speed > 2.0 * STOPS_AT_YELLOW * -it.x;
        self.vehicles.iter().filter(goes).count() as f64
    }
}
