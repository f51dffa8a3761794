//! Multi-criteria decision-making: the rows of the table, weighted and combined, and the decision.
//!
//! G = Σ μᵢ Yᵢ. Threshold rule (the paper's): a change is desired iff G > θ. Stochastic rule: in one epoch of τ_d = 1
//! s the desire comes with probability h = 1/(1 + exp(−(G − θ)/σ)); the threshold rule is its limit σ → 0. Left and
//! right compete in a multinomial logit of {stay, left, right}, which is the same rule where there is only one side.

use serde::{Deserialize, Serialize};

use super::incentives::{INCENTIVES, IncentiveName, in_rows, with_incentives};
use super::returning::Returning;
use super::situation::{CONGESTED, LaneRule, LaneView, Toward, may_not_pass};
use super::{Chances, Comfort, Courtesy, GainBound, Incentive, Keeping, Route, Situation, Speed, Urgency};
use crate::exponential::exp;
use crate::follow::Ahead;

/// Makes [`Mcdm`], and what it has of each incentive.
macro_rules! mcdm {
    (incentives { $($(#[$about:meta])* $key:ident $incentive:ident;)+ }) => {
        /// Multi-criteria decision-making.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct Mcdm {
            /// How desire follows from G.
            pub rule: Rule,
            /// θ.
            pub theta: f64,
            /// σ: choice noise of the stochastic rule; 0: none.
            pub sigma: f64,
            /// How the yields are combined.
            pub combination: Combination,
            $($(#[$about])* pub $key: $incentive,)+
            /// The chance of coming back.
            pub returning: Returning,
        }

        impl Mcdm {
            /// The weight of an incentive.
            pub fn weight(&self, of: IncentiveName) -> f64 {
                match of {
                    $(IncentiveName::$incentive => self.$key.weight,)+
                }
            }

            /// The same model with the weights `of` the incentives.
            pub fn with_weights(mut self, of: impl Fn(IncentiveName) -> f64) -> Mcdm {
                $(self.$key.weight = of(IncentiveName::$incentive);)+
                self
            }

            fn rows(&self, situation: &Situation, chances: Chances) -> [Row; INCENTIVES] {
                [$(Row::of(self.$key.weight, || self.$key.earning(situation, chances))),+]
            }

            /// The rows with which G is largest on a side with the gain bound `bound`; `None` where there is no bound.
            #[inline]
            fn rows_at_most(&self, bound: &GainBound) -> Option<[Row; INCENTIVES]> {
                Some([$(Row::at_most(self.$key.weight, || self.$key.most(bound))?),+])
            }
        }
    };
}

with_incentives! { mcdm! {} }

/// How desire follows from G.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rule {
    /// Iff G > θ.
    Threshold,
    /// With the probability of a logit.
    #[default]
    Logit,
}

/// How yields are combined to G.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Combination {
    /// Σ μ Y, which the paper chooses.
    #[default]
    Linear,
    /// Σ μ (1 − e^(−Y)): losses weigh more than gains. The paper names an exponential combination as the
    /// alternative and prints none; this form is ours.
    Exponential,
}

/// One row of the table, evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Y.
    pub earning: f64,
    /// μ.
    pub weight: f64,
}

impl Row {
    /// A criterion without weight in the style is not computed.
    #[inline]
    fn of(weight: f64, earning: impl FnOnce() -> f64) -> Row {
        Row { earning: if weight == 0.0 { 0.0 } else { earning() }, weight }
    }

    /// The same of an earning that may be unknown.
    #[inline]
    fn at_most(weight: f64, earning: impl FnOnce() -> Option<f64>) -> Option<Row> {
        Some(Row { earning: if weight == 0.0 { 0.0 } else { earning()? }, weight })
    }
}

/// A driver's appraisal of one side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Appraisal {
    /// The rows in the order of [`IncentiveName::ALL`].
    pub rows: [Row; INCENTIVES],
    /// G.
    pub gain: f64,
    /// θ.
    pub theta: f64,
}

impl Appraisal {
    /// The row of an incentive.
    #[inline]
    pub fn row(&self, of: IncentiveName) -> Row {
        self.rows[of as usize]
    }

    /// The index of the row with the largest μY, which speaks most for the change, if any is above 0; of equal ones
    /// the first.
    pub fn leading(&self) -> Option<usize> {
        let products = self.rows.iter().map(|it| it.weight * it.earning).enumerate();
        products.filter(|(_, it)| *it > 0.0).reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(row, _)| row)
    }
}

impl Mcdm {
    /// The driver's appraisal of the side in `situation`.
    pub fn appraise(&self, situation: &Situation) -> Appraisal {
        let seen = self.keeping_there(situation);
        let situation = seen.as_ref().unwrap_or(situation);
        let rows = self.rows(situation, self.returning.chances(situation));
        Appraisal { rows, gain: self.combine(&rows), theta: self.theta }
    }

    /// Whether only the wish for the slow side makes the driver of this `appraisal` want the change.
    pub(super) fn is_for_the_slow_side(&self, appraisal: &Appraisal) -> bool {
        let keeping = appraisal.row(IncentiveName::Keeping);
        let mut others = appraisal.rows;
        others[IncentiveName::Keeping as usize] = Row::default();
        keeping.weight * keeping.earning > 0.0 && self.combine(&others) <= self.theta
    }

