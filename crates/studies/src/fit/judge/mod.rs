//! A fit in the world: the place of the recordings is simulated with fitted drivers and the recorded demand, and set
//! beside what was recorded.
//!
//! The style is fitted to the first two thirds of the recorded time. In the last third vehicles come when, where and as
//! fast as they came, and drive on as drivers. A virtual drone sees them, so that recorded and simulated traffic are
//! measured in the same way.
//!
//! `split.rs` cuts recordings in time, `rollout.rs` simulates the recorded demand, all of whose vehicles are drivers,
//! and `tally.rs` measures recorded and simulated traffic in one way.

mod models;
#[cfg(feature = "reports")]
mod page;
pub(super) mod report;
mod rollout;
mod split;
mod tally;
mod words;

use laneweave_calibration::{Asked, Study};
use laneweave_scenario::Fault;

use super::Observed;
use super::report::FitReport;
use super::sources::Sources;
use crate::parallel::in_parallel;
use models::Rival;
use report::{Value, values};
use rollout::{Drivers, Stage};
use split::{Piece, Split, between};
use tally::{Scope, Tally};

#[cfg(feature = "reports")]
pub(super) use page::{figure, section};
pub use report::{Judged, JudgedMeasure, JudgedModel, Predicted};

/// How a fit is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rollouts {
    /// Rollouts of each model.
    pub count: u32,
    /// Rollouts at the same time.
    pub threads: usize,
}

/// Rollouts with the same draw of the parameters: so their spread is chance.
const SAME_DRAW: usize = 2;
/// A lane on which vehicles drive less than this share of the distance has no row of its own.
const RARE: f64 = 0.02;

impl Observed {
    /// Fits a style to the first two thirds of the recorded time, and simulates the last third with it; `None` if the
    /// recordings are too short to be simulated.
    ///
    /// # Errors
    /// If a style cannot be fitted to the first two thirds, or the place cannot be simulated.
    pub fn judge(&self, rollouts: &Rollouts) -> Result<Option<Judged>, Fault> {
        let split = Split::of(&self.sources);
        if split.before.is_empty() || split.after.is_empty() {
            return Ok(None);
        }
        let observed = self.of(split.fitted)?;
        let asked = Asked { draws: rollouts.count.div_ceil(SAME_DRAW as u32), ..observed.asked() };
        observed.check_changes()?;
        let (study, _) = observed.corrected(Study::alone(&observed.observations, &asked), &asked)?;
        let report = FitReport::of(&observed, &study)?;
        let shares = report.classes.iter().map(|it| it.share);
        let texts = report.styles.iter().map(|it| it.text.clone());
        let drivers = Drivers { styles: texts.zip(shares).collect(), draw: None };
        let [before, after] = [&split.before, &split.after].map(|it| self.stages(it, &drivers));
        let (before, after) = (before?, after?);
        let recorded = self.recorded(&split.before)?.rate().unwrap_or(0.0);
        let scales = in_parallel(&Rival::ALL, rollouts.threads, |it| it.fitted(&drivers, &before, recorded))?;
        let mut models = vec![Contestant { rival: None, scale: 0.0, drivers: drivers.clone() }];
        for (rival, scale) in Rival::ALL.into_iter().zip(scales) {
            models.push(Contestant { rival: Some(rival), scale, drivers: rival.drives(&drivers, scale)? });
        }
        let recorded = self.recorded(&split.after)?;
        let tallies = simulated(&models, &after, rollouts)?;
        let seconds = |pieces: &[Piece]| {
            let length = |it: &Piece| {
                (it.measured[1] - it.measured[0]) as f64 * self.sources.parts[it.part].recording.step
            };
            pieces.iter().map(length).sum::<f64>()
        };
        let mut judged = judged(&models, &recorded, &tallies);
        judged.fitted_s = observed.sources.seconds();
        judged.simulated_s = seconds(&split.after);
        judged.events_used = observed.observations.used().count();
        Ok(Some(judged))
    }

    /// The same with other recordings.
    fn of(&self, sources: Sources) -> Result<Observed, Fault> {
        self.request.observed(sources, self.request.prior_style()?)
    }

