//! A driver considers lanes at its turn: it notes whether it stands, follows its route, perceives, and chooses.

use std::borrow::Cow;

use laneweave_models::Style;
use laneweave_models::change::{Appraisal, LaneChangeModel};
use laneweave_models::follow::CarFollowing;
use laneweave_network::{Position, Side};

use crate::driver::beliefs::Beliefs;
use crate::driver::choice::{Choice, desire};
use crate::driver::leave::departure;
use crate::driver::me::{Attending, Me};
use crate::driver::other_goal::other_goal;
use crate::driver::perceive::{Perception, driver_of, lane_rule};
use crate::driver::plan::{Ask, Concern, Note, Outbox, Plan, Request};
use crate::driver::stuck::is_stuck;
use crate::driver::turn::next_turn;
use crate::driver::window;
use crate::record::events::DrivingEventKind;
use crate::route::waypoint::Waypoint;
use crate::state::lane::{DriverState, Kinematics, LaneChangeKind, LaneChangeState, Phase};
use crate::state::moment::Moment;
use crate::state::push_tight::push_tight;
use crate::state::random::Purpose;
use crate::state::standstill::STANDSTILL;
use crate::view::scene::{Scene, Spot};

/// A driver in a wrong lane reacts to the last place for a change within this distance [m].
const REACTS_WITHIN: f64 = 400.0;
/// A vehicle that stands this long is stuck, unless what it waits for is sure to end [s].
pub(super) const STUCK_AFTER: f32 = 300.0;
/// Whoever had to wait has this much time to drive off when it no longer has to [s].
const GRACE: f32 = 10.0;

/// Considers both sides at a driver's turn. `hints` are the entries beside the last driver of the lane who had its
/// turn.
pub(crate) fn consider(
    scene: &Scene,
    moment: Moment,
    spot: Spot,
    hints: &mut [usize; 2],
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    let me = Me::at(scene, spot);
    let attending = Attending::of(&me, moment);
    outbox.counters.considerations += 1;
    let standing = note_turn(scene, moment, &me, attending.period, plan, outbox);
    let waypoint = waypoint(scene, &me);
    let is_detour = matches!(waypoint, Cow::Owned(_)) && takes_a_detour(scene, &me);
    let concern = follow_route(scene, moment, &me, (&waypoint, is_detour), standing, outbox);
    if concern.rerouted.is_some() {
        return push_tight(&mut plan.concerns, concern);
    }
    let is_last_chance = has_last_chance(&me.style.change, me.motion, &waypoint);
    if is_last_chance
        && me.driver.phase == Phase::Cruises
        && let Some(note) = plan.notes.last_mut()
    {
        note.due = moment.clock.step + 1;
    }
    if !has_a_choice(scene, &me) {
        let gives_up = me.driver.phase == Phase::Wants;
        return keep_in_mind(Concern { gives_up, ..concern }, me.driver, plan);
    }
    let perception = look(scene, moment, &me, &attending, &waypoint, hints);
    let change = attending.model(me.style);
    if let Some(way) = departure(scene, moment, spot, &perception, &change, attending.epochs) {
        if way.is_change {
            outbox.note(scene, moment.clock, spot, DrivingEventKind::RouteChange);
        }
        let rerouted = Concern { rerouted: Some(way.to), gives_up: way.is_change, ..concern };
        return push_tight(&mut plan.concerns, rerouted);
    }
    let concern = if me.driver.phase == Phase::Wants {
        want_on(moment, &me, &perception, &change, is_last_chance, concern)
    } else {
        choose(moment, &me, &perception, &change, (attending.epochs, is_last_chance), outbox);
        concern
    };
    keep_in_mind(concern, me.driver, plan);
}

/// Notes that the driver had its turn, and whether it stands. Returns how long it has stood [s].
fn note_turn(
    scene: &Scene,
    moment: Moment,
    me: &Me,
    period: u32,
    plan: &mut Plan,
    outbox: &mut Outbox,
) -> f32 {
    let Me { spot, driver, .. } = *me;
    let mut note = note(scene, moment, me, period);
    if driver.standing < STUCK_AFTER && note.standing >= STUCK_AFTER {
        if is_stuck(scene, spot, moment.clock, &mut outbox.survey) {
            outbox.counters.stuck += 1;
        } else {
            note.standing = STUCK_AFTER - GRACE;
        }
    }
    if note.standing > 0.0 && driver.standing == 0.0 {
        outbox.note(scene, moment.clock, spot, DrivingEventKind::Halt);
    }
    if note.standing == 0.0 && driver.standing > 0.0 {
        let kind = DrivingEventKind::SetOff { stood: driver.standing };
        outbox.note(scene, moment.clock, spot, kind);
    }
    push_tight(&mut plan.notes, note);
    note.standing
}