    /// The driver's appraisal of leaving a route of `on_route` [s] for one of `alternative` [s] with the indifference
    /// `band` [s], by the route incentive alone; `None` where it does not consider it.
    pub fn appraise_leaving(&self, on_route: f64, alternative: f64, band: f64) -> Option<Appraisal> {
        let Route { weight, .. } = self.route;
        let earning = self.route.leaving(on_route, alternative, band).filter(|_| weight != 0.0)?;
        let rows = in_rows([(IncentiveName::Route, Row { earning, weight })]);
        Some(Appraisal { rows, gain: self.combine(&rows), theta: self.theta })
    }

    /// Whether its drivers do not pass on the slow side in free traffic, under this rule.
    #[inline]
    pub fn minds_offside(&self, rule: LaneRule) -> bool {
        rule == LaneRule::NoPassingThere && self.keeping.weight != 0.0
    }

    /// The anticipated speeds [m/s] here and there, where a driver at `speed` [m/s] on the slow side does not pass its
    /// leader in the overtaking lane: one of `ahead`, the leaders here and there.
    #[inline]
    pub fn without_passing(
        &self,
        toward: Toward,
        speed: f64,
        ahead: [Option<Ahead>; 2],
        [here, there]: [f64; 2],
    ) -> [f64; 2] {
        let offside = match toward {
            Toward::Offside => ahead[1],
            Toward::Nearside => ahead[0],
        };
        match toward {
            _ if !offside.is_some_and(|it| may_not_pass(speed, it, CONGESTED)) => [here, there],
            Toward::Offside => [here.min(there), there],
            Toward::Nearside => [here, there.min(here)],
        }
    }

    /// The situation of a driver who keeps to the slow side, where it does not pass there; `None` for all others.
    fn keeping_there<'a>(&self, situation: &Situation<'a>) -> Option<Situation<'a>> {
        let Situation { me, here, there, toward, lane_rule, .. } = *situation;
        if !self.minds_offside(lane_rule) {
            return None;
        }
        let (speed, speeds) = (me.pace.speed, [here.anticipated_speed, there.anticipated_speed]);
        let [at_most_here, at_most_there] =
            self.without_passing(toward, speed, [here.ahead, there.ahead], speeds);
        let here = LaneView { anticipated_speed: at_most_here, ..here };
        let there = LaneView { anticipated_speed: at_most_there, ..there };
        Some(Situation { here, there, ..*situation })
    }

    /// G.
    pub fn combine(&self, rows: &[Row]) -> f64 {
        let utility = |earning: f64| match self.combination {
            Combination::Linear => earning,
            Combination::Exponential => -libm::expm1(-earning),
        };
        rows.iter().map(|row| row.weight * utility(row.earning)).sum()
    }

    /// An upper bound of G on a side with the gain bound `bound`; infinite where there is no bound.
    #[inline]
    pub fn gain_at_most(&self, bound: &GainBound) -> f64 {
        self.rows_at_most(bound).map_or(f64::INFINITY, |rows| self.combine(&rows))
    }

    /// A gain below which the desire certainly does not come, if both sides have less: within `epochs` epochs, for
    /// the random number `draw`. It is computed without an exponential. The chance of either side is at most `epochs`
    /// (or 1) times e^((G − θ)/σ); for most drivers this is nearly always far below any random number.
    #[inline]
    pub(crate) fn reach(&self, epochs: f64, draw: f64) -> f64 {
        match self.rule {
            Rule::Logit if self.sigma > 0.0 => {
                self.theta + self.sigma * ln_at_least(draw / (2.0 * epochs.max(1.0)))
            }
            Rule::Logit | Rule::Threshold => self.theta,
        }
    }

    /// Chances within one epoch of the desire for either side.
    pub fn choose(&self, sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
        match self.rule {
            Rule::Logit if self.sigma > 0.0 => {
                // Scaled by the largest exponent, so that nothing overflows.
                let exponents = excess(sides).map(|it| it / self.sigma);
                let largest = exponents[0].max(exponents[1]).max(0.0);
                let [first, second] = exponents.map(|it| exp(it - largest));
                let stay = if largest == 0.0 { 1.0 } else { exp(-largest) };
                let all = stay + first + second;
                [first / all, second / all]
            }
            // Without noise the logit is the threshold rule.
            Rule::Logit | Rule::Threshold => by_threshold(sides, |excess| excess > 0.0),
        }
    }
}

/// How far G is above θ on either side.
#[inline]
fn excess(sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
    sides.map(|side| side.map_or(f64::NEG_INFINITY, |it| it.gain - it.theta))
}

/// The threshold rule: the desire comes for the side that is further above its threshold, if that is `enough`.
#[inline]
pub(super) fn by_threshold(sides: [Option<&Appraisal>; 2], enough: impl Fn(f64) -> bool) -> [f64; 2] {
    match excess(sides) {
        [first, second] if enough(first) && first >= second => [1.0, 0.0],
        [_, second] if enough(second) => [0.0, 1.0],
        _ => [0.0, 0.0],
    }
}

/// A lower bound of ln x for x in (0, 1), by its binary exponent; −∞ below all normal numbers.
#[inline]
fn ln_at_least(x: f64) -> f64 {
    if x < f64::MIN_POSITIVE {
        return f64::NEG_INFINITY;
    }
    /// Number of bits of the fraction, and the bias of the exponent.
    const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
    const BIAS: i32 = f64::MAX_EXP - 1;
    f64::from((x.to_bits() >> FRACTION) as i32 - BIAS) * std::f64::consts::LN_2
}

/// Probability of at least one event within the share `epochs` of epochs, `p` the probability within one:
/// 1 − (1 − p)^epochs.
#[inline]
pub fn at_least_once_in(epochs: f64, p: f64) -> f64 {
    if epochs == 1.0 { p } else { -libm::expm1(epochs * libm::log1p(-p)) }
}
