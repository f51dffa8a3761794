//! A driver's view of its lanes at an instant, and what it will do in the next step. Nothing moves, so that a
//! repeated run can be asked for its reasons at any time.

use std::borrow::Cow;

use laneweave_models::change::{Appraisal, LaneChangeModel, Situation, at_least_once_in};
use laneweave_models::follow::Ahead;
use laneweave_models::{Concentration, Style};
use laneweave_network::Side;

use crate::driver::choice::is_out_of_question;
use crate::driver::consider::{has_last_chance, look, waypoint};
use crate::driver::decide::decide_one;
use crate::driver::fall_in::stays_behind;
use crate::driver::gap::{Hindrance, Pairing, gap};
use crate::driver::me::{Attending, Me};
use crate::driver::plan::{Ask, Outbox, Plan};
use crate::state::lane::{LaneChangeKind, Phase, VehicleId};
use crate::state::moment::Moment;
use crate::state::random::Purpose;
use crate::step::world::World;
use crate::view::scene::{Scene, Spot};

/// A driver's account of its lanes.
#[derive(Debug)]
pub struct Account<'a> {
    /// The vehicle.
    pub vehicle: VehicleId,
    /// Time [s].
    pub time: f64,
    /// Position of its main entry.
    pub spot: Spot,
    /// Its driver parameters.
    pub style: &'a Style,
    /// Whether the driver is concentrated or inattentive.
    pub state: Concentration,
    /// Its lane-change model in that state.
    pub change: Cow<'a, LaneChangeModel>,
    /// The sides to which it may change, the side for overtaking first.
    pub sides: [Option<SideAccount<'a>>; 2],
    /// Remaining time of the cooldown, in which it makes no discretionary change [s].
    pub cooldown_left: f64,
    /// Epochs from one turn to the next.
    pub epochs: f64,
    /// It comes to the last place for a necessary change, which it then wants whatever its appraisal.
    pub has_last_chance: bool,
    /// The random number of this turn, uniform in (0, 1).
    pub draw: f64,
    /// What it does in the next step.
    pub act: Act,
    /// The leader in the overtaking lane that it would pass, but may not by the law of the map.
    pub stays_behind: Option<Ahead>,
    /// The pairings in the gap that it waits for, if it waits, as it sees them: with its new leader, and with its new
    /// follower.
    pub pairings: [Option<Pairing<'a>>; 2],
    /// The true gaps of these pairings [m].
    pub gaps: [Option<f64>; 2],
    /// The highest own speed at which the road is long enough for that change [m/s].
    pub fastest: f64,
}

impl Account<'_> {
    /// Whether it wants the change because this is its last chance, not because of its appraisal.
    pub fn wants_its_last_chance(&self) -> bool {
        let helps = |side: Side| {
            let mut sides = self.sides.iter().flatten().filter(|it| it.side == side);
            sides.any(|it| it.situation.there.route.changes < it.situation.here.route.changes)
        };
        self.has_last_chance && matches!(self.act, Act::Wants(side, _) if helps(side))
    }
}

/// A side to which a driver may change, and the driver's appraisal of it.
#[derive(Debug)]
pub struct SideAccount<'a> {
    /// The side.
    pub side: Side,
    /// What the driver sees.
    pub situation: Situation<'a>,
    /// Its appraisal.
    pub appraisal: Appraisal,
    /// Probability that the desire for this side arises at this turn. It is 0 in the cooldown, unless the side helps
    /// the route.
    pub chance: f64,
    /// It does not consider the side, because it is in the cooldown.
    pub is_out_of_question: bool,
}

/// What a driver does in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// It drives on: this is not its turn to consider lanes.
    DrivesOn,
    /// It considers lanes, and stays.
    Stays,
    /// It begins to want a change.
    Wants(Side, LaneChangeKind),
    /// It waits for a gap, for this reason.
    Waits(Side, Hindrance),
    /// It has found a gap, and asks to change. It changes unless another driver takes the gap first.
    Goes(Side),
    /// It gives up waiting.
    GivesUp(Side),
    /// It takes another route: a better one, or any other if it can no longer follow its own.
    TakesAnotherRoute,
    /// It is changing lanes.
    Changes(Side),
    /// It aborts its change, or is on its way back.
    GoesBack(Side),
}

