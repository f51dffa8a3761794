//! Flips: the smallest change of one number that would have changed a decision.
//!
//! A gain is linear in the weights, so for each weight there is at most one point on either side where the decision
//! changes. Bisection finds it to the last bit; this also works for speeds and gaps, and for two sides that compete.

use laneweave_models::change::{Appraisal, Driver, Row, Situation};
use laneweave_models::follow::{Ahead, Pace};
use laneweave_network::Side;
use laneweave_sim::{Account, Act, Hindrance, Pairing, SideAccount};

/// A number on which a decision depends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Knob {
    /// Weight of the incentive of this row.
    Weight(usize),
    /// Speed anticipated in the own lane [m/s].
    SpeedHere,
    /// Speed anticipated in the lane on that side [m/s].
    SpeedThere(Side),
    /// Gap to the new leader [m].
    GapAhead,
    /// Gap to the new follower [m].
    GapBehind,
    /// The driver's own speed [m/s].
    OwnSpeed,
    /// Speed of the new leader [m/s].
    LeaderSpeed,
    /// Speed of the new follower [m/s].
    FollowerSpeed,
}

/// A change that changes the decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flip {
    /// The number.
    pub knob: Knob,
    /// Its value.
    pub value: f64,
    /// By how much it would have to be larger or smaller; half of that would not be enough.
    pub by: f64,
    /// The side to which the driver would have changed; `None`: it would have stayed, or waited.
    pub to: Option<Side>,
}

impl Flip {
    /// Size of the change relative to the number.
    pub fn relative(&self) -> f64 {
        self.by.abs() / self.value.abs().max(f64::MIN_POSITIVE)
    }
}

/// The flips of the decision in `account`, made with time step `dt` [s]: the change that is smallest relative to its
/// number first. Empty where there was nothing to decide, or where no single number decides.
pub fn flips(account: &Account, dt: f64) -> Vec<Flip> {
    let mut found = match account.act {
        // At the last place for a change no single number decides.
        Act::Wants(..) if account.wants_its_last_chance() => Vec::new(),
        Act::Stays | Act::Wants(..) => of_desire(account),
        Act::Goes(side) | Act::Waits(side, Hindrance::Ahead(..) | Hindrance::Behind(..)) => {
            of_gap(account, side, dt)
        }
        _ => Vec::new(),
    };
    found.sort_by(|a, b| a.relative().total_cmp(&b.relative()));
    found
}

/// The sides that the driver considers.
fn weighed<'s, 'a>(account: &'s Account<'a>) -> [Option<&'s SideAccount<'a>>; 2] {
    account.sides.each_ref().map(|it| it.as_ref().filter(|it| !it.is_out_of_question))
}

/// The desired side with these appraisals.
fn desired(account: &Account, appraised: impl Fn(&SideAccount) -> Appraisal) -> Option<Side> {
    let sides = weighed(account);
    let appraisals = sides.map(|it| it.map(&appraised));
    let drawn = account.change.drawn(appraisals.each_ref().map(Option::as_ref), account.epochs, account.draw);
    drawn.and_then(|it| sides[it]).map(|it| it.side)
}

fn of_desire(account: &Account) -> Vec<Flip> {
    let sides = weighed(account);
    let Some(any) = sides.into_iter().flatten().next() else { return Vec::new() };
    let mut flips = Vec::new();
    for (row, Row { weight, .. }) in any.appraisal.rows.iter().enumerate() {
        if sides.into_iter().flatten().all(|it| it.appraisal.rows[row].earning == 0.0) {
            continue;
        }
        let outcome = |by| desired(account, |it| with_weight(account, it, row, by));
        // A weight stays at least zero, unless it is already negative.
        flips.extend(flip(Knob::Weight(row), *weight, [-weight.max(0.0), f64::INFINITY], outcome));
    }
    let desired_speed = any.situation.me.pace.desired;
    let bounds = |speed: f64| [-speed, desired_speed - speed];
    let here = any.situation.here.anticipated_speed;
    let outcome = |by| {
        desired(account, |it| reappraised(account, it, |situation| situation.here.anticipated_speed += by))
    };
    flips.extend(flip(Knob::SpeedHere, here, bounds(here), outcome));
    for side in sides.into_iter().flatten() {
        let there = side.situation.there.anticipated_speed;
        let outcome = |by| {
            desired(account, |it| {
                reappraised(account, it, |situation| {
                    situation.there.anticipated_speed += if it.side == side.side { by } else { 0.0 };
                })
            })
        };
        flips.extend(flip(Knob::SpeedThere(side.side), there, bounds(there), outcome));
    }
    flips
}

/// The appraisal of a side with the weight of the incentive of `row` changed by `by`.
fn with_weight(account: &Account, side: &SideAccount, row: usize, by: f64) -> Appraisal {
    let mut rows = side.appraisal.rows;
    rows[row].weight += by;
    // A side that is excluded for another reason stays excluded.
    let gain = if side.appraisal.gain.is_finite() { account.change.gain(&rows) } else { side.appraisal.gain };
    Appraisal { rows, gain, ..side.appraisal }
}

