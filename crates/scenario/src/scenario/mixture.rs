//! From the styles of a scenario to a mixture of drivers.

use super::{Origin, Scenario};
use crate::fault::{Fault, FaultKind};
use crate::style::StyleTemplate;

/// The styles of a scenario with their weights.
///
/// # Errors
/// If a style is unknown or wrong, or if the weights are invalid.
pub fn mixture(scenario: &Scenario, origin: &Origin) -> Result<Vec<(StyleTemplate, f64)>, Fault> {
    let mut mixture = Vec::new();
    for (name, weight) in &scenario.styles {
        let place = || origin.place(&["styles", name]);
        let of_style = |fault: Fault| fault.of_kind(FaultKind::Style);
        let template = StyleTemplate::parse(&origin.style(name)?).map_err(of_style)?;
        if !(weight.is_finite() && *weight >= 0.0) {
            let what = format!("the style {name:?} has the weight {weight}");
            return Err(Fault::new(place(), what, "give it a finite weight of 0 or more"));
        }
        let template = match scenario.run.parameter_draw.filter(|_| template.draws() > 0) {
            Some(number) => template.drawn(number).map_err(|fault| Fault { place: place(), ..fault })?,
            None => template,
        };
        let template = match scenario.model {
            Some(model) => model.drives(template)?,
            None => template,
        };
        mixture.push((template, *weight));
    }
    let total: f64 = scenario.styles.values().sum();
    if !(total.is_finite() && total > 0.0) {
        let what = format!("the weights of the styles add up to {total}");
        return Err(Fault::new(
            origin.place(&["styles"]),
            what,
            "give at least one of them a weight above 0",
        ));
    }
    // The names and folders of style files do not matter.
    mixture.sort_by(|(a, _), (b, _)| a.typical().name.cmp(&b.typical().name));
    Ok(mixture)
}
