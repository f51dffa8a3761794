//! An independent computation of a driver's decision on a straight road: from a plain list of all vehicles, with the
//! formulas of the book, without code of the program.

use laneweave::models::change::IncentiveName::{self, Comfort, Courtesy, Keeping, Route, Speed, Urgency};
use laneweave::models::change::{LaneChangeModel, Mcdm, Refusal, Safety};
use laneweave::models::follow::FollowingModel;
use laneweave::network::Side;
use laneweave_sim::{Phase, World};

/// A vehicle in a lane. A vehicle between two lanes stands in both.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    pub(crate) id: u32,
    lane: u32,
    x: f64,
    speed: f64,
    length: f64,
    desired: f64,
    headway_relaxation: f64,
    acceleration: f64,
    parameters: usize,
    wants: Option<Side>,
    urgency: f64,
}

/// Changes of the situation that the driver sees.
#[derive(Clone, Copy, Default)]
pub(crate) struct Otherwise {
    /// Added to the anticipated speed of the own lane, of the left and of the right lane [m/s].
    pub(crate) here: f64,
    pub(crate) there: [f64; 2],
    /// Added to the gaps ahead and behind [m].
    pub(crate) gaps: [f64; 2],
    /// Added to the speeds of driver, new leader and new follower [m/s].
    pub(crate) speeds: [f64; 3],
}

/// The result for a side.
#[derive(Debug)]
pub(crate) struct Weighed {
    pub(crate) side: Side,
    pub(crate) yields: [(IncentiveName, f64); 6],
    pub(crate) gain: f64,
}

/// A straight motorway whose lane 0 is the slow one, with traffic on the right.
pub(crate) struct Twin<'a> {
    world: &'a World,
    lanes: u32,
    length: f64,
    bodies: Vec<Body>,
}

/// The vehicles ahead and behind in a lane.
struct Around {
    ahead: Option<(Body, f64)>,
    behind: Option<(Body, f64)>,
    anticipated_speed: f64,
    /// Mean spacing, speed and length.
    flow: [f64; 3],
}

