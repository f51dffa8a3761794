//! Drivers consider lanes, wait for gaps, and call changes off.

use std::borrow::Cow;

use laneweave_models::change::{Appraisal, LaneChangeModel, deceleration_to_avoid};
use laneweave_models::{Concentration, Style};
use laneweave_network::{ChainIndex, Side};

use crate::driver::attention::concentration;
use crate::driver::beliefs::Beliefs;
use crate::driver::gap::{Hindrance, ROOM_TO_YIELD, gap};
use crate::driver::leave::departure;
use crate::driver::perceive::{Dismissed, Outlook};
use crate::driver::plan::{Ask, Concern, Note, Outbox, Plan, Request, Want};
use crate::driver::stuck::is_stuck;
use crate::driver::turn::next_turn;
use crate::driver::window;
use crate::record::signs::Sign;
use crate::record::tally::Tally;
use crate::route::ways::Waypoint;
use crate::state::goal::Destination;
use crate::state::moment::Moment;
use crate::state::random::Purpose;
use crate::state::standstill::STANDSTILL;
use crate::state::tight::push_tight;
use crate::state::traffic::{Car, Kind, Mind, Motion, Phase};
use crate::view::scene::{Scene, Spot};

/// Who stands this long [s] within this distance [m] of the last place for a change gives its turn up.
const STANDS_IN_VAIN: f32 = 120.0;
const AT_THE_PLACE: f64 = 20.0;
/// Distance to the last place for a change from which a driver in a wrong lane heeds it [m].
const HEEDED_WITHIN: f64 = 400.0;
/// A vehicle that stands this long is stuck, unless it waits for what is bound to end [s].
const STUCK_AFTER: f32 = 300.0;

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

/// A driver considers both sides at its turn. `hints` are the entries beside the last driver of the lane who did.
pub(crate) fn consider(
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
    if note.standing == 0.0 && car.standing > 0.0 {
        outbox.set_off.push((motion.id, car.standing));
    }
    push_tight(&mut plan.notes, note);
    let mut concern = Concern {
        index: note.index,
        last_place: f64::INFINITY,
        urgency: 0.0,
        gives_up: false,
        minds_offside: style.change.minds_offside(),
        rerouted: None,
    };
    let (navigator, goal) = (scene.navigator, car.goal.destination());
    let waypoint = navigator.waypoint_from(scene.network, goal, spot.chain, motion.x);
    if let Some(other) = other_goal(scene, spot, &waypoint, note.standing) {
        concern.rerouted = Some(other);
        concern.gives_up = true;
        outbox.count_missed_turn(motion.id);
        outbox.tally.lost += u64::from(other.is_none());
        push_tight(&mut plan.concerns, concern);
        return;
    }
    // Who passed the last place goes round, if there is a way round; if not, it has a passage, and is re-routed beyond.
    let leads_on = waypoint.leads_on(motion.x);
    if leads_on && matches!(waypoint, Cow::Owned(_)) && scene.mind(spot).last_place < motion.x {
        outbox.count_missed_turn(motion.id);
    }
    if leads_on && waypoint.last_place - motion.x < HEEDED_WITHIN {
        concern.last_place = waypoint.last_place;
    }
    let is_last_chance = has_last_chance(&style.change, motion, &waypoint);
    if is_last_chance
        && car.phase == Phase::Cruises
        && let Some(note) = plan.notes.last_mut()
    {
        note.due = moment.clock.step + 1;
    }
    // Who may change to neither side has nothing to weigh, and nothing left to wait for.
    let may_change = Side::BOTH.into_iter().any(|side| window::beside(scene, spot, side).is_some());
    if !may_change && navigator.recommended(goal).is_none() {
        concern.gives_up = car.phase == Phase::Wants;
        return keep_in_mind(concern, car, plan);
    }
    let beliefs = Beliefs::of(&style.guidance, navigator, moment.random, motion.id, goal);
    let outlook = Outlook::new(scene, spot, &waypoint, alertness.sight, beliefs, hints);
    let change = model(style, state);
    let epochs = f64::from(period) * moment.clock.dt / alertness.epoch;
    if let Some(way) = departure(scene, moment, spot, &outlook, &change, epochs) {
        if way.is_change {
            outbox.count_route_change(motion.id);
        }
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
        let leads = |it: Option<&Choice>| is_last_chance && it.is_some_and(|it| it.helps_the_route);
        concern.gives_up = !leads(wanted)
            && (leads(other)
                || gives_up(moment, mind, style, [wanted, other].map(|it| it.map(|it| &it.appraisal))));
        concern.urgency = wanted.map_or(0.0, |it| it.pressure as f32);
    } else {
        let draw = moment.random.uniform(motion.id, Purpose::Desire, moment.clock.step);
        let needed =
            || Choice::both(&outlook, moment, &change).into_iter().flatten().find(|it| it.helps_the_route);
        let choice = is_last_chance.then(needed).flatten();
        if let Some(choice) =
            choice.or_else(|| desire(&outlook, moment, &change, epochs, draw, &mut outbox.tally))
        {
            let (id, chain, x, urgency) = (motion.id, spot.chain, motion.x, choice.pressure as f32);
            let ask = Ask::Want(choice.want(outlook.here().prospect));
            outbox.requests.push(Request { urgency, id, chain, x, ask });
        }
    }
    keep_in_mind(concern, car, plan);
}

