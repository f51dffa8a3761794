//! The models that drive at a place, and what is measured of their traffic.

use laneweave_scenario::Fault;

use super::SAME_DRAW;
use super::advance::Advance;
use super::models::{ROLLOUTS, Rate, Rival, STEPS};
use super::report::{Design, JudgedMeasure, JudgedModel, Measured, Predicted, measured};
use super::rollout::{Drivers, Stage};
use super::tally::{Scope, Tally};
use super::{RARE, Rollouts};
use crate::parallel::in_parallel;

/// A model that is simulated.
pub(super) struct Contestant {
    name: &'static str,
    /// The number that was fitted to the rate of lane changes, by its key in a style.
    scale: Option<(&'static str, f64)>,
    drivers: Drivers,
    /// Whether each pair of rollouts has another draw of the parameters.
    is_drawn: bool,
}

impl Contestant {
    /// All of them: the fitted drivers first, then the rivals, whose numbers are fitted to the `recorded` rate of lane
    /// changes, and last the drivers of a built-in style as they are.
    ///
    /// # Errors
    /// If a simulation cannot run.
    pub(super) fn all(
        [fitted, default]: [Drivers; 2],
        recorded: &Rate,
        (threads, advance): (usize, &Advance),
    ) -> Result<Vec<Contestant>, Fault> {
        let scales = in_parallel(&Rival::ALL, threads, |it| it.fitted(&fitted, recorded, advance))?;
        let mut all =
            vec![Contestant { name: "fitted", scale: None, drivers: fitted.clone(), is_drawn: true }];
        for (rival, scale) in Rival::ALL.into_iter().zip(scales) {
            let (drivers, scale) = (rival.drives(&fitted, scale)?, Some((rival.key(), scale)));
            all.push(Contestant { name: rival.name(), scale, drivers, is_drawn: false });
        }
        all.push(Contestant { name: "default", scale: None, drivers: default, is_drawn: false });
        Ok(all)
    }

    /// Simulations that it takes to fit the rivals and to roll out all models in so many designs.
    pub(super) fn simulations(rollouts: &Rollouts, designs: usize) -> usize {
        let models = Rival::ALL.len() + 2;
        (Rival::ALL.len() + 1) * STEPS * ROLLOUTS as usize + models * rollouts.count as usize * designs
    }
}

/// What was simulated of each model: what was measured in each rollout, and the collisions.
type Simulated = Vec<Vec<(Tally, u64)>>;

/// A design: where and how recorded demand is simulated, and what was recorded there.
pub(super) struct Stages<'a> {
    pub(super) stages: Vec<(Stage, Scope<'a>)>,
    pub(super) recorded: Tally,
    /// Time that is measured [s].
    pub(super) seconds: f64,
}

impl Stages<'_> {
    /// The design with all models.
    ///
    /// # Errors
    /// If a simulation cannot run.
    pub(super) fn judged(
        &self,
        models: &[Contestant],
        rollouts: &Rollouts,
        advance: &Advance,
    ) -> Result<(Design, Vec<JudgedModel>), Fault> {
        let simulated = self.simulated(models, rollouts, advance)?;
        let design = Design {
            simulations: self.stages.len(),
            simulated_s: self.seconds,
            events: self.recorded.changes(),
            densities_veh_per_km: self.recorded.densities(),
            measures: measures(models, &self.recorded, &simulated),
        };
        let model = |(model, rollouts): (&Contestant, &Vec<(Tally, u64)>)| JudgedModel {
            model: model.name,
            scale: model.scale,
            collisions: rollouts.iter().map(|it| it.1 as f64).sum::<f64>() / rollouts.len().max(1) as f64,
        };
        Ok((design, models.iter().zip(&simulated).map(model).collect()))
    }

    fn simulated(
        &self,
        models: &[Contestant],
        rollouts: &Rollouts,
        advance: &Advance,
    ) -> Result<Simulated, Fault> {
        let count = rollouts.count as usize;
        let jobs: Vec<(usize, usize)> =
            (0..models.len()).flat_map(|model| (0..count).map(move |number| (model, number))).collect();
        let all = in_parallel(&jobs, rollouts.threads, |(model, number)| {
            let Contestant { drivers, is_drawn, .. } = &models[*model];
            let draw = is_drawn.then_some((number / SAME_DRAW) as u32);
            let drivers = Drivers { draw, ..drivers.clone() };
            let (mut tally, mut collisions) = (Tally::default(), 0);
            for (stage, scope) in &self.stages {
                let rollout = stage.rollout(&drivers, *number as u64 + 1)?;
                tally.add(&rollout.recording, scope)?;
                collisions += rollout.collisions;
            }
            advance.by_one();
            Ok((tally, collisions))
        })?;
        let mut all = all.into_iter();
        Ok(models.iter().map(|_| all.by_ref().take(count).collect()).collect())
    }
}

/// The rollouts of all models beside what was `recorded`.
fn measures(models: &[Contestant], recorded: &Tally, rollouts: &Simulated) -> Vec<JudgedMeasure> {
    let thirds = recorded.thirds();
    let total = recorded.exposure()[0];
    let lanes = recorded.lanes.iter().filter(|it| it.0 >= RARE * total).count();
    let lanes = if lanes > 1 { lanes } else { 0 };
    let of = |tally: &Tally| measured(tally, thirds, lanes);
    let simulated: Vec<Vec<Vec<Measured>>> =
        rollouts.iter().map(|model| model.iter().map(|(tally, _)| of(tally)).collect()).collect();
    let measure = |(at, recorded): (usize, Measured)| {
        let column = |model: usize| simulated[model].iter().map(|it| it[at].value).collect::<Vec<_>>();
        let counts =
            |model: usize| simulated[model].iter().map(|it| it[at].count).collect::<Option<Vec<_>>>();
        let predicted = |model: usize| {
            let same = if models[model].is_drawn { SAME_DRAW } else { 1 };
            let predicted = Predicted::of(&column(model), recorded.value, &column(0), same);
            predicted.with_counts(counts(model), recorded.count)
        };
        let simulated = (0..models.len()).map(predicted).collect();
        let Measured { key, name, value, .. } = recorded;
        JudgedMeasure { key, name, recorded: value, simulated }
    };
    of(recorded).into_iter().enumerate().map(measure).collect()
}
