//! The lane-change models that drive beside the fitted style, each with one number that is fitted to the rate of
//! lane changes.

use laneweave_models::change::{LaneChangeModel, Lmrs, Mcdm, Mobil, Traffic};
use laneweave_scenario::style::{Model, StyleTemplate};
use laneweave_scenario::{Fault, Source};

use super::advance::Advance;
use super::rollout::{Drivers, Stage};
use super::tally::{Scope, Tally};

/// A lane-change model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rival {
    /// Changes lanes at a constant chance, whatever it sees.
    Null,
    Mobil,
    Lmrs,
}

/// Steps of the search for a scale.
pub(super) const STEPS: usize = 8;
/// Rollouts of each step.
pub(super) const ROLLOUTS: u64 = 2;

impl Rival {
    /// All of them.
    pub(super) const ALL: [Rival; 3] = [Rival::Null, Rival::Mobil, Rival::Lmrs];

    pub(super) fn name(self) -> &'static str {
        match self {
            Rival::Null => "null",
            Rival::Mobil => "mobil",
            Rival::Lmrs => "lmrs",
        }
    }

    /// The number that is fitted, by its key in a style.
    pub(super) fn key(self) -> &'static str {
        match self {
            Rival::Null => "change.theta",
            Rival::Mobil => "change.threshold",
            Rival::Lmrs => "change.speed_gain",
        }
    }

    /// The values between which it is searched: the larger it is, the fewer changes there are.
    fn range(self) -> [f64; 2] {
        match self {
            Rival::Null => [0.0, 12.0],
            Rival::Mobil => [0.0, 4.0],
            Rival::Lmrs => [2.0, 100.0],
        }
    }

    /// `drivers` with this model and this number.
    ///
    /// # Errors
    /// None for styles that were fitted.
    pub(super) fn drives(self, drivers: &Drivers, number: f64) -> Result<Drivers, Fault> {
        let style = |(text, share): &(String, f64)| {
            let template = StyleTemplate::parse(&Source { path: self.name().into(), text: text.clone() })?;
            let template = match self {
                Rival::Null => {
                    let template = Model::Null.drives(template)?;
                    let change = match &template.typical().change {
                        LaneChangeModel::Mcdm(it) => Mcdm { theta: number, ..it.clone() },
                        _ => Mcdm::default(),
                    };
                    template.with_change(&LaneChangeModel::Mcdm(change))?
                }
                Rival::Mobil => template.with_change(&LaneChangeModel::Mobil(Mobil {
                    traffic: Traffic::Law,
                    threshold: number,
                    ..Mobil::default()
                }))?,
                Rival::Lmrs => template
                    .with_change(&LaneChangeModel::Lmrs(Lmrs { speed_gain: number, ..Lmrs::default() }))?,
            };
            let text = toml::to_string(template.table()).map_err(|error| Fault::bug(self.name(), error))?;
            Ok((text, *share))
        };
        let styles = drivers.styles.iter().map(style).collect::<Result<_, Fault>>()?;
        Ok(Drivers { styles, draw: None })
    }

    /// The number with which these drivers change lanes as often as `recorded`.
    ///
    /// # Errors
    /// If a simulation cannot run.
    pub(super) fn fitted(self, drivers: &Drivers, recorded: &Rate, advance: &Advance) -> Result<f64, Fault> {
        recorded.reached(self.range(), |number| self.drives(drivers, number), advance)
    }
}

/// How often recorded drivers changed lanes, and where.
pub(super) struct Rate<'a> {
    /// Stages with their scopes.
    pub(super) stages: &'a [(Stage, Scope<'a>)],
    /// Changes per vehicle-kilometre there.
    pub(super) per_km: f64,
}

impl Rate<'_> {
    /// The number in this range with which drivers change lanes as often as recorded, the less often the larger it is:
    /// by bisection; at an end of the range, if they never do.
    ///
    /// # Errors
    /// If a simulation cannot run.
    pub(super) fn reached(
        &self,
        [mut low, mut high]: [f64; 2],
        drivers: impl Fn(f64) -> Result<Drivers, Fault>,
        advance: &Advance,
    ) -> Result<f64, Fault> {
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            let drivers = drivers(middle)?;
            let mut tally = Tally::default();
            for seed in 1..=ROLLOUTS {
                for (stage, scope) in self.stages {
                    tally.add(&stage.rollout(&drivers, seed)?.recording, scope)?;
                }
                advance.by_one();
            }
            if tally.rate().unwrap_or(0.0) > self.per_km { low = middle } else { high = middle }
        }
        Ok(0.5 * (low + high))
    }
}
