//! The likelihood of one driver: free → wants a side → changes, by the forward algorithm, and its gradient by the
//! backward one (Baum 1972; Rabiner 1989). Only the begin of a change is seen.
//!
//! The desired speed, the driver's own intercept and the phase of its decisions are unknown: the likelihood is the mean
//! over all of them.

use laneweave_models::exp;

use super::design::{Design, Driver, GAP_TERMS, NO_STRATUM, Spell};
use super::parameters::{Layout, logistic};
use super::quadrature::NORMAL;
use super::second::{Lanes, Second, Slopes, States};

/// A combination of unknowns that is less likely than this is not worth a gradient.
const UNLIKELY: f64 = 1e-9;
/// Below this all states are scaled up.
const SMALL: f64 = 1e-150;
/// Utilities beyond this are certain anyway.
const CERTAIN: f64 = 200.0;

/// The parameters as the likelihood uses them.
pub(super) struct Numbers<'a> {
    layout: Layout,
    all: &'a [f64],
    background: f64,
    giving_up: f64,
    waiting: f64,
    has_spread: bool,
    /// e^(s z), s z and the weights of the drivers' own intercepts.
    own: Vec<[f64; 3]>,
}

impl<'a> Numbers<'a> {
    /// `has_spread`: whether drivers have intercepts of their own.
    pub(super) fn new(layout: Layout, all: &'a [f64], has_spread: bool) -> Numbers<'a> {
        let spread = libm::exp(all[layout.spread()]);
        let own = |[z, weight]: [f64; 2]| [libm::exp(spread * z), spread * z, weight];
        Numbers {
            layout,
            all,
            background: logistic(all[layout.background()]),
            giving_up: logistic(all[layout.giving_up()]),
            waiting: logistic(all[layout.waiting()]),
            has_spread,
            own: if has_spread { NORMAL.map(own).to_vec() } else { vec![[1.0, 0.0, 1.0]] },
        }
    }
}

/// What the likelihood of a driver needs, kept between drivers. `W` is the number of possible desired speeds.
pub(super) struct Memory<const W: usize> {
    /// e^η by row.
    odds: Vec<Lanes<W>>,
    /// a by row.
    accepted: Vec<f64>,
    /// Derivatives by η and by a of each row.
    by_utility: Vec<Lanes<W>>,
    by_accepted: Vec<f64>,
    /// States before each second, of all spells for all combinations of unknowns.
    states: Vec<States<W>>,
    /// Log-likelihoods of the combinations.
    logs: Vec<Lanes<W>>,
}

impl<const W: usize> Default for Memory<W> {
    fn default() -> Memory<W> {
        Memory {
            odds: Vec::new(),
            accepted: Vec::new(),
            by_utility: Vec::new(),
            by_accepted: Vec::new(),
            states: Vec::new(),
            logs: Vec::new(),
        }
    }
}

/// Derivatives by the parameters that all rows share.
#[derive(Default)]
struct Shared {
    background: f64,
    giving_up: f64,
    waiting: f64,
    spread: f64,
}

/// One driver with the parameters.
pub(super) struct Look<'a> {
    pub(super) design: &'a Design,
    pub(super) driver: &'a Driver,
    pub(super) numbers: &'a Numbers<'a>,
}

/// A phase of the decisions and an intercept of the driver's own.
pub(super) struct Combination<'a> {
    spells: &'a [Spell],
    /// e^(s z), and s z.
    factor: f64,
    own: f64,
    chance: f64,
}

impl<'a> Combination<'a> {
    /// That of drivers who have no intercepts of their own.
    pub(super) fn usual(spells: &'a [Spell]) -> Combination<'a> {
        Combination { spells, factor: 1.0, own: 0.0, chance: 1.0 }
    }
}

impl Look<'_> {
    /// The log-likelihood of the driver. Adds `weight` times its gradient to `gradient`, if there is one.
    pub(super) fn evaluate<const W: usize>(
        &self,
        memory: &mut Memory<W>,
        gradient: Option<&mut [f64]>,
        weight: f64,
    ) -> f64 {
        self.prepare(memory);
        memory.logs.clear();
        memory.states.clear();
        for combination in self.combinations() {
            let mut logs = [f64::NEG_INFINITY; W];
            for (log, chance) in logs.iter_mut().zip(&self.driver.chances) {
                *log = libm::log(combination.chance * chance);
            }
            for spell in combination.spells {
                let spell = self.forward(memory, spell, &combination);
                logs.iter_mut().zip(spell).for_each(|(log, more)| *log += more);
            }
            memory.logs.push(logs);
        }
        let all = || memory.logs.iter().flatten();
        let largest = all().copied().fold(f64::NEG_INFINITY, f64::max);
        let log_likelihood = largest + libm::log(all().map(|it| libm::exp(it - largest)).sum());
        if let Some(gradient) = gradient {
            let shared = self.derivatives(memory, log_likelihood);
            self.collect(memory, &shared, gradient, weight);
        }
        log_likelihood
    }

