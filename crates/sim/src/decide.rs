//! Drivers consider lanes, wait for gaps, and call changes off.

use std::borrow::Cow;

use laneweave_models::change::{
    Appraisal, GapPair, LaneChangeModel, Refusal, Situation, deceleration_to_avoid, time_to_collision,
    urgency,
};
use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_models::{Concentration, Style};
use laneweave_network::{ChainIndex, Side};

use crate::attention::concentration;
use crate::beliefs::Beliefs;
use crate::clock::Clock;
use crate::junction::{Asking, Refuge, is_place_ahead};
use crate::leave::departure;
use crate::perceive::{Dismissed, Outlook, driver};
use crate::plan::{Ask, Concern, Note, Outbox, Plan, Request, Want, push_tight};
use crate::random::{Purpose, Random};
use crate::scene::{Found, Scene, Spot, Viewpoint};
use crate::signs::Sign;
use crate::stuck::{STANDSTILL, is_stuck};
use crate::tally::Tally;
use crate::traffic::{Car, Kind, Mind, Phase};
use crate::turn::next_turn;

/// Urgency from which a driver signals so that others let it in.
const ASKS_FROM: f64 = 0.3;
/// Desire that a voluntary change counts for in the time gap accepted (ours).
const VOLUNTARY_DESIRE: f64 = 0.3;
/// What a driver who lets another in leaves beyond its usual gap [m].
const ROOM_TO_YIELD: f64 = 1.0;
/// Who stands this long [s] within this distance [m] of the last place for a change gives its turn up.
const STANDS_IN_VAIN: f32 = 120.0;
const AT_THE_PLACE: f64 = 20.0;
/// Distance to the last place for a change from which a driver in a wrong lane heeds it [m].
const HEEDED_WITHIN: f64 = 400.0;
/// A vehicle that stands this long is stuck, unless it waits for what is bound to end [s].
const STUCK_AFTER: f32 = 300.0;

/// What deciding needs beside the scene.
#[derive(Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) clock: Clock,
    pub(crate) random: Random,
    pub(crate) overtaking: Side,
}

/// All drivers of a lane decide.
pub(crate) fn decide(scene: &Scene, moment: Moment, chain: ChainIndex, plan: &mut Plan, outbox: &mut Outbox) {
    let lane = &scene.lanes[chain.at()];
    let (mut hints, mut last) = ([0; 2], 0);
    for (index, car) in lane.cars().iter().enumerate() {
        if car.phase == Phase::Cruises && car.due > moment.clock.step {
            continue;
        }
        if car.is_shadow {
            continue;
        }
        let spot = Spot { chain, index };
        match car.phase {
            Phase::Changes => abort_if_it_must(scene, spot, outbox),
            Phase::Aborts => {}
            Phase::Cruises | Phase::Wants => {
                if car.phase == Phase::Wants {
                    go_or_ask(scene, moment, spot, outbox);
                }
                if car.due <= moment.clock.step {
                    // Beside there are about as many entries between two drivers.
                    hints = hints.map(|it| it + index - last);
                    last = index;
                    consider(scene, moment, spot, &mut hints, plan, outbox);
                }
            }
        }
    }
}

