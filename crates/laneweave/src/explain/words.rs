//! An account in plain words.

use std::fmt::Write;

use laneweave_models::Concentration;
use laneweave_models::change::{
    Appraisal, GapPair, LaneChangeModel, Mcdm, Refusal, Row, Rule, time_to_collision,
};
use laneweave_network::{Network, Position, Side};
use laneweave_sim::{Account, Act, Hindrance, LaneChangeKind, SideAccount};
use laneweave_study::units::KMH_PER_MPS;

use super::flip::{Flip, Knob};

/// The action of a driver, in one line.
pub fn act(account: &Account) -> String {
    match account.act {
        Act::DrivesOn => "drives on: it does not consider lane changes at this step".into(),
        Act::Stays => stays(account),
        Act::Wants(side, kind) => {
            let why = match kind {
                LaneChangeKind::Discretionary => leading(account, side),
                LaneChangeKind::Route if account.wants_its_last_chance() => {
                    "route-driven, as this is the last place for it".into()
                }
                LaneChangeKind::Route => "route-driven".into(),
                LaneChangeKind::Keeping => "to keep to the slow side".into(),
            };
            format!("wants to change to the {}: {why}", side.name())
        }
        Act::Waits(side, hindrance) => {
            format!("waits for a gap on the {}: {}", side.name(), because(&hindrance))
        }
        Act::Goes(side) => format!("accepts the gap, and starts the change to the {}", side.name()),
        Act::GivesUp(side) => format!("gives up waiting for a gap on the {}", side.name()),
        Act::TakesAnotherRoute => "takes another route".into(),
        Act::Changes(side) => format!("is changing to the {}", side.name()),
        Act::GoesBack(side) => format!("aborts its change to the {}", side.name()),
    }
}

/// Why a driver stays, by the better side.
fn stays(account: &Account) -> String {
    let sides = account.sides.iter().flatten();
    let Some(best) = sides.max_by(|a, b| above(a).total_cmp(&above(b))) else {
        return "stays: there is no adjacent lane to which it may change".into();
    };
    let side = best.side.name();
    if best.is_out_of_question {
        return format!(
            "stays: it is in the cooldown after a change, or after giving one up, for {:.1} s more",
            account.cooldown_left
        );
    }
    if best.appraisal.gain == f64::NEG_INFINITY {
        return format!("stays: a change to the {side} would force the new follower to brake too hard");
    }
    let Row { earning, weight } = best.appraisal.rows[worst(best)];
    let product = weight * earning;
    let against = account.change.row_names()[worst(best)];
    let gain = gain(account, best);
    if is_by_chance(account, best) {
        return format!(
            "stays by chance: G = {:.3} to the {side}, θ = {:.3}; the desire had the probability {:.2} and did not occur",
            best.appraisal.gain, best.appraisal.theta, best.chance
        );
    }
    if product < 0.0 && !against.is_empty() {
        return format!("stays: {gain}; the strongest incentive against it is {against} ({product:.3})");
    }
    format!("stays: {gain}")
}

/// What the gain of a side means for the desire: a probability by the stochastic rule, a threshold by all others.
fn gain(account: &Account, best: &SideAccount) -> String {
    let (side, Appraisal { gain, theta, .. }) = (best.side.name(), best.appraisal);
    match &*account.change {
        LaneChangeModel::Mcdm(Mcdm { rule: Rule::Logit, .. }) => {
            let chance = best.chance;
            format!(
                "G = {gain:.3} to the {side} with θ = {theta:.3}: a desire had the probability {chance:.4} and did not occur"
            )
        }
        _ => format!("G = {gain:.3} to the {side} is not above θ = {theta:.3}"),
    }
}

/// Why a driver stays or waits, in a few words that are the same for many drivers.
pub fn reason(account: &Account) -> String {
    if let Act::Waits(_, hindrance) = account.act {
        return match hindrance {
            Hindrance::Ahead(refusal, _) => format!("waits: the gap to the new leader {}", kind(refusal)),
            Hindrance::Behind(refusal, _) => format!("waits: the gap to the new follower {}", kind(refusal)),
            other => format!("waits: {}", because(&other)),
        };
    }
    let sides = account.sides.iter().flatten();
    let Some(best) = sides.max_by(|a, b| above(a).total_cmp(&above(b))) else {
        return "no adjacent lane to which it may change".into();
    };
    if best.is_out_of_question {
        return "in the cooldown after a change, or after giving one up".into();
    }
    if is_by_chance(account, best) {
        return "by chance: the desire did not occur".into();
    }
    let names = account.change.row_names();
    match best.appraisal.rows[worst(best)] {
        _ if best.appraisal.gain == f64::NEG_INFINITY => {
            "the new follower would have to brake too hard".into()
        }
        row if product(&row) < 0.0 && !names[worst(best)].is_empty() => {
            format!("the gain is too small; the strongest incentive against it is {}", names[worst(best)])
        }
        _ => "the gain is too small".into(),
    }
}

