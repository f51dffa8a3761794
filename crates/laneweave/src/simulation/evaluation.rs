//! What a driver makes of its lanes, as plain data. [`Simulation::explain`] says the same in words.

use std::borrow::Cow;

use laneweave_models::Concentration;
use laneweave_models::change::{Appraisal, LaneChangeModel};
use laneweave_network::Side;
use laneweave_sim::{Account, Act, LaneChangeKind, Phase, SideAccount, Spot, VehicleId, World};
use serde::{Deserialize, Serialize};

use super::Simulation;

/// What a driver makes of its lanes at this instant, and is about to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// The vehicle whose driver was asked.
    pub vehicle: VehicleId,
    /// Time [s].
    pub time_s: f64,
    /// The style of its driver.
    pub style: String,
    /// Whether the driver is concentrated; otherwise it is inattentive.
    pub is_concentrated: bool,
    /// The phase of its lane change.
    pub state: Phase,
    /// The vehicle ahead, if one is in sight.
    pub leader: Option<Leader>,
    /// The sides to which it may change, the side for overtaking first.
    pub sides: Vec<SideEvaluation>,
    /// Remaining time in which it makes no discretionary change [s].
    pub cooldown_s: f64,
    /// Whether it comes to the last place for a necessary change, which it then wants whatever its utility.
    pub has_last_chance: bool,
    /// What it does in the next step.
    pub decision: Decision,
}

/// What a driver does in the next step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "decision", rename_all = "snake_case")]
pub enum Decision {
    /// It drives on: this is not its turn to consider lanes.
    DrivesOn,
    /// It considers lanes, and stays.
    Stays,
    /// It begins to want a change.
    Wants {
        /// To this side.
        side: Side,
        /// The kind of the change.
        kind: LaneChangeKind,
    },
    /// It waits for a gap.
    Waits {
        /// On this side.
        side: Side,
    },
    /// It has found a gap, and asks to change. It changes unless another driver takes the gap first.
    Goes {
        /// To this side.
        side: Side,
    },
    /// It gives up waiting.
    GivesUp {
        /// For a gap on this side.
        side: Side,
    },
    /// It takes another route.
    TakesAnotherRoute,
    /// It is changing lanes.
    Changes {
        /// To this side.
        side: Side,
    },
    /// It aborts its change, or is on its way back.
    GoesBack {
        /// From this side.
        side: Side,
    },
}

impl From<Act> for Decision {
    fn from(act: Act) -> Decision {
        match act {
            Act::DrivesOn => Decision::DrivesOn,
            Act::Stays => Decision::Stays,
            Act::Wants(side, kind) => Decision::Wants { side, kind },
            Act::Waits(side, _) => Decision::Waits { side },
            Act::Goes(side) => Decision::Goes { side },
            Act::GivesUp(side) => Decision::GivesUp { side },
            Act::TakesAnotherRoute => Decision::TakesAnotherRoute,
            Act::Changes(side) => Decision::Changes { side },
            Act::GoesBack(side) => Decision::GoesBack { side },
        }
    }
}

/// The vehicle ahead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Leader {
    /// Its id.
    pub vehicle: VehicleId,
    /// Gap to it [m].
    pub gap_m: f64,
    /// Its speed [m/s].
    pub speed_mps: f64,
}

/// A side to which a driver may change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SideEvaluation {
    /// The side of the lane to which it would change.
    pub side: Side,
    /// G: the utility of the change. `None`: safety forbids it.
    pub utility: Option<f64>,
    /// θ: the threshold of the utility.
    pub threshold: f64,
    /// Probability that the desire for this side arises at this turn of the driver.
    pub probability: f64,
    /// Whether the driver considers the side. It does not in its cooldown.
    pub is_considered: bool,
    /// The incentives, with what each contributes.
    pub reasons: Vec<Reason>,
}

/// An incentive of a lane change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reason {
    /// Its name, such as speed or route.
    pub incentive: Cow<'static, str>,
    /// Y: its yield.
    #[serde(rename = "yield")]
    pub earning: f64,
    /// μ: its weight.
    pub weight: f64,
}

impl Reason {
    /// The incentives of an appraisal by `model`. Those without a name in the model are left out.
    pub(super) fn of(model: &LaneChangeModel, appraisal: &Appraisal) -> Vec<Reason> {
        let named = appraisal.rows.iter().zip(model.row_names()).filter(|(_, name)| !name.is_empty());
        named
            .map(|(row, name)| Reason { incentive: name.into(), earning: row.earning, weight: row.weight })
            .collect()
    }

    /// What it contributes to the utility: μ·Y.
    pub fn contribution(&self) -> f64 {
        self.weight * self.earning
    }
}

impl SideEvaluation {
    fn of(account: &Account, side: &SideAccount) -> SideEvaluation {
        SideEvaluation {
            side: side.side,
            utility: Some(side.appraisal.gain).filter(|it| it.is_finite()),
            threshold: side.appraisal.theta,
            probability: side.chance,
            is_considered: !side.is_out_of_question,
            reasons: Reason::of(&account.change, &side.appraisal),
        }
    }
}

impl Simulation {
    /// What the driver of a vehicle makes of its lanes, and is about to do. `None` if the vehicle is in no lane.
    pub fn evaluate(&self, id: VehicleId) -> Option<Evaluation> {
        let world = self.world();
        let vehicle = world.vehicle(id).filter(|it| it.is_in_lane())?;
        let account = laneweave_sim::explain(world, vehicle.spot);
        Some(Evaluation {
            vehicle: id,
            time_s: account.time,
            style: account.style.name.clone(),
            is_concentrated: account.state == Concentration::Concentrated,
            state: vehicle.driver.phase,
            leader: leader(world, vehicle.spot),
            sides: account.sides.iter().flatten().map(|it| SideEvaluation::of(&account, it)).collect(),
            cooldown_s: account.cooldown_left,
            has_last_chance: account.has_last_chance,
            decision: account.act.into(),
        })
    }

    /// What the driver of a vehicle does in the next step, and why, in a line. `None` if the vehicle is in no lane.
    pub fn decision_in_words(&self, id: VehicleId) -> Option<String> {
        let vehicle = self.world().vehicle(id).filter(|it| it.is_in_lane())?;
        Some(crate::explain::act(&laneweave_sim::explain(self.world(), vehicle.spot)))
    }

    /// The vehicle ahead of another one on its way. `None` if none is in sight.
    pub fn leader(&self, id: VehicleId) -> Option<Leader> {
        let vehicle = self.world().vehicle(id).filter(|it| it.is_in_lane())?;
        leader(self.world(), vehicle.spot)
    }
}

fn leader(world: &World, spot: Spot) -> Option<Leader> {
    let scene = world.scene();
    let from = scene.viewpoint(spot);
    let ahead = scene.ahead(from)?;
    let leader = scene.motion(scene.leader_spot(from)?);
    Some(Leader { vehicle: leader.id, gap_m: ahead.gap, speed_mps: ahead.speed })
}
