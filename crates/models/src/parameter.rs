//! The numbers of a style, by their keys in a style file, with their ranges.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::change::{IncentiveName, LaneChangeModel, with_incentives};
use crate::follow::FollowingModel;
use crate::style::Style;

/// The values that a number of a style may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least value.
    pub from: f64,
    /// The greatest value.
    pub to: f64,
    /// The unit of both.
    pub unit: &'static str,
}

const fn range(from: f64, to: f64, unit: &'static str) -> Range {
    Range { from, to, unit }
}

impl Range {
    /// Any finite number, such as a weight or a threshold.
    pub const ANY: Range = range(f64::NEG_INFINITY, f64::INFINITY, "");

    /// Whether all values from `least` to `largest` are inside.
    pub fn holds(&self, least: f64, largest: f64) -> bool {
        least.is_finite() && largest.is_finite() && self.from <= least && largest <= self.to
    }

    /// The range in words, as a remedy.
    pub fn advice(&self) -> String {
        let Range { from, to, unit } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        match (from.is_finite(), to.is_finite()) {
            (true, true) => format!("choose {from} to {to}{unit}"),
            (true, false) => format!("choose {from}{unit} or more"),
            _ => "choose a finite number".into(),
        }
    }
}

/// Makes [`Parameter`] from the list of incentives, and from lists of names, keys, ranges and places in a style.
macro_rules! parameters {
    (
        incentives { $($(#[$about:meta])* $incentive_key:ident $incentive:ident;)+ }
        follow { $($follow:ident $follow_key:literal $follow_range:expr,
            [$($following:ident)+] $follow_field:ident;)+ }
        change { $($change:ident $change_key:literal $change_range:expr, $changing:ident $($change_field:ident).+;)+ }
        other { $($other:ident $other_key:literal $other_range:expr, $($other_field:ident).+;)+ }
    ) => {
        /// A number of a style. It is written as its key in a style file.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Parameter {
            $(#[doc = concat!("`", $follow_key, "`")] $follow,)+
            /// The weight of an incentive, such as `change.speed.weight`.
            Weight(IncentiveName),
            $(#[doc = concat!("`", $change_key, "`")] $change,)+
            $(#[doc = concat!("`", $other_key, "`")] $other,)+
        }

        impl Parameter {
            /// All of them.
            pub const ALL: &'static [Parameter] = &[
                $(Parameter::$follow,)+
                $(Parameter::Weight(IncentiveName::$incentive),)+
                $(Parameter::$change,)+
                $(Parameter::$other,)+
            ];

            /// Its key in a style file.
            pub fn key(self) -> &'static str {
                match self {
                    $(Parameter::$follow => $follow_key,)+
                    $(Parameter::Weight(IncentiveName::$incentive) => {
                        concat!("change.", stringify!($incentive_key), ".weight")
                    })+
                    $(Parameter::$change => $change_key,)+
                    $(Parameter::$other => $other_key,)+
                }
            }

            /// The values that it may have. The limits are ours: wide enough for every driver, too narrow for a wrong
            /// unit.
            pub fn range(self) -> Range {
                match self {
                    $(Parameter::$follow => $follow_range,)+
                    Parameter::Weight(_) => Range::ANY,
                    $(Parameter::$change => $change_range,)+
                    $(Parameter::$other => $other_range,)+
                }
            }

            /// Its value in `style`; `None` if a style of these models has no such number.
            pub fn value(self, style: &Style) -> Option<f64> {
                self.place(&mut style.clone()).map(|it| *it)
            }

            /// Its place in `style`; `None` if a style of these models has no such number.
            pub fn place(self, style: &mut Style) -> Option<&mut f64> {
                Some(match self {
                    $(Parameter::$follow => match &mut style.follow {
                        $(FollowingModel::$following(it) => &mut it.$follow_field,)+
                        #[allow(unreachable_patterns, reason = "some numbers are in all models")]
                        _ => return None,
                    },)+
                    Parameter::Weight(name) => match (name, &mut style.change) {
                        $((IncentiveName::$incentive, LaneChangeModel::Mcdm(it)) => &mut it.$incentive_key.weight,)+
                        _ => return None,
                    },
                    $(Parameter::$change => match &mut style.change {
                        LaneChangeModel::$changing(it) => &mut it.$($change_field).+,
                        _ => return None,
                    },)+
                    $(Parameter::$other => &mut style.$($other_field).+,)+
                })
            }
        }
    };
}

with_incentives! { parameters! {
    follow {
        Acceleration "follow.acceleration" range(0.1, 10.0, "m/s²"), [Idm IdmPlus Acc Krauss Gipps] acceleration;
        Deceleration "follow.deceleration" range(0.1, 10.0, "m/s²"), [Idm IdmPlus Acc Krauss Gipps] deceleration;
        TimeGap "follow.time_gap" range(0.1, 10.0, "s"), [Idm IdmPlus Acc Gfm Krauss Newell] time_gap;
        JamGap "follow.jam_gap" range(0.0, 20.0, "m"), [Idm IdmPlus Fvdm Acc Ovm Gfm Krauss Gipps Newell] jam_gap;
        Exponent "follow.exponent" range(1.0, 20.0, ""), [Idm IdmPlus Acc] exponent;
        Sensitivity "follow.sensitivity" range(0.01, 10.0, "1/s"), [Fvdm Ovm Gfm] sensitivity;
        RelativeSensitivity "follow.relative_sensitivity" range(0.0, 10.0, "1/s"), [Fvdm Gfm] relative_sensitivity;
        FollowingRange "follow.range" range(1.0, 1000.0, "m"), [Fvdm Gfm] range;
        LengthScale "follow.length_scale" range(0.1, 10.0, ""), [Fvdm Ovm Gfm] length_scale;
        Coolness "follow.coolness" range(0.0, 1.0, ""), [Acc] coolness;
        AdjustmentTime "follow.adjustment_time" range(0.1, 100.0, "s"), [Gfm] adjustment_time;
        AccelerationRange "follow.acceleration_range" range(0.5, 1000.0, "m"), [Gfm] acceleration_range;
        BrakingTime "follow.braking_time" range(0.1, 100.0, "s"), [Gfm] braking_time;
        BrakingRange "follow.braking_range" range(1.0, 10_000.0, "m"), [Gfm] braking_range;
        Adaptation "follow.adaptation" range(0.0, 10.0, "s"), [Krauss] adaptation;
        ReactionTime "follow.reaction_time" range(0.1, 10.0, "s"), [Gipps] reaction_time;
        LeaderDeceleration "follow.leader_deceleration" range(0.1, 10.0, "m/s²"), [Gipps] leader_deceleration;
    }
    change {
        Theta "change.theta" Range::ANY, Mcdm theta;
        Sigma "change.sigma" range(0.0, f64::INFINITY, ""), Mcdm sigma;
        RoutePenalty "change.route.penalty" range(0.0, 1e6, "s"), Mcdm route.penalty;
        RouteReference "change.route.reference" range(1.0, 1e6, "s"), Mcdm route.reference;
        ComfortBeta "change.comfort.beta" range(0.0, 20.0, ""), Mcdm comfort.beta;
        KeepingStay "change.keeping.stay" range(0.1, 600.0, "s"), Mcdm keeping.stay;
        ReturningAlpha "change.returning.alpha" range(0.0, 100.0, "1/(s m)"), Mcdm returning.alpha;
        NeededGap "change.returning.needed_gap" range(0.0, 60.0, "s"), Mcdm returning.needed_gap;
        ChangeTime "change.returning.change_time" range(0.0, 60.0, "s"), Mcdm returning.change_time;
        TrialTime "change.returning.trial_time" range(0.1, 60.0, "s"), Mcdm returning.trial_time;
        Politeness "change.politeness" range(0.0, 10.0, ""), Mobil politeness;
        Threshold "change.threshold" range(-10.0, 10.0, "m/s²"), Mobil threshold;
        Bias "change.bias" range(-10.0, 10.0, "m/s²"), Mobil bias;
        SafeDeceleration "change.safe_deceleration" range(0.1, 8.0, "m/s²"), Mobil safe_deceleration;
        CriticalSpeed "change.critical_speed" range(0.0, 100.0, "m/s"), Mobil critical_speed;
        Urgency "change.urgency" range(0.0, 100.0, "m/s²"), Mobil urgency;
        Free "change.free" range(0.01, 1.0, ""), Lmrs free;
        Synchronize "change.synchronize" range(0.01, 1.0, ""), Lmrs synchronize;
        Cooperate "change.cooperate" range(0.01, 1.0, ""), Lmrs cooperate;
        SpeedGain "change.speed_gain" range(0.1, 100.0, "m/s"), Lmrs speed_gain;
        CongestedSpeed "change.congested_speed" range(0.0, 100.0, "m/s"), Lmrs congested_speed;
        DesireAcceleration "change.acceleration" range(0.1, 10.0, "m/s²"), Lmrs acceleration;
        Hazard "change.hazard" range(0.0, 1.0, ""), ConstantHazard hazard;
    }
    other {
        SpeedFactor "speed_factor" range(0.1, 3.0, ""), speed_factor;
        MinGap "safety.min_gap" range(0.1, 50.0, "m"), safety.min_gap;
        MinLagGap "safety.min_lag_gap" range(0.0, 50.0, "m"), safety.min_lag_gap;
        ClosingGrowth "safety.closing_growth" range(0.0, 1.0, "s/m"), safety.closing_growth;
        MinTimeToCollision "safety.min_time_to_collision" range(0.0, 60.0, "s"), safety.min_time_to_collision;
        MaxDeceleration "safety.max_deceleration" range(0.1, 8.0, "m/s²"), safety.max_deceleration;
        Epoch "attention.epoch" range(0.1, 60.0, "s"), attention.epoch;
        ConcentratedFor "attention.concentrated_for" range(0.0, 1e5, "s"), attention.concentrated_for;
        InattentiveFor "attention.inattentive_for" range(0.0, 1e5, "s"), attention.inattentive_for;
        InattentiveEpoch "attention.inattentive.epoch" range(0.1, 60.0, "s"), attention.inattentive.epoch;
        InattentiveSight "attention.inattentive.sight" range(10.0, 295.0, "m"), attention.inattentive.sight;
        InattentiveComfort "attention.inattentive.comfort" range(0.0, 100.0, ""), attention.inattentive.comfort;
        ChangeDuration "manner.change_duration" range(1.0, 20.0, "s"), manner.change_duration;
        PressedDuration "manner.pressed_duration" range(1.0, 20.0, "s"), manner.pressed_duration;
        Patience "manner.patience" range(0.1, 3600.0, "s"), manner.patience;
        Calm "manner.calm" range(0.0, 3600.0, "s"), manner.calm;
        AdjustDeceleration "manner.adjust_deceleration" range(0.0, 8.0, "m/s²"), manner.adjust_deceleration;
        FreeAdjustDeceleration "manner.free_adjust_deceleration" range(0.0, 8.0, "m/s²"), manner.free_adjust_deceleration;
        YieldDeceleration "manner.yield_deceleration" range(0.0, 8.0, "m/s²"), manner.yield_deceleration;
        ComfortableDeceleration "manner.comfortable_deceleration" range(0.0, 8.0, "m/s²"), manner.comfortable_deceleration;
        LateralAcceleration "manner.lateral_acceleration" range(0.0, 10.0, "m/s²"), manner.lateral_acceleration;
        Tightest "manner.tightest" range(0.05, 1.0, ""), manner.tightest;
        Relaxation "manner.relaxation" range(0.1, 3600.0, "s"), manner.relaxation;
        Misperception "manner.misperception" range(0.0, 10.0, ""), manner.misperception;
        CriticalGap "yielding.critical_gap" range(0.0, 60.0, "s"), yielding.critical_gap;
        YieldingPatience "yielding.patience" range(0.1, 3600.0, "s"), yielding.patience;
        RouteError "guidance.route_error" range(0.0, 2.0, ""), guidance.route_error;
        Indifference "guidance.indifference" range(0.0, 1e5, "s"), guidance.indifference;
        Habit "guidance.habit" range(0.0, 1.0, ""), guidance.habit;
        Compliance "guidance.compliance" range(0.0, 1.0, ""), guidance.compliance;
        TurnTime "guidance.turn_s" range(0.0, 3600.0, "s"), guidance.turn_s;
        LightTime "guidance.light_s" range(0.0, 3600.0, "s"), guidance.light_s;
    }
} }

impl Parameter {
    /// The number with this key in a style file.
    pub fn of_key(key: &str) -> Option<Parameter> {
        Parameter::ALL.iter().copied().find(|it| it.key() == key)
    }
}

impl Serialize for Parameter {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key())
    }
}

impl<'de> Deserialize<'de> for Parameter {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Parameter, D::Error> {
        let key = String::deserialize(deserializer)?;
        Parameter::of_key(&key).ok_or_else(|| Error::custom(format!("unknown number of a style: \"{key}\"")))
    }
}