/// A driver considers both sides. `hints` are the entries beside the last driver of the lane who did.
fn consider(
    scene: &Scene,
    moment: Moment,
    spot: Spot,
    hints: &mut [usize; 2],
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    let (motion, car) = (scene.motion(spot), scene.car(spot));
    let style = &scene.characters[car.character as usize];
    outbox.tally.considerations += 1;
    let state = concentration(&style.attention, moment.random, motion.id, moment.clock.time());
    let alertness = style.attention.alertness(state);
    let period = moment.clock.steps(alertness.epoch);
    let mut note = note(scene, moment, spot, period);
    if car.standing < STUCK_AFTER && note.standing >= STUCK_AFTER {
        if is_stuck(scene, spot, moment.clock, &mut outbox.survey) {
            outbox.tally.stuck += 1;
        } else {
            note.standing = car.standing;
        }
    }
    if note.standing > 0.0 && car.standing == 0.0 {
        outbox.halts.push(motion.id);
    }
    push_tight(&mut plan.notes, note);
    let mut concern = Concern {
        index: note.index,
        last_place: f64::INFINITY,
        urgency: 0.0,
        gives_up: false,
        rerouted: None,
    };
    let (navigator, goal) = (scene.navigator, car.goal.destination());
    let waypoint = navigator.waypoint_from(scene.network, goal, spot.chain, motion.x);
    // Where it stands in vain, the driver takes another way if there is one.
    let stands_in_vain = note.standing >= STANDS_IN_VAIN && waypoint.last_place - motion.x < AT_THE_PLACE;
    let beyond = waypoint.last_place + 1.0;
    // Who has a passage goes the way that it was given for.
    let is_free = || !scene.has_passage(spot, f64::NEG_INFINITY);
    let has_another_way =
        stands_in_vain && is_free() && navigator.reachable(spot.chain, beyond).next().is_some();
    if (!waypoint.leads_on(motion.x) && is_free()) || has_another_way {
        let from = if has_another_way { beyond } else { motion.x };
        concern.rerouted = Some(navigator.nearest(goal, spot.chain, from));
        concern.gives_up = true;
        outbox.tally.missed_turns += 1;
        push_tight(&mut plan.concerns, concern);
        return;
    }
    // Who passed the last place goes round, if there is a way round; if not, it has a passage, and is re-routed beyond.
    let leads_on = waypoint.leads_on(motion.x);
    if leads_on && matches!(waypoint, Cow::Owned(_)) {
        outbox.tally.missed_turns += u64::from(scene.mind(spot).last_place < motion.x);
    }
    if leads_on && waypoint.last_place - motion.x < HEEDED_WITHIN {
        concern.last_place = waypoint.last_place;
    }
    // Who may change to neither side has nothing to weigh, and nothing left to wait for.
    let here = scene.network.chain(spot.chain);
    let may_change = Side::BOTH.into_iter().any(|side| here.beside(side, motion.x).is_some());
    if !may_change && navigator.recommended(goal).is_none() {
        concern.gives_up = car.phase == Phase::Wants;
        return keep_in_mind(concern, car, plan);
    }
    let beliefs = Beliefs::of(&style.guidance, navigator, moment.random, motion.id, goal);
    let outlook = Outlook::new(scene, spot, &waypoint, alertness.sight, beliefs, hints);
    let change = match state {
        Concentration::Concentrated => Cow::Borrowed(&style.change),
        Concentration::Inattentive => Cow::Owned(style.change.with_comfort(alertness.comfort)),
    };
    let epochs = f64::from(period) * moment.clock.dt / alertness.epoch;
    if let Some(way) = departure(scene, moment, spot, &outlook, &change, epochs) {
        outbox.tally.route_changes += u64::from(way.is_change);
        push_tight(
            &mut plan.concerns,
            Concern { rerouted: Some(way.to), gives_up: way.is_change, ..concern },
        );
        return;
    }
    if car.phase == Phase::Wants {
        let (mind, options) = (scene.mind(spot), Choice::both(&outlook, moment, &change));
        let of = |side: Side| options.iter().flatten().find(|it| it.side == side);
        let [wanted, other] = [mind.side, mind.side.opposite()].map(of);
        concern.gives_up =
            gives_up(moment, mind, style, [wanted, other].map(|it| it.map(|it| &it.appraisal)));
        concern.urgency = wanted.map_or(0.0, |it| it.urgency as f32);
    } else {
        let draw = moment.random.uniform(motion.id, Purpose::Desire, moment.clock.step);
        if let Some(choice) = desire(&outlook, moment, &change, epochs, draw, &mut outbox.tally) {
            let (id, chain, x, urgency) = (motion.id, spot.chain, motion.x, choice.urgency as f32);
            let ask = Ask::Want(choice.want(outlook.here().prospect));
            outbox.requests.push(Request { urgency, id, chain, x, ask });
        }
    }
    keep_in_mind(concern, car, plan);
}

