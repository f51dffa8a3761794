//! Lane changes against density, recorded and simulated: what the paper's second figure is of.

use laneweave_study::{Estimated, Interval};

use super::report::BY_DENSITY;
use super::{Design, Judged, Predicted};

/// What the axes of the figure show.
pub(crate) const AXES: [&str; 2] = ["Density of the lane [veh/km]", "Lane changes [1/veh-km]"];

/// Lane changes in one class of density.
pub(crate) struct InClass<'a> {
    /// Mean recorded density of its traffic [veh/km].
    pub(crate) density: f64,
    /// Recorded changes per vehicle-kilometre; none without traffic.
    pub(crate) recorded: Option<f64>,
    /// What the models predict.
    pub(crate) simulated: &'a [Predicted],
}

impl Design {
    /// The classes of density, from light traffic on.
    pub(crate) fn classes(&self) -> impl Iterator<Item = InClass<'_>> {
        BY_DENSITY.iter().zip(self.densities_veh_per_km).filter_map(|(key, density)| {
            let measure = self.measures.iter().find(|it| it.key == *key)?;
            Some(InClass { density, recorded: measure.recorded, simulated: &measure.simulated })
        })
    }

    /// Whether the recorded rate lies in the interval of a model in every class with traffic, and there is one.
    pub(crate) fn is_followed_by(&self, model: usize) -> bool {
        let mut known = self.classes().filter(|it| it.recorded.is_some()).peekable();
        known.peek().is_some() && known.all(|it| it.simulated[model].recorded_is == "inside")
    }

    /// A curve of what was recorded, and one of each of the `judged` models with intervals.
    pub(crate) fn curves(&self, judged: &Judged) -> Vec<(String, Vec<Estimated>)> {
        let recorded = self.classes().filter_map(|it| {
            let value = it.recorded?;
            Some(Estimated { at: it.density, value, interval: Interval { lower: value, upper: value } })
        });
        let of = |model: usize| {
            self.classes().filter_map(move |it| {
                let Predicted { median, interval, .. } = &it.simulated[model];
                let [lower, upper] = (*interval)?;
                Some(Estimated { at: it.density, value: (*median)?, interval: Interval { lower, upper } })
            })
        };
        let models = judged.models.iter().enumerate();
        let models = models.map(|(number, it)| (it.model.to_owned(), of(number).collect()));
        [("recorded".to_owned(), recorded.collect())].into_iter().chain(models).collect()
    }
}
