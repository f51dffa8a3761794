//! The likelihood of one driver for each pair of critical gaps on a grid: free → wants a side → changes, by the forward
//! algorithm. The distribution of critical gaps stands outside of it: to change it costs next to nothing.

use super::offered::{GapSpell, Offered};
use crate::waiting::logistic;

/// Number of critical gaps on the grid.
pub(super) const GRID: usize = 17;
/// The logarithms of the least one [ln m], and of the ratio of two that are neighbours: 1 to 55 m (ours).
const FIRST: f64 = 0.0;
const STEP: f64 = 0.25;
/// Scale of the logistic curve by which gaps near the critical one are accepted, in logarithms: errors of gaps and of
/// the time at which a change begins (ours).
const SHARPNESS: f64 = 0.12;

/// Three points with their weights that have the moments of a standard normal distribution (Gauss–Hermite).
const UNLIKE: [(f64, f64); 3] =
    [(-1.732_050_807_568_877_2, 1.0 / 6.0), (0.0, 2.0 / 3.0), (1.732_050_807_568_877_2, 1.0 / 6.0)];

/// A number for each pair of a critical lead gap (outer) and a critical lag gap (inner).
pub(super) type Pairs = [[f64; GRID]; GRID];

/// How a driver gets from a wish to a change, whatever the gaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Going {
    /// The logarithm of the odds of a desire is this plus so many times that of the supposed ones: what is supposed may
    /// be too sure of itself.
    pub(super) desire: [f64; 2],
    /// Standard deviation of the first of them over the drivers: some want to change more often than is supposed.
    pub(super) unlike: f64,
    /// Chance that who waits gives up, per look.
    pub(super) gives_up: f64,
    /// Chance that who waits goes into an acceptable gap, per look.
    pub(super) goes: f64,
    /// The same where the gap test refuses the gap for another reason than critical gaps.
    pub(super) goes_anyway: f64,
    /// Chance that a driver waits when its spell begins.
    pub(super) waits: f64,
}

/// The likelihoods of a driver, over the largest of them, and the logarithm of that.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    pub(super) likelihoods: Pairs,
    pub(super) log: f64,
}

/// The logarithm of critical gap number `at` [ln m].
pub(super) fn node(at: usize) -> f64 {
    FIRST + STEP * at as f64
}

/// The shares of a normal distribution of logarithms that are nearest to each critical gap of the grid.
pub(super) fn shares(mean: f64, deviation: f64) -> [f64; GRID] {
    let below = |at: usize| match at {
        0 => 0.0,
        GRID => 1.0,
        _ => normal((node(at) - 0.5 * STEP - mean) / deviation),
    };
    std::array::from_fn(|it| (below(it + 1) - below(it)).max(f64::MIN_POSITIVE))
}

/// Φ.
pub(super) fn normal(z: f64) -> f64 {
    0.5 * libm::erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}

/// The chances that a gap of this logarithm is not too short, for each critical gap.
fn suits(gap: f64) -> [f64; GRID] {
    /// Longer gaps suit everybody.
    const LONGEST: f64 = 8.0;
    let mut odds = libm::exp((FIRST - gap.min(LONGEST)) / SHARPNESS);
    let ratio = libm::exp(STEP / SHARPNESS);
    std::array::from_fn(|_| {
        let suits = 1.0 / (1.0 + odds);
        odds *= ratio;
        suits
    })
}

impl Table {
    /// Of the driver with these spells, in the mean over how often drivers want to change.
    pub(super) fn of(spells: &[GapSpell], going: &Going) -> Table {
        let mut each: [(Pairs, f64); 3] = UNLIKE.map(|(at, chance)| {
            let [more, slope] = going.desire;
            let going = Going { desire: [more + going.unlike * at, slope], ..*going };
            let mut logs: Pairs = [[0.0; GRID]; GRID];
            spells.iter().for_each(|it| add(it, &going, &mut logs));
            (logs, chance)
        });
        let all = each.iter().flat_map(|(logs, _)| logs.as_flattened());
        let log = all.copied().fold(f64::NEG_INFINITY, f64::max);
        let mut likelihoods: Pairs = [[0.0; GRID]; GRID];
        for (logs, chance) in &mut each {
            let sums = likelihoods.as_flattened_mut().iter_mut();
            sums.zip(logs.as_flattened()).for_each(|(sum, it)| *sum += *chance * libm::exp(it - log));
        }
        Table { likelihoods, log }
    }

    /// The logarithm of the likelihood for critical gaps with these shares.
    pub(super) fn log(&self, [lead, lag]: &[[f64; GRID]; 2]) -> f64 {
        let row = |row: &[f64; GRID]| row.iter().zip(lag).map(|(it, share)| it * share).sum::<f64>();
        let sum: f64 = self.likelihoods.iter().zip(lead).map(|(it, share)| share * row(it)).sum();
        self.log + libm::log(sum.max(f64::MIN_POSITIVE))
    }
}

/// The chances of the states of a driver, for each pair of critical gaps.
struct States {
    free: Pairs,
    wants: [Pairs; 2],
}

