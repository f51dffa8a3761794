//! What a driver makes of its lanes at an instant, and what it is about to do in the next step: told without moving
//! anything, so that a run can be asked for its reasons whenever it is repeated.

use std::borrow::Cow;

use laneweave_models::change::{Appraisal, LaneChangeModel, Situation, at_least_once_in};
use laneweave_models::{Concentration, Style};
use laneweave_network::Side;

use crate::driver::choice::is_out_of_question;
use crate::driver::consider::{consider, has_last_chance, look, waypoint};
use crate::driver::decide::{abort_if_it_must, go_or_ask};
use crate::driver::gap::{Hindrance, Pairing, gap};
use crate::driver::me::{Attending, Me};
use crate::driver::plan::{Ask, Outbox, Plan};
use crate::state::lane::{Kind, Phase, VehicleId};
use crate::state::moment::Moment;
use crate::state::random::Purpose;
use crate::step::world::World;
use crate::view::scene::{Scene, Spot};

/// What a driver makes of its lanes.
#[derive(Debug)]
pub struct Account<'a> {
    /// Who.
    pub vehicle: VehicleId,
    /// When [s].
    pub time: f64,
    /// Where its main entry stands.
    pub spot: Spot,
    /// Its driver parameters.
    pub style: &'a Style,
    /// Whether it attends.
    pub state: Concentration,
    /// Its lane-change model in that state.
    pub change: Cow<'a, LaneChangeModel>,
    /// The sides to which it may change, that for overtaking first.
    pub sides: [Option<SideAccount<'a>>; 2],
    /// For so long it makes no voluntary change after the last one [s].
    pub cooldown_left: f64,
    /// Epochs that pass from one turn to the next.
    pub epochs: f64,
    /// It comes to the last place for a change that it has to make, which it then wants whatever it makes of it.
    pub has_last_chance: bool,
    /// What was drawn for this turn, evenly from [0, 1).
    pub draw: f64,
    /// What it does.
    pub act: Act,
    /// The gap that it waits for, if it does: with its new leader, and with its new follower.
    pub pairings: [Option<Pairing<'a>>; 2],
    /// The highest own speed for which the road left does for that change [m/s].
    pub fastest: f64,
}

impl Account<'_> {
    /// It wants the change that it has to make at its last place, not by what it makes of it.
    pub fn wants_its_last_chance(&self) -> bool {
        let helps = |side: Side| {
            let mut sides = self.sides.iter().flatten().filter(|it| it.side == side);
            sides.any(|it| it.situation.there.route.changes < it.situation.here.route.changes)
        };
        self.has_last_chance && matches!(self.act, Act::Wants(side, _) if helps(side))
    }
}

/// A side to which a driver may change.
#[derive(Debug)]
pub struct SideAccount<'a> {
    /// Which.
    pub side: Side,
    /// What the driver sees.
    pub situation: Situation<'a>,
    /// What it makes of it.
    pub appraisal: Appraisal,
    /// Chance that the desire for this side comes at this turn; 0 while the driver is calm and its route does not press
    /// it.
    pub chance: f64,
    /// It does not weigh the side, as it is calm.
    pub is_out_of_question: bool,
}

/// What a driver does in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// Drives on: it is not its turn to consider lanes.
    DrivesOn,
    /// Considers lanes, and stays.
    Stays,
    /// Begins to want to change.
    Wants(Side, Kind),
    /// Waits for a gap, for this reason.
    Waits(Side, Hindrance),
    /// Has found its gap, and asks to go: it does unless another takes the gap before it.
    Goes(Side),
    /// Gives up waiting.
    GivesUp(Side),
    /// Leaves its route for another: a better one, or any other where its own is lost.
    TakesAnotherRoute,
    /// Is on its way across.
    Changes(Side),
    /// Calls its change off, or is on its way back.
    GoesBack(Side),
}

/// What the driver of the vehicle at `spot` makes of its lanes now, and does in the next step.
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
        pairings: found.map_or([None; 2], |it| it.pairings(&scene, spot)),
        fastest: found.map_or(f64::INFINITY, |it| it.fastest(&scene, spot)),
    }
}

/// What the driver at `spot` does: it decides as in a step, and what it writes down is read.
fn act(scene: &Scene, moment: Moment, spot: Spot) -> Act {
    let (driver, side) = (scene.driver(spot), scene.lane_change(spot).side);
    let is_turn = driver.due <= moment.clock.step;
    let (mut plan, mut outbox) = (Plan::default(), Outbox::default());
    match driver.phase {
        Phase::Changes => {
            abort_if_it_must(scene, spot, &mut outbox);
            return if outbox.requests.is_empty() { Act::Changes(side) } else { Act::GoesBack(side) };
        }
        Phase::Aborts => return Act::GoesBack(side),
        Phase::Cruises | Phase::Wants => {}
    }
    if driver.phase == Phase::Wants {
        go_or_ask(scene, moment, spot, &mut outbox);
    }
    if is_turn {
        consider(scene, moment, spot, &mut [0; 2], &mut plan, &mut outbox);
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