/// A driver's account: the vehicle at `spot`, its lanes now, and what it does in the next step.
pub fn explain(world: &World, spot: Spot) -> Account<'_> {
    let scene = world.scene();
    let overtaking = scene.network.driving_side.overtaking();
    let clock = world.clock();
    let moment = Moment { clock, random: world.random(), overtaking };
    let me = Me::at(&scene, spot);
    let Me { motion, driver, lane_change, style, .. } = me;
    let attending = Attending::of(&me, moment);
    let change = attending.model(style);
    let waypoint = waypoint(&scene, &me);
    let mut hints = Side::BOTH.map(|side| {
        let beside = scene.network.chain(spot.chain).beside(side, motion.x);
        beside.map_or(0, |it| scene.lanes[it.chain.at()].ahead_of(it.across(motion.x)))
    });
    let perception = look(&scene, moment, &me, &attending, &waypoint, &mut hints);
    let mut sides = [overtaking, overtaking.opposite()].map(|side| {
        let situation = perception.situation(side, perception.beside(side)?);
        let appraisal = change.appraise(&situation);
        let is_out_of_question = is_out_of_question(driver, moment, &situation);
        Some(SideAccount { side, situation, appraisal, chance: 0.0, is_out_of_question })
    });
    let weighed =
        sides.each_ref().map(|it| it.as_ref().filter(|it| !it.is_out_of_question).map(|it| &it.appraisal));
    let chances = change.choose(weighed).map(|it| at_least_once_in(attending.epochs, it));
    for (side, chance) in sides.iter_mut().zip(chances) {
        side.iter_mut().for_each(|it| it.chance = chance);
    }
    let found = (driver.phase == Phase::Wants).then(|| gap(&scene, spot, lane_change.side)).flatten();
    Account {
        vehicle: motion.id,
        time: clock.time(),
        spot,
        style,
        state: attending.state,
        has_last_chance: has_last_chance(&style.change, motion, &waypoint),
        change,
        sides,
        cooldown_left: f64::from(driver.cooldown_until.saturating_sub(clock.step)) * clock.dt,
        epochs: attending.epochs,
        draw: moment.random.uniform(motion.id, Purpose::Desire, clock.step),
        act: act(&scene, moment, spot),
        stays_behind: stays_behind(&scene, spot),
        pairings: found.map_or([None; 2], |it| it.seen(&scene, spot, clock.time())),
        gaps: found.map_or([None; 2], |it| it.pairings(&scene, spot).map(|it| it.map(|it| it.leader.gap))),
        fastest: found.map_or(f64::INFINITY, |it| it.fastest(&scene, spot)),
    }
}

/// What the driver at `spot` does. It decides as in a step, and its plan is read.
fn act(scene: &Scene, moment: Moment, spot: Spot) -> Act {
    let (driver, side) = (scene.driver(spot), scene.lane_change(spot).side);
    let is_turn = driver.due <= moment.clock.step;
    let (mut plan, mut outbox) = (Plan::default(), Outbox::default());
    decide_one(scene, moment, spot, &mut [0; 2], &mut plan, &mut outbox);
    match driver.phase {
        Phase::Changes if outbox.requests.is_empty() => return Act::Changes(side),
        Phase::Changes | Phase::Aborts => return Act::GoesBack(side),
        Phase::Cruises | Phase::Wants => {}
    }
    let concern = plan.concerns.first();
    let wants = outbox.requests.iter().find_map(|it| match it.ask {
        Ask::Want(want) => Some(Act::Wants(want.side, want.kind)),
        _ => None,
    });
    let goes = || outbox.requests.iter().any(|it| matches!(it.ask, Ask::Change));
    if concern.is_some_and(|it| it.rerouted.is_some()) {
        return Act::TakesAnotherRoute;
    }
    match driver.phase {
        Phase::Wants if concern.is_some_and(|it| it.gives_up) => Act::GivesUp(side),
        Phase::Wants if goes() => Act::Goes(side),
        Phase::Wants => {
            let found = gap(scene, spot, side).ok_or(Hindrance::NotAllowed);
            match found.and_then(|it| it.taken(scene, spot, moment.clock)) {
                Ok(()) => Act::Goes(side),
                Err(hindrance) => Act::Waits(side, hindrance),
            }
        }
        _ if !is_turn => Act::DrivesOn,
        _ => wants.unwrap_or(Act::Stays),
    }
}