/// Where the driver at `spot`, who has been `standing` so long [s], goes from now on because it cannot get to where it goes by its
/// `waypoint`, or has waited for the change in vain: the nearest destination that it still can, or as the road leads. None if it goes on.
fn other_goal(scene: &Scene, spot: Spot, waypoint: &Waypoint, standing: f32) -> Option<Destination> {
    let goal = scene.car(spot).goal.destination();
    let x = scene.motion(spot).x;
    let found = if !waypoint.leads_on(x) {
        scene.navigator.nearest(scene.network, goal, spot.chain, x)
    } else if standing >= STANDS_IN_VAIN && waypoint.last_place - x < AT_THE_PLACE {
        // Only a way that asks for no change here helps it on.
        Some(scene.navigator.nearest_in_lane(goal, spot.chain, waypoint.last_place + AT_THE_PLACE)?)
    } else {
        return None;
    };
    // Who has a passage goes the way that it was given for; who drives as the road leads has no other goal to lose.
    let is_free = goal.is_some() && !scene.has_passage(spot, f64::NEG_INFINITY);
    (found != goal && is_free).then_some(found)
}

/// The lane-change model of a driver of `style` in this `state`.
pub(crate) fn model(style: &Style, state: Concentration) -> Cow<'_, LaneChangeModel> {
    match state {
        Concentration::Concentrated => Cow::Borrowed(&style.change),
        Concentration::Inattentive => {
            Cow::Owned(style.change.with_comfort(style.attention.inattentive.comfort))
        }
    }
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

/// Whether a driver comes to the last place for a change that it has to make: there it looks for a gap at every step, and wants the
/// change whatever else speaks against it (ours).
pub(crate) fn has_last_chance(change: &LaneChangeModel, motion: &Motion, waypoint: &Waypoint) -> bool {
    /// Way before that place [m], and time [s].
    const WAY: f64 = 30.0;
    const TIME: f64 = 4.0;
    let is_near = waypoint.last_place - motion.x < (TIME * motion.speed).max(WAY);
    waypoint.changes > 0 && is_near && waypoint.leads_on(motion.x) && change.follows_a_route()
}

/// A driver keeps its way in mind if there is something about it to keep, or to forget.
#[inline(never)]
fn keep_in_mind(concern: Concern, car: &Car, plan: &mut Plan) {
    let minds_more = concern.last_place.is_finite() || concern.minds_offside;
    if car.phase != Phase::Cruises || car.heeds_more || minds_more {
        push_tight(&mut plan.concerns, concern);
    }
}