    /// The stages of pieces, and where they are measured.
    fn stages(&self, pieces: &[Piece], drivers: &Drivers) -> Result<Vec<(Stage, Scope<'_>)>, Fault> {
        let stage = |it: &Piece| Ok((Stage::of(&self.sources, it, drivers)?, self.scope(it)));
        pieces.iter().map(stage).collect()
    }

    fn scope(&self, piece: &Piece) -> Scope<'_> {
        let part = &self.sources.parts[piece.part];
        let times = piece.measured.map(|it| it as f64 * part.recording.step);
        Scope { site: &self.sources.sites[part.site], times, style: &self.prior.typical }
    }

    /// What was recorded in pieces.
    fn recorded(&self, pieces: &[Piece]) -> Result<Tally, Fault> {
        let mut tally = Tally::default();
        for piece in pieces {
            let recording = &self.sources.parts[piece.part].recording;
            tally.add(&between(recording, [piece.release, piece.measured[1]]), &self.scope(piece))?;
        }
        Ok(tally)
    }
}

/// A model that is simulated.
struct Contestant {
    /// None: the fitted style.
    rival: Option<Rival>,
    scale: f64,
    drivers: Drivers,
}

/// What was measured in each rollout of each model, and the collisions.
fn simulated(
    models: &[Contestant],
    stages: &[(Stage, Scope)],
    rollouts: &Rollouts,
) -> Result<Vec<Vec<(Tally, u64)>>, Fault> {
    let count = rollouts.count as usize;
    let jobs: Vec<(usize, usize)> =
        (0..models.len()).flat_map(|model| (0..count).map(move |number| (model, number))).collect();
    let all = in_parallel(&jobs, rollouts.threads, |(model, number)| {
        let Contestant { rival, drivers, .. } = &models[*model];
        let draw = rival.is_none().then_some((number / SAME_DRAW) as u32);
        let drivers = Drivers { draw, ..drivers.clone() };
        let (mut tally, mut collisions) = (Tally::default(), 0);
        for (stage, scope) in stages {
            let rollout = stage.rollout(&drivers, *number as u64 + 1)?;
            tally.add(&rollout.recording, scope)?;
            collisions += rollout.collisions;
        }
        Ok((tally, collisions))
    })?;
    let mut all = all.into_iter();
    Ok(models.iter().map(|_| all.by_ref().take(count).collect()).collect())
}

/// The rollouts of all models beside what was `recorded`.
fn judged(models: &[Contestant], recorded: &Tally, rollouts: &[Vec<(Tally, u64)>]) -> Judged {
    let thirds = recorded.thirds();
    let total = recorded.exposure()[0];
    let lanes = recorded.lanes.iter().filter(|it| it.0 >= RARE * total).count();
    let lanes = if lanes > 1 { lanes } else { 0 };
    let values = |tally: &Tally| values(tally, thirds, lanes);
    let simulated: Vec<Vec<Vec<Value>>> =
        rollouts.iter().map(|model| model.iter().map(|(tally, _)| values(tally)).collect()).collect();
    let measure = |(at, (key, name, recorded)): (usize, Value)| {
        let column = |model: usize| simulated[model].iter().map(|it| it[at].2).collect::<Vec<Option<f64>>>();
        let predicted = |model: usize| {
            let same = if models[model].rival.is_none() { SAME_DRAW } else { 1 };
            Predicted::of(&column(model), recorded, &column(0), same)
        };
        JudgedMeasure { key, name, recorded, simulated: (0..models.len()).map(predicted).collect() }
    };
    let model = |(model, rollouts): (&Contestant, &Vec<(Tally, u64)>)| JudgedModel {
        model: model.rival.map_or("fitted", Rival::name),
        scale: model.rival.map(|it| (it.key(), model.scale)),
        collisions: rollouts.iter().map(|it| it.1 as f64).sum::<f64>() / rollouts.len().max(1) as f64,
    };
    Judged {
        fitted_s: 0.0,
        simulated_s: 0.0,
        events_used: 0,
        events: recorded.changes(),
        rollouts: rollouts.first().map_or(0, Vec::len),
        models: models.iter().zip(rollouts).map(model).collect(),
        measures: values(recorded).into_iter().enumerate().map(measure).collect(),
    }
}