/// Adds the logarithms of the likelihood of a spell.
fn add(spell: &GapSpell, going: &Going, logs: &mut Pairs) {
    /// The states are divided by their sum so often.
    const OFTEN: usize = 32;
    let mut states = States::at_begin(spell, going);
    let last = spell.looks.len().saturating_sub(1);
    for (number, sides) in spell.looks.iter().enumerate() {
        let changed = spell.changed_to.filter(|_| number == last);
        if let Some(side) = changed {
            let Some(offered) = &sides[side] else { return };
            states.change(side, (offered, going.desires(sides)[side]), going, logs);
            return;
        }
        states.pass(sides, going);
        if number == last || number % OFTEN == OFTEN - 1 {
            states.divide(logs);
        }
    }
}

impl States {
    fn at_begin(spell: &GapSpell, going: &Going) -> States {
        let sides = spell.looks.first().map_or([false; 2], |it| it.each_ref().map(Option::is_some));
        let count = sides.iter().filter(|it| **it).count();
        let waits = if count == 0 { 0.0 } else { going.waits };
        let of = |is_there: bool| if is_there { waits / count as f64 } else { 0.0 };
        States { free: [[1.0 - waits; GRID]; GRID], wants: sides.map(|it| [[of(it); GRID]; GRID]) }
    }

    /// A look without a change.
    fn pass(&mut self, sides: &[Option<Offered>; 2], going: &Going) {
        let before = self.free;
        let desires = going.desires(sides);
        let stays = 1.0 - desires[0] - desires[1];
        self.free.as_flattened_mut().iter_mut().for_each(|it| *it *= stays);
        for (side, offered) in sides.iter().enumerate() {
            match offered {
                Some(it) => self.pass_by(side, (it, desires[side]), going, &before),
                None => self.give_up(side),
            }
        }
    }

    /// The part of a side at which something is offered that is desired with this chance. `before` has who was free.
    fn pass_by(&mut self, side: usize, (offered, desire): (&Offered, f64), going: &Going, before: &Pairs) {
        let Accepts { lead, lag } = Accepts::of(offered, going);
        let (gives_up, waits_on) = (going.gives_up, 1.0 - going.gives_up);
        let rows = self.free.iter_mut().zip(&mut self.wants[side]).zip(before);
        for (((free, wants), before), lead) in rows.zip(lead) {
            for at in 0..GRID {
                let refused = 1.0 - lead * lag[at];
                free[at] += refused * wants[at] * gives_up;
                wants[at] = refused * (before[at] * desire + wants[at] * waits_on);
            }
        }
    }

    /// Who waits for a side to which it can no longer change gives up.
    fn give_up(&mut self, side: usize) {
        let wants = self.wants[side].as_flattened_mut();
        for (free, wants) in self.free.as_flattened_mut().iter_mut().zip(wants) {
            *free += *wants;
            *wants = 0.0;
        }
    }

    /// A look at which a change begins.
    fn change(&self, side: usize, (offered, desire): (&Offered, f64), going: &Going, logs: &mut Pairs) {
        let accepts = Accepts::of(offered, going);
        for (lead, logs) in logs.iter_mut().enumerate() {
            for (lag, log) in logs.iter_mut().enumerate() {
                let wants = self.free[lead][lag] * desire + self.wants[side][lead][lag];
                *log += libm::log((accepts.accepted(lead, lag) * wants).max(f64::MIN_POSITIVE));
            }
        }
    }

    /// Divides all states by their sums, whose logarithms are added to `logs`.
    fn divide(&mut self, logs: &mut Pairs) {
        for lead in 0..GRID {
            for lag in 0..GRID {
                let [left, right] = &mut self.wants;
                let all = [&mut self.free[lead][lag], &mut left[lead][lag], &mut right[lead][lag]];
                let sum = all.iter().map(|it| **it).sum::<f64>().max(f64::MIN_POSITIVE);
                all.into_iter().for_each(|it| *it /= sum);
                logs[lead][lag] += libm::log(sum);
            }
        }
    }
}

impl Going {
    /// The chances of desires for what is offered on both sides, together at most 1.
    fn desires(&self, sides: &[Option<Offered>; 2]) -> [f64; 2] {
        let [more, slope] = self.desire;
        let of = |it: &Option<Offered>| it.as_ref().map_or(0.0, |it| logistic(more + slope * it.desire));
        let desires = sides.each_ref().map(of);
        let sum = f64::max(desires[0] + desires[1], 1.0);
        desires.map(|it| it / sum)
    }
}

/// The chance that what is offered is accepted by who waits, for each critical gap.
struct Accepts {
    /// Times the chance that the driver goes.
    lead: [f64; GRID],
    lag: [f64; GRID],
}

impl Accepts {
    fn of(offered: &Offered, going: &Going) -> Accepts {
        let goes = if offered.is_possible { going.goes } else { going.goes_anyway };
        Accepts { lead: suits(offered.lead).map(|it| goes * it), lag: suits(offered.lag) }
    }

    fn accepted(&self, lead: usize, lag: usize) -> f64 {
        self.lead[lead] * self.lag[lag]
    }
}
