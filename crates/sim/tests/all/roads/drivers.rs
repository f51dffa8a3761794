//! Drivers for tests.

use laneweave_models::change::{Comfort, Courtesy, LaneChangeModel, Mcdm, Route, Rule, Speed, Urgency};
use laneweave_models::follow::{FollowingModel, Fvdm, Idm};
use laneweave_models::yielding::Yielding;
use laneweave_models::{Attention, Guidance, Manner, Style};
use laneweave_sim::{Demand, Share};

/// A conservative IDM driver with the paper's weights, repaired.
pub(crate) fn conservative() -> Style {
    Style {
        name: "conservative".into(),
        description: String::new(),
        speed_factor: 1.0,
        follow: FollowingModel::Idm(Idm {
            acceleration: 1.4,
            deceleration: 2.0,
            time_gap: 1.2,
            jam_gap: 2.0,
            exponent: 4.0,
        }),
        change: LaneChangeModel::Mcdm(Mcdm {
            rule: Rule::Logit,
            theta: 0.112,
            sigma: 0.014,
            speed: Speed { weight: 0.44, ..Speed::default() },
            route: Route { weight: 0.41, ..Route::default() },
            comfort: Comfort { weight: 0.09, beta: 2.3, ..Comfort::default() },
            courtesy: Courtesy { weight: 1.72, ..Courtesy::default() },
            urgency: Urgency { weight: 0.9 },
            ..Mcdm::default()
        }),
        safety: Default::default(),
        attention: Attention::default(),
        manner: Manner::default(),
        yielding: Yielding::default(),
        guidance: Guidance::default(),
    }
}

/// An aggressive FVDM driver with the paper's weights, repaired.
pub(crate) fn aggressive() -> Style {
    let LaneChangeModel::Mcdm(mcdm) = conservative().change else { unreachable!() };
    Style {
        name: "aggressive".into(),
        speed_factor: 1.1,
        follow: FollowingModel::Fvdm(Fvdm { jam_gap: 1.5, ..Fvdm::default() }),
        change: LaneChangeModel::Mcdm(Mcdm {
            speed: Speed { weight: 1.26, ..Speed::default() },
            route: Route { weight: 0.58, ..Route::default() },
            comfort: Comfort { weight: 0.03, beta: 1.1, ..Comfort::default() },
            courtesy: Courtesy { weight: 0.61, ..Courtesy::default() },
            ..mcdm
        }),
        ..conservative()
    }
}

/// A demand of `total` [veh/h], with a share of trucks and the given weights of the first drivers.
pub(crate) fn demand(
    network: &laneweave_network::Network,
    total: f64,
    trucks: f64,
    weights: &[f64],
) -> Demand {
    let population =
        weights.iter().zip(0..).map(|(weight, first)| Share { weight: *weight, first, count: 1 }).collect();
    Demand::even(network, total, trucks, population)
}
