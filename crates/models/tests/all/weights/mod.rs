//! The paper's model by its weights.

use laneweave_models::Reading;
use laneweave_models::change::{Comfort, Courtesy, Mcdm, Returning, Route, Rule, Speed};

/// The paper's model with the weights μ₁…μ₄ and β, by the threshold rule with θ = 0.
pub(crate) fn mcdm(reading: Reading, [speed, route, comfort, courtesy]: [f64; 4], beta: f64) -> Mcdm {
    Mcdm {
        rule: Rule::Threshold,
        speed: Speed { weight: speed, reading },
        route: Route { weight: route, reading: reading.into(), ..Route::default() },
        comfort: Comfort { weight: comfort, reading, beta },
        courtesy: Courtesy { weight: courtesy, reading },
        returning: Returning { reading, ..Returning::default() },
        ..Mcdm::default()
    }
}