impl<'a> Twin<'a> {
    pub(crate) fn of(world: &'a World) -> Twin<'a> {
        let mut bodies = Vec::new();
        for it in world.vehicles() {
            let body = Body {
                id: it.id(),
                lane: it.spot.chain.0,
                x: it.x(),
                speed: it.speed(),
                length: f64::from(it.motion.length),
                desired: f64::from(it.driver.desired),
                headway_relaxation: f64::from(it.motion.headway_relaxation),
                acceleration: f64::from(it.motion.acceleration),
                parameters: it.driver.parameters as usize,
                wants: (it.driver.phase == Phase::Wants).then_some(it.lane_change.side),
                urgency: f64::from(it.lane_change.urgency),
            };
            bodies.push(body);
            bodies.extend(it.lane_change.counterpart.map(|twin| Body {
                lane: twin.chain.0,
                x: twin.x,
                ..body
            }));
        }
        let chains = &world.network().chains;
        Twin { world, lanes: chains.len() as u32, length: chains[0].length, bodies }
    }

    /// The vehicle with this name, in the lane of its centre.
    pub(crate) fn me(&self, id: u32) -> Body {
        *self.bodies.iter().find(|it| it.id == id).expect("it is on the road")
    }

    fn beside(&self, lane: u32, side: Side) -> Option<u32> {
        match side {
            Side::Left => Some(lane + 1).filter(|it| *it < self.lanes),
            Side::Right => lane.checked_sub(1),
        }
    }

    fn others(&self, me: &Body, lane: u32) -> impl Iterator<Item = &Body> {
        let id = me.id;
        self.bodies.iter().filter(move |it| it.lane == lane && it.id != id)
    }

    fn around(&self, me: &Body, lane: u32) -> Around {
        let ahead: Vec<&Body> = self.others(me, lane).filter(|it| it.x > me.x).collect();
        let gap = |it: &Body| it.x - it.length - me.x;
        // No driver looks past the first vehicle that is more than 295 m away.
        let nearest_first = {
            let mut all = ahead.clone();
            all.sort_by(|a, b| a.x.total_cmp(&b.x));
            all
        };
        let seen: Vec<&Body> = nearest_first.into_iter().take_while(|it| gap(it) <= 295.0).collect();
        let anticipated = |it: &&Body| {
            let share = (gap(it) / 295.0).clamp(0.0, 1.0);
            if it.speed >= me.desired { me.desired } else { (1.0 - share) * it.speed + share * me.desired }
        };
        let anticipated_speed = seen.iter().map(anticipated).fold(me.desired, f64::min);
        let behind = self.others(me, lane).filter(|it| it.x <= me.x && me.x - it.x < 250.0);
        let behind = behind.max_by(|a, b| a.x.total_cmp(&b.x));
        let in_window = |it: &&Body| {
            (it.x > me.x && it.x - me.x <= 200.0 && gap(it) <= 295.0)
                || (it.x <= me.x && me.x - it.x <= 100.0)
        };
        let window: Vec<&Body> = self.others(me, lane).filter(in_window).collect();
        let far = seen.len() < ahead.len() || self.length - me.x > 295.0;
        let extent_ahead = if far { 200.0 } else { (self.length - me.x).clamp(1.0, 200.0) };
        let extent = extent_ahead + me.x.clamp(0.0, 100.0);
        let count = window.len() as f64;
        let mean = |of: fn(&Body) -> f64| window.iter().map(|it| of(it)).sum::<f64>() / count;
        let flow = if window.is_empty() {
            [extent, me.desired, me.length]
        } else {
            [extent / count, mean(|it| it.speed), mean(|it| it.length)]
        };
        Around {
            ahead: seen.first().map(|it| (**it, gap(it))),
            behind: behind.map(|it| (*it, me.x - it.x - me.length)),
            anticipated_speed,
            flow,
        }
    }

    /// Acceleration of `body` behind a leader with this gap and speed.
    fn acceleration(&self, body: &Body, ahead: Option<(f64, f64)>) -> f64 {
        let (v, v0) = (body.speed, body.desired);
        match &self.world.driver_parameters()[body.parameters].follow {
            FollowingModel::IdmPlus(it) => {
                let interaction = ahead.map_or(0.0, |(gap, leader)| {
                    let time_gap = (it.time_gap * body.headway_relaxation).max(it.time_gap.min(0.5));
                    let braking = v * (v - leader) / (2.0 * (it.acceleration * it.deceleration).sqrt());
                    let desired = it.jam_gap + (v * time_gap + braking).max(0.0);
                    (desired / gap.max(0.1)).powi(2)
                });
                it.acceleration * (1.0 - (v / v0).powf(it.exponent)).min(1.0 - interaction)
            }
            FollowingModel::Fvdm(fvdm) => {
                let closing = ahead.map_or(0.0, |(_, leader)| (v - leader).max(0.0));
                let headway_relaxation = if body.headway_relaxation < 1.0 {
                    body.headway_relaxation + (1.0 - body.headway_relaxation) * (closing / 5.0).min(1.0)
                } else {
                    body.headway_relaxation
                };
                let (c1, c2) = (0.13, 1.57_f64);
                let gap = ahead.map_or(f64::INFINITY, |(gap, _)| {
                    (gap / headway_relaxation - fvdm.jam_gap / headway_relaxation).max(0.0)
                });
                let scale = v0 * fvdm.length_scale / 14.66;
                let rise = (c1 * gap / scale - c2).tanh() + c2.tanh();
                let optimal = (v0 * rise / (1.0 + c2.tanh())).max(0.0);
                let relative = match ahead {
                    Some((gap, leader)) if gap <= fvdm.range * scale => leader.min(v0) - v,
                    _ => 0.0,
                };
                fvdm.sensitivity * (optimal - v) + fvdm.relative_sensitivity * relative
            }
            other => panic!("{other:?} has no twin"),
        }
    }

    /// The gain of desired speed of `body` in a second, with one leader instead of another.
    fn share(&self, body: &Body, now: Option<(f64, f64)>, then: Option<(f64, f64)>) -> f64 {
        let expected = |ahead| (body.speed + self.acceleration(body, ahead)).clamp(0.0, body.desired);
        let short = |speed: f64| (speed - body.desired).abs();
        (short(expected(now)) - short(expected(then))) / body.desired
    }

    fn courtesy(&self, me: &Body, side: Side, here: &Around, there: &Around) -> f64 {
        let of = |(it, gap): (Body, f64)| (gap, it.speed);
        let harm = there.behind.map_or(0.0, |(it, gap)| {
            let without = there.ahead.map(|(ahead, further)| (gap + me.length + further, ahead.speed));
            self.share(&it, without, Some((gap, me.speed)))
        });
        let in_the_way = me.speed < here.flow[1];
        let relief = here.behind.filter(|_| in_the_way).map_or(0.0, |(it, gap)| {
            let without = here.ahead.map(|(ahead, further)| (gap + me.length + further, ahead.speed));
            self.share(&it, Some((gap, me.speed)), without)
        });
        // Vehicles that signal a change into this lane: on the other side the one behind, or else the one ahead; on
        // this side the new leader.
        let across = self.beside(me.lane, side.opposite()).map(|lane| self.around(me, lane));
        let room = |it: Body| {
            let forward = it.x - me.x;
            let is_next = if forward > 0.0 {
                here.ahead.is_none_or(|(_, gap)| gap > forward)
            } else {
                here.behind.is_none_or(|(_, gap)| gap + me.length > -forward)
            };
            let lane_of_mine = it.wants.and_then(|side| self.beside(it.lane, side));
            if !is_next || lane_of_mine != Some(me.lane) {
                return None;
            }
            let gap = -forward - me.length;
            let blocked =
                if gap > 0.0 { Some((gap, me.speed)) } else { self.around(&it, it.lane).ahead.map(of) };
            let freed = here.ahead.map(|(ahead, gap)| (gap - forward, ahead.speed));
            Some((1.0 + it.urgency) * self.share(&it, blocked, freed))
        };
        let signals = |it: &Body| it.wants.is_some();
        let from_across = across.and_then(|it| {
            let behind = it.behind.map(|(it, _)| it).filter(signals).and_then(room);
            behind.or_else(|| it.ahead.map(|(it, _)| it).filter(signals).and_then(room))
        });
        let from_there = there.ahead.map(|(it, _)| it).filter(signals).and_then(room);
        harm + relief + from_across.unwrap_or(0.0) + from_there.unwrap_or(0.0)
    }

    /// Both sides for the driver of `id`, the left one first.
    pub(crate) fn weigh(&self, id: u32, otherwise: Otherwise) -> Vec<Weighed> {
        let me = self.me(id);
        let model = mcdm(&self.world.driver_parameters()[me.parameters].change);
        let here = self.around(&me, me.lane);
        let speed_here = here.anticipated_speed + otherwise.here;
        let both = [Side::Left, Side::Right].into_iter().zip(otherwise.there);
        both.filter_map(|(side, more)| {
            let there = self.around(&me, self.beside(me.lane, side)?);
            let speed_there = there.anticipated_speed + more;
            // Nobody counts on passing on the right of a slower leader in the left lane who is faster than 60 km/h.
            let on_the_left = if side == Side::Left { there.ahead } else { here.ahead };
            let is_bound = |(it, _): (Body, f64)| me.speed > it.speed && it.speed > 60.0 / 3.6;
            let least =
                if on_the_left.is_some_and(is_bound) { speed_here.min(speed_there) } else { f64::INFINITY };
            let [speed_here, speed_there] = match side {
                Side::Left => [speed_here.min(least), speed_there],
                Side::Right => [speed_here, speed_there.min(least)],
            };
            let stays = |ahead: Option<(Body, f64)>| {
                let slower = ahead.filter(|(it, _)| it.speed < me.desired);
                slower.map_or(1.0, |(it, gap)| (gap / (me.desired - it.speed) / 20.0).clamp(0.0, 1.0).powi(2))
            };
            let time = |speed: f64| 295.0 / speed.max(1.0);
            let [spacing, speed, length] = there.flow;
            let headway = (spacing - length - 2.0).max(0.0) / speed.max(2.0);
            let yields = [
                (Speed, (speed_there - speed_here) / me.desired),
                (Route, ((time(speed_here) - time(speed_there)) / 60.0).clamp(-10.0, 10.0)),
                (Comfort, -headway.max(0.3).powf(-model.comfort.beta)),
                (Courtesy, self.courtesy(&me, side, &here, &there)),
                (Urgency, 0.0),
                (Keeping, if side == Side::Right { stays(there.ahead) } else { -stays(here.ahead) }),
            ];
            let gain = yields.iter().map(|(name, it)| model.weight(*name) * it).sum();
            Some(Weighed { side, yields, gain })
        })
        .collect()
    }

    /// The desired side for the random number `draw`.
    pub(crate) fn desired(&self, id: u32, otherwise: Otherwise, draw: f64) -> Option<Side> {
        let model = mcdm(&self.world.driver_parameters()[self.me(id).parameters].change);
        let sides = self.weigh(id, otherwise);
        let exponent = |it: &Weighed| (it.gain - model.theta) / model.sigma;
        let largest = sides.iter().map(exponent).fold(0.0, f64::max);
        let size = |it: &Weighed| (exponent(it) - largest).exp();
        let all = (-largest).exp() + sides.iter().map(size).sum::<f64>();
        let mut below = 0.0;
        sides
            .iter()
            .find(|it| {
                below += size(it) / all;
                draw < below
            })
            .map(|it| it.side)
    }

    /// What `body` needs behind a new leader with this gap, speed and acceleration: its model behind a leader as fast
    /// as itself, and comfortable braking for the rest.
    fn demanded(&self, body: &Body, gap: f64, [leader, leader_acceleration]: [f64; 2]) -> f64 {
        let (style, v) = (&self.world.driver_parameters()[body.parameters], body.speed);
        let (comfortable, closing) = (style.manner.comfortable_deceleration, v - leader);
        let wish = self.acceleration(body, Some((gap, leader)));
        if closing <= 0.0 {
            return wish;
        }
        let room = gap - style.follow.jam_gap();
        let needed = |acceleration: f64| {
            let way = leader * leader - 2.0 * room.max(0.1) * acceleration;
            if leader * closing <= -2.0 * room.max(0.1) * acceleration && way > 0.0 {
                -v * v * acceleration / way
            } else {
                closing * closing / (2.0 * room.max(0.1)) - acceleration
            }
        };
        let is_calm = wish >= -0.5 && closing * closing <= gap;
        let steady = needed(0.0);
        let bounded =
            wish.max(-(1.2 * needed(leader_acceleration.min(0.0))).max(comfortable * leader / v).max(0.5));
        let early = if steady >= comfortable && room >= 1.0 { bounded.min(-steady) } else { bounded };
        self.acceleration(body, Some((gap, v))).min(if is_calm { wish } else { early })
    }

    /// The problem of the gap on `side`, ahead (0) or behind (1), with time step `dt`. The accepted share of the time
    /// gap is that of a discretionary change.
    pub(crate) fn refusal(
        &self,
        id: u32,
        side: Side,
        otherwise: Otherwise,
        dt: f64,
    ) -> Option<(usize, Refusal)> {
        let mut me = self.me(id);
        let there = self.around_far(&me, self.beside(me.lane, side)?);
        let style = &self.world.driver_parameters()[me.parameters];
        let [own, leader, follower] = otherwise.speeds;
        me.speed += own;
        let headway_relaxation = 1.0 - 0.3 * (1.0 - style.manner.tightest);
        let pressed = Body { headway_relaxation: headway_relaxation.min(me.headway_relaxation), ..me };
        let time = dt.max(0.5);
        let check = |safety: &Safety, follower: &Body, gap: f64, [leader, leader_acceleration]: [f64; 2]| {
            let closing = (follower.speed - leader).max(0.0);
            let stopping = |v: f64| v * v / 16.0;
            let needed = (stopping(follower.speed) - stopping(leader)).max(0.0) + follower.speed * time;
            if gap < safety.min_gap {
                Some(Refusal::Short)
            } else if closing > 0.0 && gap / closing < safety.min_time_to_collision {
                Some(Refusal::TimeToCollision)
            } else if closing * closing / (2.0 * gap) > safety.max_deceleration {
                Some(Refusal::Forced)
            } else if self.demanded(follower, gap, [leader, leader_acceleration]) < -safety.max_deceleration {
                Some(Refusal::Demanded)
            } else {
                (gap < needed).then_some(Refusal::Insecure)
            }
        };
        let ahead = there[0].and_then(|(it, gap)| {
            check(&style.safety, &pressed, gap + otherwise.gaps[0], [it.speed + leader, it.acceleration])
        });
        let behind = || {
            there[1].and_then(|(it, gap)| {
                let it = Body { speed: it.speed + follower, ..it };
                check(&style.safety.of_follower(), &it, gap + otherwise.gaps[1], [me.speed, me.acceleration])
            })
        };
        ahead.map(|it| (0, it)).or_else(|| behind().map(|it| (1, it)))
    }

    /// The next vehicles ahead and behind, at any distance.
    fn around_far(&self, me: &Body, lane: u32) -> [Option<(Body, f64)>; 2] {
        let ahead = self
            .others(me, lane)
            .filter(|it| it.x > me.x)
            .min_by(|a, b| (a.x - a.length).total_cmp(&(b.x - b.length)));
        let behind = self.others(me, lane).filter(|it| it.x <= me.x).max_by(|a, b| a.x.total_cmp(&b.x));
        [
            ahead.map(|it| (*it, it.x - it.length - me.x)),
            behind.filter(|it| me.x - it.x < 250.0).map(|it| (*it, me.x - it.x - me.length)),
        ]
    }

    /// Remaining road to the end [m].
    pub(crate) fn road_left(&self, id: u32) -> f64 {
        self.length - self.me(id).x
    }

    /// Road on which a vehicle crosses the line in a change without urgency [m].
    pub(crate) fn road_to_cross(&self, id: u32) -> f64 {
        let me = self.me(id);
        0.5 * self.world.driver_parameters()[me.parameters].manner.change_duration * me.speed
    }

    /// Speed of a vehicle [m/s].
    pub(crate) fn speed(&self, id: u32) -> f64 {
        self.me(id).speed
    }
}

pub(crate) fn mcdm(change: &LaneChangeModel) -> &Mcdm {
    match change {
        LaneChangeModel::Mcdm(model) => model,
        other => panic!("{other:?} has no twin"),
    }
}