/// The side to which a driver who keeps its lane desires to change, if within `epochs` epochs the desire comes where `draw` was
/// drawn.
#[inline]
fn desire(
    outlook: &Outlook,
    moment: Moment,
    change: &LaneChangeModel,
    epochs: f64,
    draw: f64,
    tally: &mut Tally,
) -> Option<Choice> {
    let (desired, here) = (f64::from(outlook.car().desired), outlook.here().prospect);
    if let LaneChangeModel::Mcdm(model) = change
        && moment.clock.step >= outlook.car().calm_until
        && let Some(Dismissed { best_prospect }) = outlook.dismisses(model, change.reach(epochs, draw))
    {
        // Whether the lane beside is free, and not only its next leader far ahead, takes a longer look.
        let sign = Sign::of(desired, here, best_prospect);
        if sign != Some(Sign::HeldUp) {
            tally.count_sign(sign, false);
            return None;
        }
    }
    let options = Choice::both(outlook, moment, change);
    let symmetric = options.iter().flatten().filter(|it| it.is_symmetric);
    let sign = Sign::of(desired, here, symmetric.map(|it| it.prospect).reduce(f64::max));
    let drawn =
        change.drawn([&options[0], &options[1]].map(|it| it.as_ref().map(|it| &it.appraisal)), epochs, draw);
    tally.count_sign(sign, drawn.is_some());
    drawn.and_then(|it| options.into_iter().nth(it)).flatten()
}

/// A driver keeps its way in mind if there is something about it to keep, or to forget.
#[inline(never)]
fn keep_in_mind(concern: Concern, car: &Car, plan: &mut Plan) {
    if car.phase != Phase::Cruises || car.heeds_more || concern.last_place.is_finite() {
        push_tight(&mut plan.concerns, concern);
    }
}

/// A side, and what the driver makes of it.
struct Choice {
    side: Side,
    appraisal: Appraisal,
    is_symmetric: bool,
    /// How much the driver's route presses it to this side, 0…1.
    urgency: f64,
    /// Anticipated speed there [m/s].
    prospect: f64,
}

impl Choice {
    /// What the driver makes of both sides, that for overtaking first.
    fn both(outlook: &Outlook, moment: Moment, change: &LaneChangeModel) -> [Option<Choice>; 2] {
        let of = |side| Choice::of(outlook, moment, change, side);
        [of(moment.overtaking), of(moment.overtaking.opposite())]
    }

    /// What the driver makes of `side`, if it may change there; soon after a change only if it helps the route.
    fn of(outlook: &Outlook, moment: Moment, change: &LaneChangeModel, side: Side) -> Option<Choice> {
        let from = outlook.beside(side)?;
        let is_calm = moment.clock.step < outlook.car().calm_until;
        if is_calm && outlook.here().route.changes == 0 {
            return None;
        }
        let situation = outlook.situation(side, from);
        let helps_the_route = situation.there.route.changes < situation.here.route.changes;
        (helps_the_route || !is_calm).then(|| Choice {
            side,
            appraisal: change.appraise(&situation),
            is_symmetric: situation.is_symmetric(),
            urgency: if helps_the_route { pressure(&situation) } else { 0.0 },
            prospect: situation.there.prospect,
        })
    }

    fn want(&self, prospect_here: f64) -> Want {
        Want {
            side: self.side,
            kind: if self.is_symmetric { Kind::Discretionary } else { Kind::Route },
            appraisal: self.appraisal,
            speed_gain: (self.prospect - prospect_here) as f32,
        }
    }
}

/// How much the route presses a driver out of its lane.
fn pressure(situation: &Situation) -> f64 {
    let route = &situation.here.route;
    urgency(route.changes, route.remaining, situation.me.pace.speed)
}