fn kind(refusal: Refusal) -> &'static str {
    match refusal {
        Refusal::Short => "is too short",
        Refusal::TimeToCollision => "closes too soon",
        Refusal::Forced => "closes too fast",
        Refusal::Demanded => "would make the follower brake too hard",
        Refusal::Insecure => "would be too short if the leader braked as hard as possible",
    }
}

fn above(side: &SideAccount) -> f64 {
    if side.is_out_of_question { f64::NEG_INFINITY } else { side.appraisal.gain - side.appraisal.theta }
}

/// Whether only the random number prevented the desire for that side. Above the threshold a desire is only likely if
/// choices are random. A driver who changes without a reason has no threshold.
fn is_by_chance(account: &Account, side: &SideAccount) -> bool {
    let needs_no_reason = matches!(&*account.change, LaneChangeModel::ConstantHazard(_));
    above(side) > 0.0 || (needs_no_reason && side.chance > 0.0)
}

fn product(row: &Row) -> f64 {
    row.weight * row.earning
}

/// The row with the largest contribution against a side.
fn worst(side: &SideAccount) -> usize {
    let rows = side.appraisal.rows.iter().enumerate();
    rows.min_by(|a, b| product(a.1).total_cmp(&product(b.1))).map_or(0, |(index, _)| index)
}

/// The row with the largest contribution in favour of the desired side.
fn leading(account: &Account, side: Side) -> String {
    let Some(wanted) = account.sides.iter().flatten().find(|it| it.side == side) else {
        return String::new();
    };
    let names = account.change.row_names();
    match wanted.appraisal.leading() {
        Some(index) if !names[index].is_empty() => {
            let speeds = [wanted.situation.here.anticipated_speed, wanted.situation.there.anticipated_speed];
            let [here, there] = speeds.map(|it| it * KMH_PER_MPS);
            let seen = if names[index] == "speed" {
                format!(", {here:.0} km/h here and {there:.0} km/h there")
            } else {
                String::new()
            };
            format!(
                "the leading incentive is {} ({:.3}{seen})",
                names[index],
                product(&wanted.appraisal.rows[index])
            )
        }
        _ => "by chance, without a reason".into(),
    }
}

fn because(hindrance: &Hindrance) -> String {
    match hindrance {
        Hindrance::NotAllowed => "a change is not allowed here".into(),
        Hindrance::TooLittleRoad => {
            "a change is not allowed for as long as it takes to cross the line".into()
        }
        Hindrance::Junction => {
            "the change would not be completed before a junction, or would take storage space that others need".into()
        }
        Hindrance::InReservation => "it is driving through a junction".into(),
        Hindrance::RequestedBefore => "a vehicle at a junction has waited longer for the storage space there".into(),
        Hindrance::Ahead(refusal, pair) => format!("the gap to the new leader {}", refused(*refusal, pair)),
        Hindrance::Behind(refusal, pair) => {
            format!("the gap to the new follower {}", refused(*refusal, pair))
        }
    }
}

fn refused(refusal: Refusal, pair: &GapPair) -> String {
    let GapPair { gap, follower, leader, demanded } = *pair;
    match refusal {
        Refusal::Short => format!("is {gap:.1} m, too short"),
        Refusal::TimeToCollision => {
            format!("of {gap:.1} m closes in {:.1} s", time_to_collision(gap, follower, leader))
        }
        Refusal::Forced => format!("of {gap:.1} m closes too fast: {follower:.1} m/s behind {leader:.1} m/s"),
        Refusal::Demanded => format!("of {gap:.1} m would make the follower brake by {:.1} m/s²", -demanded),
        Refusal::Insecure => {
            format!("of {gap:.1} m would be too short if the leader braked as hard as possible")
        }
    }
}