/// The waypoint of a driver's route at its position.
pub(crate) fn waypoint<'a>(scene: &Scene<'a>, me: &Me) -> Cow<'a, Waypoint> {
    scene.navigator.waypoint_from(scene.network, me.driver.goal.destination(), me.spot.chain, me.motion.x)
}

/// Whether it is too late for the usual route of a driver.
fn takes_a_detour(scene: &Scene, me: &Me) -> bool {
    !scene.navigator.waypoint(me.driver.goal.destination(), me.spot.chain).leads_on(me.motion.x)
}

/// Follows the route of a driver who has stood for `standing` [s]. Returns the last place for its next change, or a
/// new destination if it can no longer reach its own.
fn follow_route(
    scene: &Scene,
    moment: Moment,
    me: &Me,
    (waypoint, is_detour): (&Waypoint, bool),
    standing: f32,
    outbox: &mut Outbox,
) -> Concern {
    let Me { spot, motion, .. } = *me;
    let concern = Concern {
        index: spot.index as u32,
        last_place: f64::INFINITY,
        urgency: 0.0,
        gives_up: false,
        minds_offside: minds_offside(scene, me),
        rerouted: None,
    };
    if let Some(other) = other_goal(scene, me, waypoint, standing) {
        outbox.note(scene, moment.clock, spot, DrivingEventKind::MissedTurn);
        outbox.counters.lost += u64::from(scene.navigator.number(other).is_none());
        return Concern { rerouted: Some(other), gives_up: true, ..concern };
    }
    if !waypoint.leads_on(motion.x) {
        return concern;
    }
    // A driver who passed the last place takes another route if there is one. If not, it has a reservation, and is
    // rerouted beyond it.
    if is_detour && me.lane_change.last_place < motion.x {
        outbox.note(scene, moment.clock, spot, DrivingEventKind::MissedTurn);
    }
    Concern { last_place: last_place(waypoint, motion.x), ..concern }
}

/// The last place for the next change on the route of a driver at `x` [m], infinite if that is so far ahead that it
/// does not react to it yet.
pub(crate) fn last_place(waypoint: &Waypoint, x: f64) -> f64 {
    if waypoint.last_place - x < REACTS_WITHIN { waypoint.last_place } else { f64::INFINITY }
}

/// Whether a driver would pass its leader in the overtaking lane before its next turn, although it has to stay behind.
fn minds_offside(scene: &Scene, me: &Me) -> bool {
    me.style.change.minds_offside(lane_rule(scene, me.spot)) && would_pass(scene, me)
}

/// Whether its leader in the overtaking lane, which it may not pass, will hold a driver up more than its own leader.
#[inline(never)]
fn would_pass(scene: &Scene, me: &Me) -> bool {
    /// How far a driver looks ahead: until after its next turn [s].
    const SOON: f64 = 2.0;
    let overtaking = scene.network.driving_side.overtaking();
    let desired = f64::from(me.driver.desired);
    let offside = window::leader_beside(scene, me.spot, overtaking);
    offside.filter(|it| me.style.change.stays_behind(desired, *it)).is_some_and(|it| {
        let soon = it.nearer(SOON * (me.motion.speed - it.speed).max(0.0));
        let pace = driver_of(scene, me.spot).pace;
        let behind = |ahead| me.style.follow.acceleration(pace, ahead);
        let wish = behind(Some(soon));
        wish < 0.0 && wish < behind(scene.ahead(scene.viewpoint(me.spot)))
    })
}

/// Whether a driver may change to a side, or is recommended a route. Without that it has nothing to decide or to wait
/// for.
fn has_a_choice(scene: &Scene, me: &Me) -> bool {
    Side::BOTH.into_iter().any(|side| window::beside(scene, me.spot, side).is_some())
        || scene.navigator.recommended(me.driver.goal.destination()).is_some()
}

/// What a driver perceives at its turn.
pub(crate) fn look<'s, 'a>(
    scene: &'s Scene<'a>,
    moment: Moment,
    me: &Me<'a>,
    attending: &Attending,
    waypoint: &Waypoint,
    hints: &mut [usize; 2],
) -> Perception<'s, 'a> {
    let goal = me.driver.goal.destination();
    let beliefs = Beliefs::of(&me.style.guidance, scene.navigator, moment.random, me.motion.id, goal);
    Perception::new(scene, me.spot, waypoint, attending.alertness.sight, beliefs, hints)
}