/// What the driver keeps in mind whatever it decides, considering lanes once in `period` steps.
fn note(scene: &Scene, moment: Moment, spot: Spot, period: u32) -> Note {
    let (motion, car) = (scene.motion(spot), scene.car(spot));
    let style = &scene.characters[car.character as usize];
    let limit = scene.network.chain(spot.chain).limit(motion.x);
    let stands = motion.speed < STANDSTILL;
    Note {
        index: spot.index as u32,
        due: next_turn(motion.id, moment.clock.step + 1, period),
        limit_desired: car.class.desired_speed(style, limit) as f32,
        standing: if stands { car.standing + (f64::from(period) * moment.clock.dt) as f32 } else { 0.0 },
    }
}

/// A waiting driver loses patience, or the reason to change to the side that it wanted, and not to the other.
fn gives_up(moment: Moment, mind: &Mind, style: &Style, [wanted, other]: [Option<&Appraisal>; 2]) -> bool {
    let Some(appraisal) = wanted else { return true };
    let waited = moment.clock.since(mind.since);
    let is_tired = mind.kind == Kind::Discretionary && waited > style.manner.patience;
    let is_pointless = appraisal.gain < 0.0;
    let is_better_elsewhere =
        other.is_some_and(|it| it.gain > it.theta && it.gain > appraisal.gain + it.theta.abs());
    is_tired || is_pointless || is_better_elsewhere
}

/// A waiting driver goes if the gap is acceptable, else asks to be let in.
fn go_or_ask(scene: &Scene, moment: Moment, spot: Spot, outbox: &mut Outbox) {
    let (motion, mind) = (scene.motion(spot), scene.mind(spot));
    let request =
        |ask: Ask| Request { urgency: mind.urgency, id: motion.id, chain: spot.chain, x: motion.x, ask };
    match gap(scene, spot, mind.side) {
        None => {}
        Some(_) if scene.has_passage(spot, f64::NEG_INFINITY) => {}
        Some(gap) if gap.is_wanted_before(scene, spot, moment.clock) => {}
        Some(gap) if gap.accepted(scene, spot, moment.clock.dt).is_ok() => {
            outbox.requests.push(request(Ask::Change));
        }
        Some(gap) if f64::from(mind.urgency) >= ASKS_FROM => {
            if let Some(found) = gap.who_can_let_in(scene, spot) {
                let behind = scene.motion(found.spot);
                outbox.requests.push(request(Ask::LetIn {
                    follower: behind.id,
                    chain: found.spot.chain,
                    x: behind.x,
                    gap: (found.distance - f64::from(motion.length) - ROOM_TO_YIELD) as f32,
                    speed: motion.speed as f32,
                }));
            }
        }
        Some(_) => {}
    }
}

/// A gap in the lane beside, as it would be taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// The chain.
    pub(crate) chain: ChainIndex,
    /// Where the own front bumper would be on it [m].
    pub(crate) x: f64,
    /// Metres there for a metre here.
    pub(crate) scale: f64,
    /// Road on which the centre can still cross [m].
    pub(crate) room: f64,
    /// The new leader.
    pub(crate) ahead: Option<Ahead>,
    /// The new follower.
    pub(crate) follower: Option<Found>,
}

/// The gap beside; `None` where a change to `side` is not allowed.
pub(crate) fn gap(scene: &Scene, spot: Spot, side: Side) -> Option<Gap> {
    let (motion, car) = (scene.motion(spot), scene.car(spot));
    let beside = scene.network.chain(spot.chain).beside(side, motion.x)?;
    let x = beside.across(motion.x);
    let from = scene.viewpoint_at(beside.chain, x, motion.id, car.goal.destination());
    Some(Gap {
        chain: beside.chain,
        x,
        scale: beside.scale,
        room: permitted_ahead(scene, spot, side),
        ahead: scene.ahead(from),
        follower: scene.follower(from),
    })
}