/// The appraisal of a side with one number changed.
fn reappraised(account: &Account, side: &SideAccount, change: impl Fn(&mut Situation)) -> Appraisal {
    let mut situation = side.situation;
    change(&mut situation);
    account.change.appraise(&situation)
}

fn of_gap(account: &Account, side: Side, dt: f64) -> Vec<Flip> {
    let with_speed = |it: Pairing<'_>, by: f64| -> f64 { it.follower.pace.speed + by };
    let safety = [account.style.safety, account.style.safety.of_follower()];
    let suits =
        |which: usize, it: Option<Pairing>| it.is_none_or(|it| it.accepted(&safety[which], dt).is_ok());
    let goes = |change: &dyn Fn(&mut [Option<Pairing>; 2])| {
        let mut pairings = account.pairings;
        change(&mut pairings);
        (suits(0, pairings[0]) && suits(1, pairings[1])).then_some(side)
    };
    let paced = |pairing: Pairing<'_>, speed: f64| Pace { speed, ..pairing.follower.pace };
    let [ahead, behind] = account.pairings;
    let mut flips = Vec::new();
    const FAR: f64 = 1000.0;
    if let Some(it) = ahead {
        let gap = |by: f64| goes(&|all| all[0].iter_mut().for_each(|it| it.leader.gap += by));
        flips.extend(flip(Knob::GapAhead, it.leader.gap, [-FAR, FAR], gap));
        let speed = |by: f64| goes(&|all| all[0].iter_mut().for_each(|it| it.leader.speed += by));
        flips.extend(flip(Knob::LeaderSpeed, it.leader.speed, [-it.leader.speed, FAR], speed));
    }
    if let Some(it) = behind {
        let gap = |by: f64| goes(&|all| all[1].iter_mut().for_each(|it| it.leader.gap += by));
        flips.extend(flip(Knob::GapBehind, it.leader.gap, [-FAR, FAR], gap));
        let of = it.follower.pace.speed;
        let speed = |by: f64| {
            goes(&|all| {
                all[1].iter_mut().for_each(|it| it.follower.pace = paced(*it, with_speed(*it, by)));
            })
        };
        flips.extend(flip(Knob::FollowerSpeed, of, [-of, FAR], speed));
    }
    let own = ahead.map(|it| it.follower.pace.speed).or(behind.map(|it| it.leader.speed));
    if let Some(own) = own {
        let slower_ahead = |by: f64| {
            ahead.map(|it| Pairing { follower: Driver { pace: paced(it, own + by), ..it.follower }, ..it })
        };
        let faster_behind =
            |by: f64| behind.map(|it| Pairing { leader: Ahead { speed: own + by, ..it.leader }, ..it });
        let goes = |by: f64| {
            (suits(0, slower_ahead(by)) && suits(1, faster_behind(by)) && own + by <= account.fastest)
                .then_some(side)
        };
        // A lower speed is better for the gap ahead, a higher speed for the gap behind. If one of the gaps is
        // refused, only its own limit can be the flip, and the other gap has to be accepted there.
        let found = match account.act {
            Act::Waits(_, Hindrance::Ahead(..)) => {
                flip(Knob::OwnSpeed, own, [-own, FAR], |by| suits(0, slower_ahead(by)).then_some(side))
            }
            Act::Waits(..) => {
                flip(Knob::OwnSpeed, own, [-own, FAR], |by| suits(1, faster_behind(by)).then_some(side))
            }
            _ => flip(Knob::OwnSpeed, own, [-own, FAR], goes),
        };
        let turns = |it: &Flip| goes(it.by) != goes(0.0);
        flips.extend(found.filter(turns));
    }
    flips
}

/// The smaller of the changes of `knob`, up and down from `value` within `bounds`, that changes the `outcome`.
fn flip(
    knob: Knob,
    value: f64,
    [least, most]: [f64; 2],
    outcome: impl Fn(f64) -> Option<Side>,
) -> Option<Flip> {
    let now = outcome(0.0);
    let up = turning_point(most, |by| outcome(by) != now);
    let down = turning_point(-least, |by| outcome(-by) != now).map(|by| -by);
    let nearest = [up, down].into_iter().flatten().min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    Some(Flip { knob, value, by: nearest, to: outcome(nearest) })
}

/// The smallest positive number up to `most`, to the last bit, for which `turns` holds but not for its half.
fn turning_point(most: f64, turns: impl Fn(f64) -> bool) -> Option<f64> {
    const LEAST: f64 = 1e-6;
    const DOUBLINGS: i32 = 40;
    let grid = (0..DOUBLINGS).map(|it| LEAST * f64::from(2.0_f32).powi(it)).take_while(|it| *it < most);
    let last = Some(most).filter(|it| it.is_finite() && *it > 0.0);
    let mut beyond = grid.chain(last).find(|by| turns(*by))?;
    loop {
        let mut before = 0.5 * beyond;
        while turns(before) {
            (before, beyond) = (0.5 * before, before);
            if before < f64::MIN_POSITIVE {
                return None;
            }
        }
        loop {
            let middle = 0.5 * (before + beyond);
            if middle <= before || middle >= beyond {
                break;
            }
            if turns(middle) { beyond = middle } else { before = middle }
        }
        if !turns(0.5 * beyond) {
            return Some(beyond);
        }
        beyond *= 0.5;
    }
}
