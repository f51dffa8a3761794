//! The styles of drivers with the numbers that can be changed.

use laneweave::{Parameter, StyleState};
use serde::Serialize;

/// A style of drivers.
#[derive(Clone, Debug, Serialize)]
pub struct StyleFacts {
    /// Its name.
    pub name: String,
    /// One sentence about it.
    pub description: String,
    /// Its weight among the styles of the drivers who arrive.
    pub weight: f64,
    /// Its numbers.
    pub parameters: Vec<ParameterFacts>,
}

/// A number of a style.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterFacts {
    /// Its key in a style file.
    pub key: &'static str,
    /// Its unit; empty if it has none.
    pub unit: &'static str,
    /// Its value: the mean over the drivers of the style.
    pub value: f64,
    /// The least value, if there is one.
    pub minimum: Option<f64>,
    /// The greatest value, if there is one.
    pub maximum: Option<f64>,
}

impl From<StyleState> for StyleFacts {
    fn from(style: StyleState) -> StyleFacts {
        let StyleState { name, description, weight, parameters } = style;
        let parameters = parameters.into_iter().map(|(it, value)| ParameterFacts::of(it, value)).collect();
        StyleFacts { name, description, weight, parameters }
    }
}

impl ParameterFacts {
    fn of(parameter: Parameter, value: f64) -> ParameterFacts {
        let range = parameter.range();
        let limit = |it: f64| it.is_finite().then_some(it);
        ParameterFacts {
            key: parameter.key(),
            unit: range.unit,
            value,
            minimum: limit(range.from),
            maximum: limit(range.to),
        }
    }
}
