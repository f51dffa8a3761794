//! One lane-change model for all drivers, so that models can be compared on the same traffic: the other parts of
//! their styles stay.

use std::path::Path;

use laneweave_models::change::{ConstantHazard, LaneChangeModel, Lmrs, Mcdm, Mobil, RouteKeeping, Traffic};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{DEFAULT_MIXTURE, StyleTemplate, find};
use crate::fault::Fault;

/// A lane-change model in place of that of the styles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Multi-criteria decision-making: the weights of the style, or of conservative drivers where it has none.
    Mcdm,
    /// MOBIL, symmetric, which follows its route by urgency.
    Mobil,
    /// MOBIL, European or symmetric by the law of the map, which follows its route by urgency.
    MobilLaw,
    /// MOBIL, symmetric, which never leaves the lanes of its route.
    MobilLanes,
    /// LMRS, which follows its route by urgency.
    Lmrs,
    /// LMRS, which never leaves the lanes of its route.
    LmrsLanes,
    /// Null-model control: multi-criteria decision-making with all weights 0; only its choice noise is left.
    Null,
    /// Null-model control: changes lanes at a constant rate, without a reason.
    ConstantHazard,
}

impl Model {
    /// All of them.
    pub const ALL: [Model; 8] = [
        Model::Mcdm,
        Model::Mobil,
        Model::MobilLaw,
        Model::MobilLanes,
        Model::Lmrs,
        Model::LmrsLanes,
        Model::Null,
        Model::ConstantHazard,
    ];

    /// Its name in scenarios and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Model::Mcdm => "mcdm",
            Model::Mobil => "mobil",
            Model::MobilLaw => "mobil-law",
            Model::MobilLanes => "mobil-lanes",
            Model::Lmrs => "lmrs",
            Model::LmrsLanes => "lmrs-lanes",
            Model::Null => "null",
            Model::ConstantHazard => "constant-hazard",
        }
    }

    /// Its description.
    pub fn words(self) -> &'static str {
        match self {
            Model::Mcdm => "multi-criteria decision-making (Li et al.): the weights of the styles",
            Model::Mobil => {
                "minimizing overall braking (Kesting et al.), symmetric; follows its route by urgency"
            }
            Model::MobilLaw => {
                "minimizing overall braking (Kesting et al.), keeping to the slow side where the law of the map has it; \
                 follows its route by urgency"
            }
            Model::MobilLanes => {
                "minimizing overall braking (Kesting et al.), symmetric; never leaves the lanes of its route"
            }
            Model::Lmrs => "relaxation and synchronization (Schakel et al.); follows its route by urgency",
            Model::LmrsLanes => {
                "relaxation and synchronization (Schakel et al.); never leaves the lanes of its route"
            }
            Model::Null => {
                "null-model control: multi-criteria decision-making with all weights 0; only its choice noise is left"
            }
            Model::ConstantHazard => "null-model control: changes lanes at a constant rate, without a reason",
        }
    }

    /// The style `template` with this lane-change model.
    ///
    /// # Errors
    /// None for the built-in styles.
    pub fn drives(self, template: StyleTemplate) -> Result<StyleTemplate, Fault> {
        let lanes = RouteKeeping::Lanes;
        let change = match self {
            Model::Mcdm => match &template.typical().change {
                LaneChangeModel::Mcdm(_) => return Ok(template),
                _ => LaneChangeModel::Mcdm(usual()?),
            },
            Model::Null => {
                let model = match &template.typical().change {
                    LaneChangeModel::Mcdm(model) => model.clone(),
                    _ => usual()?,
                };
                LaneChangeModel::Mcdm(model.with_weights(|_| 0.0))
            }
            Model::Mobil => LaneChangeModel::Mobil(Mobil::default()),
            Model::MobilLaw => LaneChangeModel::Mobil(Mobil { traffic: Traffic::Law, ..Mobil::default() }),
            Model::MobilLanes => LaneChangeModel::Mobil(Mobil { route: lanes, ..Mobil::default() }),
            Model::Lmrs => LaneChangeModel::Lmrs(Lmrs::default()),
            Model::LmrsLanes => LaneChangeModel::Lmrs(Lmrs { route: lanes, ..Lmrs::default() }),
            Model::ConstantHazard => LaneChangeModel::ConstantHazard(ConstantHazard::default()),
        };
        template.with_change(&change)
    }
}

/// The style of conservative drivers.
fn usual() -> Result<Mcdm, Fault> {
    let [_, (name, _)] = DEFAULT_MIXTURE;
    let template = StyleTemplate::parse(&find(name, Path::new(""), String::new)?)?;
    match &template.typical().change {
        LaneChangeModel::Mcdm(model) => Ok(model.clone()),
        _ => Ok(Mcdm::default()),
    }
}

#[cfg(test)]
mod tests {
    use laneweave_models::change::IncentiveName;

    use super::*;
    use crate::source::Source;

    #[test]
    fn the_null_control_has_no_reason_left_whichever_incentives_there_are() {
        let weights = IncentiveName::ALL.map(|it| format!("{}.weight = 1.0\n", it.name())).concat();
        let weighed = format!(
            "name = \"x\"\n[follow]\nmodel = \"idm\"\n[change]\nmodel = \"mcdm\"\nsigma = 0.01\n{weights}"
        );
        let weighed =
            StyleTemplate::parse(&Source { path: "x.toml".into(), text: weighed }).expect("a style");
        let LaneChangeModel::Mcdm(model) = &weighed.typical().change else { panic!("mcdm") };
        assert_eq!(IncentiveName::ALL.map(|it| model.weight(it)), IncentiveName::ALL.map(|_| 1.0));
        let null = Model::Null.drives(weighed).expect("a control");
        let LaneChangeModel::Mcdm(model) = &null.typical().change else { panic!("mcdm") };
        assert_eq!(IncentiveName::ALL.map(|it| model.weight(it)), IncentiveName::ALL.map(|_| 0.0));
    }
}