/// How far on a change to `side` stays allowed [m], as far as a change needs.
fn permitted_ahead(scene: &Scene, spot: Spot, side: Side) -> f64 {
    const ENOUGH: f64 = 150.0;
    let (motion, car) = (scene.motion(spot), scene.car(spot));
    let (mut chain, mut x, mut permitted) = (spot.chain, motion.x, 0.0);
    while let Some(stretch) = scene.network.chain(chain).beside(side, x) {
        permitted += stretch.end - x;
        if permitted > ENOUGH || stretch.end < scene.network.chain(chain).length - 1e-6 {
            // Joined stretches of one chain follow each other without a break.
            match scene.network.chain(chain).beside(side, stretch.end + 1e-6) {
                Some(next) if permitted <= ENOUGH && next.start > stretch.start => {
                    x = next.start;
                    continue;
                }
                _ => break,
            }
        }
        match scene.next(car.goal.destination(), chain) {
            Some(next) => (chain, x) = (next, 0.0),
            None => break,
        }
    }
    permitted
}

impl Gap {
    /// Whether the driver, its new leader and its new follower can live with the change.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn accepted(&self, scene: &Scene, spot: Spot, dt: f64) -> Result<(), Refusal> {
        let speed = scene.motion(spot).speed;
        let style = &scene.characters[scene.car(spot).character as usize];
        let duration = style.manner.duration(f64::from(scene.mind(spot).urgency));
        let crossing = 0.5 * duration * speed;
        if self.room < crossing || !self.is_clear_of_junctions(scene, spot, 2.0 * crossing) {
            return Err(Refusal::Short);
        }
        let me = driver(scene, spot);
        if let Some(ahead) = self.ahead {
            let demanded = style.follow.acceleration(self.pace(spot, scene), Some(ahead));
            let pair = GapPair { gap: ahead.gap, follower: speed, leader: ahead.speed, demanded };
            style.safety.accept(pair, dt)?;
        }
        if let Some(found) = self.follower {
            let behind = driver(scene, found.spot);
            let gap = found.distance - me.length;
            let ego = Ahead { gap, speed, acceleration: me.acceleration };
            let demanded = behind.follow.acceleration(behind.pace, Some(ego));
            let pair = GapPair { gap, follower: behind.pace.speed, leader: speed, demanded };
            style.safety.accept(pair, dt)?;
        }
        Ok(())
    }

    /// Whether somebody who waits before a junction for room on that stretch comes first to it.
    fn is_wanted_before(&self, scene: &Scene, spot: Spot, clock: Clock) -> bool {
        let refuge = Refuge::at(&scene.network.junctions, self.chain, self.x);
        let claim = Asking::of(scene, spot, scene.mind(spot).since, clock).claim;
        scene.passages.wanted_before(refuge, claim) > 0.0
    }

    /// The first behind who makes room by braking no harder than it does to let others in: those nearer drive past.
    fn who_can_let_in(&self, scene: &Scene, spot: Spot) -> Option<Found> {
        /// So many behind see who wants in.
        const SEE_IT: usize = 10;
        let motion = scene.motion(spot);
        let room = scene.characters[scene.car(spot).character as usize].safety.min_gap + ROOM_TO_YIELD;
        let can = |it: &Found| {
            let (behind, car) = (scene.motion(it.spot), scene.car(it.spot));
            let gentle = scene.characters[car.character as usize].manner.yield_deceleration;
            let gap = it.distance - f64::from(motion.length);
            // Who stands beside or right behind a standing vehicle cannot make room for it.
            let is_beside = gap < room && motion.speed <= STANDSTILL;
            let needed = deceleration_to_avoid((gap - ROOM_TO_YIELD).max(0.1), behind.speed, motion.speed);
            car.phase == Phase::Cruises && gentle > 0.0 && !is_beside && needed <= gentle
        };
        std::iter::successors(self.follower, |it| scene.next_behind(*it, motion.id)).take(SEE_IT).find(can)
    }

    /// Whether the change, which takes `way` [m], is over before the next place where somebody may have to stop, and
    /// nobody who has a passage already comes behind.
    fn is_clear_of_junctions(&self, scene: &Scene, spot: Spot, way: f64) -> bool {
        /// Least way before such a place on which a lane is still changed, at walking speed [m].
        const LEAST: f64 = 15.0;
        /// So far into a chain a junction may reach [m].
        const JUNCTION: f64 = 15.0;
        let motion = scene.motion(spot);
        let here = scene.viewpoint(spot);
        let there = Viewpoint { chain: self.chain, x: self.x, ..here };
        let way = way.max(LEAST);
        let has_passage = |it: &Found| scene.has_passage(it.spot, it.distance - f64::from(motion.length));
        // Room that is kept for others beyond a junction stays theirs.
        let refuge = Refuge::at(&scene.network.junctions, self.chain, self.x);
        let kept = scene.passages.kept_on(refuge);
        let takes_room = kept > 0.0 && self.x - f64::from(motion.length) < kept + JUNCTION;
        let is_in_fork = self.x - f64::from(motion.length) < scene.network.chain(self.chain).fork_clearance;
        !takes_room
            && !is_in_fork
            && ![here, there].into_iter().any(|it| is_place_ahead(scene, it, way))
            && !self.follower.as_ref().is_some_and(has_passage)
    }

    /// The driver's pace with the time gap that it accepts for this change.
    fn pace(&self, spot: Spot, scene: &Scene) -> Pace {
        let (motion, car) = (scene.motion(spot), scene.car(spot));
        let style = &scene.characters[car.character as usize];
        let desire = f64::from(scene.mind(spot).urgency).max(VOLUNTARY_DESIRE);
        let tightness = style.manner.tightness(desire).min(f64::from(motion.tightness));
        Pace { speed: motion.speed, desired: f64::from(car.desired), tightness }
    }

    /// Share of the usual time gap that the driver accepts for this change.
    pub(crate) fn tightness(&self, scene: &Scene, spot: Spot) -> f64 {
        self.pace(spot, scene).tightness
    }

    /// Gaps [m] and times to collision [s] ahead and behind; infinite where there is nobody.
    pub(crate) fn measures(&self, scene: &Scene, spot: Spot) -> [f64; 4] {
        let motion = scene.motion(spot);
        let (gap_ahead, ttc_ahead) = self.ahead.map_or((f64::INFINITY, f64::INFINITY), |it| {
            (it.gap, time_to_collision(it.gap, motion.speed, it.speed))
        });
        let (gap_behind, ttc_behind) = self.follower.map_or((f64::INFINITY, f64::INFINITY), |it| {
            let gap = it.distance - f64::from(motion.length);
            (gap, time_to_collision(gap, scene.motion(it.spot).speed, motion.speed))
        });
        [gap_ahead, gap_behind, ttc_ahead, ttc_behind]
    }
}

/// Before the crossing a driver goes back if its new leader forces it to brake much harder than its old one.
fn abort_if_it_must(scene: &Scene, spot: Spot, outbox: &mut Outbox) {
    const MUCH_HARDER: f64 = 2.0;
    let (motion, car, mind) = (scene.motion(spot), scene.car(spot), scene.mind(spot));
    let Some(twin) = mind.twin.filter(|_| mind.progress < 0.5) else { return };
    let style = &scene.characters[car.character as usize];
    let forced = |from| {
        scene.ahead(from).map_or(0.0, |it| deceleration_to_avoid(it.gap.max(0.1), motion.speed, it.speed))
    };
    let there = forced(scene.viewpoint_at(twin.chain, twin.x, motion.id, car.goal.destination()));
    if there > style.safety.max_deceleration && there > forced(scene.viewpoint(spot)) + MUCH_HARDER {
        let ask = Ask::Abort;
        outbox.requests.push(Request {
            urgency: mind.urgency,
            id: motion.id,
            chain: spot.chain,
            x: motion.x,
            ask,
        });
    }
}