    /// All combinations of phases and own intercepts.
    fn combinations(&self) -> impl Iterator<Item = Combination<'_>> {
        let phases = &self.driver.phases;
        let share = 1.0 / phases.len().max(1) as f64;
        phases.iter().flat_map(move |spells| {
            self.numbers.own.iter().map(move |[factor, own, weight]| Combination {
                spells,
                factor: *factor,
                own: *own,
                chance: share * weight,
            })
        })
    }

    /// Computes e^η and a of all rows of the driver.
    pub(super) fn prepare<const W: usize>(&self, memory: &mut Memory<W>) {
        let Look { design, driver, numbers } = self;
        let (layout, all) = (numbers.layout, numbers.all);
        let (intercept, slopes) = (all[layout.intercept()], &all[layout.slopes()]);
        let acceptance = &all[layout.acceptance()];
        memory.odds.clear();
        memory.accepted.clear();
        for row in driver.rows.clone() {
            let places = design.places[row].iter().filter(|it| **it != NO_STRATUM);
            let base = intercept + places.map(|it| all[layout.places().start + *it as usize]).sum::<f64>();
            let mut odds = [0.0; W];
            for (node, odds) in odds.iter_mut().enumerate().take(design.nodes) {
                let terms = design.row(row, node).iter().zip(slopes);
                let utility = base + terms.map(|(term, slope)| term * slope).sum::<f64>();
                *odds = exp(utility.clamp(-CERTAIN, CERTAIN));
            }
            memory.odds.push(odds);
            let terms = design.gaps[row].iter().zip(&acceptance[1..]);
            memory.accepted.push(logistic(acceptance[0] + terms.map(|(x, slope)| x * slope).sum::<f64>()));
        }
        memory.by_utility.clear();
        memory.by_utility.resize(driver.rows.len(), [0.0; W]);
        memory.by_accepted.clear();
        memory.by_accepted.resize(driver.rows.len(), 0.0);
    }

    #[inline(always)]
    pub(super) fn second<const W: usize>(
        &self,
        memory: &Memory<W>,
        sides: [Option<u32>; 2],
        combination: &Combination,
    ) -> Second<W> {
        // Loops, not maps: those of arrays are not inlined, and this runs for every second and combination.
        let (mut rows, mut odds, mut accepted) = ([None; 2], [[0.0; W]; 2], [0.0; 2]);
        for side in 0..2 {
            let Some(row) = sides[side] else { continue };
            let row = row as usize - self.driver.rows.start;
            (rows[side], accepted[side]) = (Some(row), memory.accepted[row]);
            let pairs = odds[side].iter_mut().zip(&memory.odds[row]);
            pairs.for_each(|(odds, it)| *odds = combination.factor * it);
        }
        Second::new(rows, odds, accepted, (self.numbers.background, self.numbers.giving_up))
    }

    /// The states at the begin of a spell, and their derivatives by the chance of waiting.
    pub(super) fn begin(&self, spell: &Spell) -> [[f64; 3]; 2] {
        let sides =
            spell.seconds.first().map_or([0.0; 2], |it| it.map(|it| f64::from(u8::from(it.is_some()))));
        let count = sides[0] + sides[1];
        if count == 0.0 {
            return [[1.0, 0.0, 0.0], [0.0; 3]];
        }
        let waiting = self.numbers.waiting;
        let slope = [-1.0, sides[0] / count, sides[1] / count];
        [[1.0 - waiting, waiting * slope[1], waiting * slope[2]], slope]
    }

    /// The log-likelihoods of a spell; keeps the states before each second.
    fn forward<const W: usize>(
        &self,
        memory: &mut Memory<W>,
        spell: &Spell,
        combination: &Combination,
    ) -> Lanes<W> {
        let mut now: States<W> = self.begin(spell)[0].map(|it| [it; W]);
        let mut logs = [0.0; W];
        let last = spell.seconds.len().saturating_sub(1);
        for (number, sides) in spell.seconds.iter().enumerate() {
            memory.states.push(now);
            let second = self.second(memory, *sides, combination);
            match spell.changed_to {
                Some(side) if number == last => {
                    let changes = second.changes(&now, side);
                    logs.iter_mut().zip(changes).for_each(|(log, it)| *log += libm::log(it));
                    return logs;
                }
                _ => now = second.after(&now),
            }
            let is_small = (0..W).any(|lane| now[0][lane] + now[1][lane] + now[2][lane] < SMALL);
            if is_small || number == last {
                for lane in 0..W {
                    let sum = (now[0][lane] + now[1][lane] + now[2][lane]).max(f64::MIN_POSITIVE);
                    logs[lane] += libm::log(sum);
                    now.iter_mut().for_each(|it| it[lane] /= sum);
                }
            }
        }
        logs
    }

    /// The derivatives of the log-likelihood of the driver, whose states are in the memory.
    fn derivatives<const W: usize>(&self, memory: &mut Memory<W>, log_likelihood: f64) -> Shared {
        let mut shared = Shared::default();
        let mut begin = 0;
        for (number, combination) in self.combinations().enumerate() {
            let shares = memory.logs[number].map(|it| libm::exp(it - log_likelihood));
            let is_likely = shares.iter().any(|it| *it > UNLIKELY);
            for spell in combination.spells {
                if is_likely {
                    self.backward(memory, (spell, begin), &combination, &shares, &mut shared);
                }
                begin += spell.seconds.len();
            }
        }
        shared
    }

    /// Adds the derivatives of the log-likelihoods of a spell, each as often as `shares` says. Its states begin at
    /// number `begin` in the memory.
    fn backward<const W: usize>(
        &self,
        memory: &mut Memory<W>,
        (spell, begin): (&Spell, usize),
        combination: &Combination,
        shares: &Lanes<W>,
        shared: &mut Shared,
    ) {
        let mut later: States<W> = [[1.0; W]; 3];
        let last = spell.seconds.len().saturating_sub(1);
        for (number, sides) in spell.seconds.iter().enumerate().rev() {
            let (second, now) = (self.second(memory, *sides, combination), memory.states[begin + number]);
            let slopes = match spell.changed_to.filter(|_| number == last) {
                Some(side) => second.slopes_of_change(&now, side),
                None => second.slopes(&now, &later),
            };
            self.add(memory, &second, combination, &slopes, shares, shared);
            for lane in 0..W {
                let [free, first, second] = &slopes.before;
                let largest = free[lane].max(first[lane]).max(second[lane]).max(f64::MIN_POSITIVE);
                let scale = 1.0 / largest;
                later[0][lane] = free[lane] * scale;
                later[1][lane] = first[lane] * scale;
                later[2][lane] = second[lane] * scale;
            }
        }
        if spell.seconds.is_empty() {
            return;
        }
        let [states, slope] = self.begin(spell);
        for lane in 0..W {
            let sum = |of: [f64; 3]| (0..3).map(|it| of[it] * later[it][lane]).sum::<f64>();
            shared.waiting += shares[lane] * sum(slope) / sum(states);
        }
    }

    #[inline(always)]
    fn add<const W: usize>(
        &self,
        memory: &mut Memory<W>,
        second: &Second<W>,
        combination: &Combination,
        slopes: &Slopes<W>,
        shares: &Lanes<W>,
        shared: &mut Shared,
    ) {
        let span = 1.0 - 2.0 * self.numbers.background;
        let (mut scale, mut mean) = ([0.0; W], [0.0; W]);
        for lane in 0..W {
            scale[lane] = shares[lane] / slopes.likelihood[lane];
            let by_side = |side: usize| slopes.by_desire[side][lane] * second.logit[side][lane];
            mean[lane] = by_side(0) + by_side(1);
            shared.giving_up += scale[lane] * slopes.by_giving_up[lane];
        }
        for side in 0..2 {
            let Some(row) = second.rows[side] else { continue };
            let by_utility = &mut memory.by_utility[row];
            for lane in 0..W {
                let by_desire = slopes.by_desire[side][lane];
                let slope = scale[lane] * span * second.logit[side][lane] * (by_desire - mean[lane]);
                by_utility[lane] += slope;
                shared.spread += slope * combination.own;
                shared.background += scale[lane] * by_desire * (1.0 - 2.0 * second.logit[side][lane]);
                memory.by_accepted[row] += scale[lane] * slopes.by_accepted[side][lane];
            }
        }
    }

    /// Adds what was collected by rows to the gradient.
    fn collect<const W: usize>(
        &self,
        memory: &Memory<W>,
        shared: &Shared,
        gradient: &mut [f64],
        weight: f64,
    ) {
        let Look { design, driver, numbers } = self;
        let layout = numbers.layout;
        let mut add = |at: usize, value: f64| gradient[at] += weight * value;
        let through = |p: f64| p * (1.0 - p);
        for (local, row) in driver.rows.clone().enumerate() {
            let mut sum = 0.0;
            for (node, slope) in memory.by_utility[local].iter().enumerate().take(design.nodes) {
                sum += slope;
                let terms = layout.slopes().zip(design.row(row, node));
                terms.for_each(|(at, term)| add(at, slope * term));
            }
            add(layout.intercept(), sum);
            for place in design.places[row].iter().filter(|it| **it != NO_STRATUM) {
                add(layout.places().start + *place as usize, sum);
            }
            let slope = memory.by_accepted[local] * through(memory.accepted[local]);
            let start = layout.acceptance().start;
            add(start, slope);
            (0..GAP_TERMS).for_each(|it| add(start + 1 + it, slope * design.gaps[row][it]));
        }
        add(layout.background(), shared.background * through(numbers.background));
        add(layout.giving_up(), shared.giving_up * through(numbers.giving_up));
        add(layout.waiting(), shared.waiting * through(numbers.waiting));
        add(layout.spread(), if numbers.has_spread { shared.spread } else { 0.0 });
    }
}