/// The whole account: place and state of the driver, its appraisal of both sides, and its action.
pub fn story(account: &Account, network: &Network, position: (f64, f64), flips: &[Flip]) -> String {
    let mut text = String::new();
    let (x, speed) = position;
    let (lanelet, along) = network.lanelet_at(Position::new(account.spot.chain, x));
    let mut say = |line: String| {
        // Writing to a string never fails.
        let _ = writeln!(text, "{line}");
    };
    let attends = match account.state {
        Concentration::Concentrated => "",
        Concentration::Inattentive => ", inattentive",
    };
    say(format!(
        "vehicle {} ({}{attends}) at {:.1} s on lanelet {}, {along:.1} m, {:.1} km/h",
        account.vehicle,
        account.style.name,
        account.time,
        lanelet.id,
        speed * KMH_PER_MPS
    ));
    say(format!("  {}", act(account)));
    if let Some(ahead) = account.stays_behind {
        say(format!(
            "  stays behind the vehicle in the overtaking lane ({:.1} m ahead, {:.1} km/h): by law nobody passes it on this side",
            ahead.gap,
            ahead.speed * KMH_PER_MPS
        ));
    }
    for side in account.sides.iter().flatten() {
        table(account, side).into_iter().for_each(&mut say);
    }
    let is_drawn = matches!(account.act, Act::Stays | Act::Wants(..)) && !account.wants_its_last_chance();
    if is_drawn && account.sides.iter().flatten().next().is_some() {
        say(format!("  random number {:.4}", account.draw));
    }
    let pairings = account.pairings.into_iter().zip(account.gaps);
    for (who, (pairing, gap)) in ["ahead", "behind"].into_iter().zip(pairings) {
        if let Some(it) = pairing {
            let (follower, leader) = (it.follower.pace.speed, it.leader.speed);
            let ttc = time_to_collision(it.leader.gap, follower, leader);
            let closes = if ttc.is_finite() { format!(", closes in {ttc:.1} s") } else { String::new() };
            let truth = gap.filter(|gap| *gap != it.leader.gap);
            let truth = truth.map_or(String::new(), |gap| format!(", in truth {gap:.1} m"));
            say(format!(
                "  gap {who}  {:.1} m{closes} ({:.1} km/h behind {:.1} km/h){truth}",
                it.leader.gap,
                follower * KMH_PER_MPS,
                leader * KMH_PER_MPS
            ));
        }
    }
    for (number, flip) in flips.iter().enumerate() {
        let lead = if number == 0 { "  would have changed it" } else { "                    or" };
        say(format!("{lead}: {}", flip_in_words(account, flip)));
    }
    text
}

/// The rows of one side.
fn table(account: &Account, side: &SideAccount) -> Vec<String> {
    let mut lines = vec![format!("  {:<8} {:>9} × {:>7} = {:>8}", side.side.name(), "yield", "weight", "")];
    for (row, title) in side.appraisal.rows.iter().zip(account.change.row_names()) {
        if !title.is_empty() && row.weight != 0.0 {
            lines.push(format!(
                "    {title:<14} {:>9.4} × {:>5.2} = {:>8.4}",
                row.earning,
                row.weight,
                product(row)
            ));
        }
    }
    let chance = match (&*account.change, account.act) {
        _ if account.wants_its_last_chance() => String::new(),
        (_, Act::Stays | Act::Wants(..)) if side.is_out_of_question => ", in cooldown".to_string(),
        (LaneChangeModel::Mcdm(_) | LaneChangeModel::ConstantHazard(_), Act::Stays | Act::Wants(..)) => {
            format!(", desire with probability {:.4}", side.chance)
        }
        _ => String::new(),
    };
    lines.push(format!("    G {:.4}, θ {:.4}{chance}", side.appraisal.gain, side.appraisal.theta));
    lines
}

/// The flips of a decision, each with the new decision.
pub(crate) fn flip_in_words(account: &Account, flip: &Flip) -> String {
    let Flip { knob, value, by, to } = flip;
    let what = match knob {
        Knob::Weight(row) => format!("the weight of {}", account.change.row_names()[*row]),
        Knob::SpeedHere => "the anticipated speed in its lane [m/s]".into(),
        Knob::SpeedThere(side) => format!("the anticipated speed on the {} [m/s]", side.name()),
        Knob::GapAhead => "the gap to the new leader [m]".into(),
        Knob::GapBehind => "the gap to the new follower [m]".into(),
        Knob::OwnSpeed => "its own speed [m/s]".into(),
        Knob::LeaderSpeed => "the new leader's speed [m/s]".into(),
        Knob::FollowerSpeed => "the new follower's speed [m/s]".into(),
    };
    let then = match (account.act, to) {
        (Act::Waits(..), _) => "it would have started the change".to_string(),
        (Act::Goes(_), _) => "it would have waited".into(),
        (_, Some(side)) => format!("it would have wanted to change to the {}", side.name()),
        (_, None) => "it would have stayed in its lane".into(),
    };
    format!("{what} {:.4} instead of {value:.4} ({by:+.4}): {then}", value + by)
}