/// A side, and what the driver makes of it.
struct Choice {
    side: Side,
    appraisal: Appraisal,
    is_symmetric: bool,
    /// Fewer changes are left to make there.
    helps_the_route: bool,
    /// How much the driver is pressed to this side, 0…1.
    pressure: f64,
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
        (helps_the_route || !is_calm).then(|| {
            let appraisal = change.appraise(&situation);
            Choice {
                side,
                appraisal,
                is_symmetric: situation.is_symmetric(),
                helps_the_route,
                pressure: change.pressure(&situation, &appraisal),
                prospect: situation.there.prospect,
            }
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

/// What the driver keeps in mind whatever it decides, considering lanes once in `period` steps.
fn note(scene: &Scene, moment: Moment, spot: Spot, period: u32) -> Note {
    let (motion, car) = (scene.motion(spot), scene.car(spot));
    let style = &scene.characters[car.character as usize];
    let limit = scene.network.chain(spot.chain).limit(motion.x);
    let stands = motion.speed < STANDSTILL;
    // Considerations between two turns add no time to that between the turns.
    let is_turn = next_turn(motion.id, moment.clock.step, period) == moment.clock.step;
    let since_last = if is_turn { (f64::from(period) * moment.clock.dt) as f32 } else { 0.0 };
    Note {
        index: spot.index as u32,
        due: next_turn(motion.id, moment.clock.step + 1, period),
        limit_desired: car.class.desired_speed(style, limit) as f32,
        standing: if stands { car.standing + since_last } else { 0.0 },
    }
}

/// A waiting driver loses patience, or the reason to change to the side that it wanted, and not to the other.
fn gives_up(moment: Moment, mind: &Mind, style: &Style, [wanted, other]: [Option<&Appraisal>; 2]) -> bool {
    let Some(appraisal) = wanted else { return true };
    let waited = moment.clock.since(mind.since);
    let is_tired = mind.kind == Kind::Discretionary && waited > style.manner.patience;
    let is_pointless = style.change.would_rather_stay(appraisal);
    let is_better_elsewhere =
        other.is_some_and(|it| it.gain > it.theta && it.gain > appraisal.gain + it.theta.abs());
    is_tired || is_pointless || is_better_elsewhere
}

/// A waiting driver goes if the gap is acceptable, else asks to be let in.
pub(crate) fn go_or_ask(scene: &Scene, moment: Moment, spot: Spot, outbox: &mut Outbox) {
    let (motion, mind) = (scene.motion(spot), scene.mind(spot));
    let asks_from = scene.characters[scene.car(spot).character as usize].change.asks_from();
    let request =
        |ask: Ask| Request { urgency: mind.urgency, id: motion.id, chain: spot.chain, x: motion.x, ask };
    let Some(gap) = gap(scene, spot, mind.side) else { return };
    match gap.taken(scene, spot, moment.clock) {
        Ok(()) => outbox.requests.push(request(Ask::Change)),
        Err(Hindrance::InPassage | Hindrance::WantedBefore | Hindrance::NotAllowed) => {}
        Err(_) if f64::from(mind.urgency) < asks_from => {}
        Err(_) => {
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
    }
}

/// Before the crossing a driver goes back if its new leader forces it to brake much harder than its old one.
pub(crate) fn abort_if_it_must(scene: &Scene, spot: Spot, outbox: &mut Outbox) {
    const MUCH_HARDER: f64 = 2.0;
    let (motion, car, mind) = (scene.motion(spot), scene.car(spot), scene.mind(spot));
    let Some(twin) = mind.twin.filter(|_| mind.progress < 0.5) else { return };
    // Back in a lane that ends it could no longer stop before that.
    let left = scene.network.chain(spot.chain).driven_until(car.class.is_long()) - motion.x;
    let ends_here = scene.network.chain(spot.chain).is_lane_drop;
    if ends_here && deceleration_to_avoid(left.max(0.1), motion.speed, 0.0) > MUCH_HARDER {
        return;
    }
    let style = &scene.characters[car.character as usize];
    let forced = |from| {
        scene.ahead(from).map_or(0.0, |it| deceleration_to_avoid(it.gap.max(0.1), motion.speed, it.speed))
    };
    let there = forced(scene.viewpoint_at(scene.viewpoint(spot), twin.chain, twin.x));
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