/// A driver who wants to change goes on wanting it, or gives it up.
fn want_on(
    moment: Moment,
    me: &Me,
    perception: &Perception,
    change: &LaneChangeModel,
    is_last_chance: bool,
    concern: Concern,
) -> Concern {
    let options = Choice::both(perception, moment, change);
    let of = |side: Side| options.iter().flatten().find(|it| it.side == side);
    let [wanted, other] = [me.lane_change.side, me.lane_change.side.opposite()].map(of);
    let leads = |it: Option<&Choice>| is_last_chance && it.is_some_and(|it| it.helps_the_route);
    let appraisals = [wanted, other].map(|it| it.map(|it| &it.appraisal));
    let gives_up = !leads(wanted) && (leads(other) || gives_up(moment, me.lane_change, me.style, appraisals));
    Concern { gives_up, urgency: wanted.map_or(0.0, |it| it.pressure as f32), ..concern }
}

/// A driver who keeps its lane begins to want a change if the desire arises, or at the last place for a necessary
/// change.
fn choose(
    moment: Moment,
    me: &Me,
    perception: &Perception,
    change: &LaneChangeModel,
    (epochs, is_last_chance): (f64, bool),
    outbox: &mut Outbox,
) {
    let Me { spot, motion, .. } = *me;
    let draw = moment.random.uniform(motion.id, Purpose::Desire, moment.clock.step);
    let needed =
        || Choice::both(perception, moment, change).into_iter().flatten().find(|it| it.helps_the_route);
    let choice = is_last_chance.then(needed).flatten();
    let choice = choice.or_else(|| desire(perception, moment, change, epochs, draw, &mut outbox.counters));
    if let Some(choice) = choice {
        let (id, chain, x, urgency) = (motion.id, spot.chain, motion.x, choice.pressure as f32);
        let ask = Ask::Want(choice.want(perception.here().anticipated_speed));
        outbox.requests.push(Request { urgency, id, chain, x, ask });
    }
}

/// Whether a driver comes to the last place for a necessary change. There it looks for a gap at every step, and wants
/// the change whatever speaks against it (ours).
pub(crate) fn has_last_chance(change: &LaneChangeModel, motion: &Kinematics, waypoint: &Waypoint) -> bool {
    /// Distance to that place [m], and time [s].
    const WAY: f64 = 30.0;
    const TIME: f64 = 4.0;
    let is_near = waypoint.last_place - motion.x < (TIME * motion.speed).max(WAY);
    waypoint.changes > 0 && is_near && waypoint.leads_on(motion.x) && change.follows_a_route()
}

/// Stores what a driver notes about its route, if something has to be stored or cleared.
#[inline(never)]
fn keep_in_mind(concern: Concern, driver: &DriverState, plan: &mut Plan) {
    let minds_more = concern.last_place.is_finite() || concern.minds_offside;
    if driver.phase != Phase::Cruises || driver.needs_full_update || minds_more {
        push_tight(&mut plan.concerns, concern);
    }
}

/// The note that is stored at every turn. The driver considers lanes once in `period` steps.
fn note(scene: &Scene, moment: Moment, me: &Me, period: u32) -> Note {
    let Me { spot, motion, driver, lane_change, .. } = *me;
    let due = next_turn(motion.id, moment.clock.step + 1, period);
    let at = Position::new(spot.chain, motion.x);
    let stands = motion.speed < STANDSTILL;
    // A consideration between two turns adds nothing to the time, which is counted from turn to turn.
    let is_turn = next_turn(motion.id, moment.clock.step, period) == moment.clock.step;
    let since_last = if is_turn { (f64::from(period) * moment.clock.dt) as f32 } else { 0.0 };
    let outlook = scene.outlook(driver);
    let leaving = outlook.leaving_speed(lane_change.previous_lanes.last(), motion.x);
    Note {
        index: spot.index as u32,
        due,
        limit_desired: outlook.until_turn(at, motion.speed, due, moment.clock).min(leaving),
        standing: if stands { driver.standing + since_last } else { 0.0 },
    }
}

/// Whether a waiting driver gives up. It does if it loses patience, has no more reason to change, or prefers the
/// other side.
fn gives_up(
    moment: Moment,
    lane_change: &LaneChangeState,
    style: &Style,
    [wanted, other]: [Option<&Appraisal>; 2],
) -> bool {
    let Some(appraisal) = wanted else { return true };
    let waited = moment.clock.since(lane_change.since);
    let is_tired = lane_change.kind != LaneChangeKind::Route && waited > style.manner.patience;
    let is_pointless = style.change.would_rather_stay(appraisal, f64::from(lane_change.gain));
    let is_better_elsewhere =
        other.is_some_and(|it| it.gain > it.theta && it.gain > appraisal.gain + it.theta.abs());
    is_tired || is_pointless || is_better_elsewhere
}
