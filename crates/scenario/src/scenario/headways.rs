//! The distribution of headways in a scenario.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use laneweave_network::Network;
use laneweave_sim::{self as sim, Demand, HeadwayError};

use super::Origin;
use crate::fault::Fault;

/// Distribution of the headways, the times between arrivals in a lane; its mean follows from the demand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Headways {
    /// Negative exponential: vehicles that arrive independently.
    #[default]
    Exponential,
    /// Shifted exponential: exponential beyond a minimum headway.
    Shifted {
        /// Minimum headway [s].
        #[serde(default = "usual_minimum")]
        minimum_s: f64,
    },
    /// Erlang: the sum of exponential stages.
    Erlang {
        /// Number of stages.
        #[serde(default = "usual_stages")]
        stages: u32,
    },
    /// Pearson III: gamma beyond a minimum headway.
    PearsonIii {
        /// Minimum headway [s].
        #[serde(default = "usual_minimum")]
        minimum_s: f64,
        /// Standard deviation relative to the mean.
        #[serde(default = "usual_variation")]
        variation: f64,
    },
    /// Lognormal.
    Lognormal {
        /// Standard deviation relative to the mean.
        #[serde(default = "usual_variation")]
        variation: f64,
    },
    /// Cowan's M3: followers have the minimum headway; headways of free drivers are exponential beyond it.
    CowanM3 {
        /// Minimum headway [s].
        #[serde(default = "usual_following")]
        minimum_s: f64,
        /// Share of free drivers.
        #[serde(default = "usual_free")]
        free: f64,
    },
}

/// Default of the minimum headway [s], ours.
fn usual_minimum() -> f64 {
    0.5
}

/// Default of the followers' headway [s], ours.
fn usual_following() -> f64 {
    1.5
}

/// Default share of free drivers, ours.
fn usual_free() -> f64 {
    0.6
}

/// Default: half as wide as an exponential distribution, ours.
fn usual_variation() -> f64 {
    0.5
}

/// Default: the smallest number for which the distribution is not exponential.
fn usual_stages() -> u32 {
    2
}

impl From<Headways> for sim::Headways {
    fn from(law: Headways) -> sim::Headways {
        match law {
            Headways::Exponential => sim::Headways::Exponential,
            Headways::Shifted { minimum_s } => sim::Headways::Shifted { minimum: minimum_s },
            Headways::Erlang { stages } => sim::Headways::Erlang { stages },
            Headways::PearsonIii { minimum_s, variation } => {
                sim::Headways::PearsonIii { minimum: minimum_s, variation }
            }
            Headways::Lognormal { variation } => sim::Headways::Lognormal { variation },
            Headways::CowanM3 { minimum_s, free } => sim::Headways::CowanM3 { minimum: minimum_s, free },
        }
    }
}

/// Checks that the headways of `demand` are possible at each of its origins.
///
/// # Errors
/// The first origin at which they are not.
pub(super) fn check(demand: &Demand, network: &Network, origin: &Origin) -> Result<(), Fault> {
    for it in &demand.origins {
        let Err(error) = demand.headways.check(it.rate_of_a_lane(network)) else { continue };
        let (key, remedy) = match error {
            HeadwayError::Minimum { .. } => {
                ("minimum_s", format!("choose less, or reduce the demand at the entrance {}", it.place.id()))
            }
            HeadwayError::Parameter { key, least, most, .. } => {
                (if key == "minimum" { "minimum_s" } else { key }, format!("choose {least} to {most}"))
            }
        };
        return Err(Fault::new(origin.place(&["demand", "headways", key]), error, remedy));
    }
    Ok(())
}
