//! The styles of drivers with the numbers that can be changed.

use laneweave::Parameter;
use laneweave::models::Style;
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

impl StyleFacts {
    /// The style `name` of these drivers, with its weight.
    pub fn of(name: &str, weight: f64, drivers: &[Style]) -> StyleFacts {
        let own: Vec<&Style> = drivers.iter().filter(|it| it.name == name).collect();
        let parameters = Parameter::ALL.iter().filter_map(|it| ParameterFacts::of(*it, &own)).collect();
        let description = own.first().map_or_else(String::new, |it| it.description.clone());
        StyleFacts { name: name.to_owned(), description, weight, parameters }
    }

    /// The value of a number.
    pub fn value(&self, parameter: Parameter) -> Option<f64> {
        self.parameters.iter().find(|it| it.key == parameter.key()).map(|it| it.value)
    }
}

impl ParameterFacts {
    fn of(parameter: Parameter, drivers: &[&Style]) -> Option<ParameterFacts> {
        let value = |style: &Style| parameter.place(&mut style.clone()).map(|it| *it);
        let values: Vec<f64> = drivers.iter().filter_map(|it| value(it)).collect();
        // Equal values have exactly their mean.
        let first = *values.first()?;
        let above = values.iter().map(|it| it - first).sum::<f64>() / values.len() as f64;
        let range = parameter.range();
        let limit = |it: f64| it.is_finite().then_some(it);
        Some(ParameterFacts {
            key: parameter.key(),
            unit: range.unit,
            value: first + above,
            minimum: limit(range.from),
            maximum: limit(range.to),
        })
    }
}
