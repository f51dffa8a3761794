//! A fit in the world: the place of the recordings is simulated with fitted drivers and the recorded demand, and set
//! beside what was recorded.
//!
//! The style is fitted to the first two thirds of the recorded time. In the last third vehicles come when, where and as
//! fast as they came, drive on as drivers, and leave the view as fast as traffic did. A virtual drone sees them, so
//! that recorded and simulated traffic are measured in the same way.
//!
//! There are two designs. In one, the last third is driven as a whole: an error grows, and a queue that comes from
//! beyond the view has to be there. In the other, all vehicles become drivers where they were recorded, again and
//! again, and drive for a short time.
//!
//! `split.rs` cuts recordings in time, `rollout.rs` simulates the recorded demand, all of whose vehicles are drivers,
//! `tally.rs` measures recorded and simulated traffic in one way, and `contest.rs` sets models side by side.

mod advance;
mod contest;
mod density;
mod measures;
mod models;
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
use super::style::styles;
use advance::Advance;
use contest::{Contestant, Stages};
use models::Rate;
use rollout::{Drivers, Stage};
use split::{Piece, Split, between};
use tally::{Scope, Tally};

pub(crate) use density::{AXES, InClass};
pub(super) use page::{density_figure, figure, section};
pub use report::{Design, Judged, JudgedMeasure, JudgedModel, Predicted};

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
/// Between these θ of the fitted drivers is moved, in units of the choice noise (ours).
const MOVED: [f64; 2] = [-4.0, 4.0];
/// A lane on which vehicles drive less than this share of the distance has no row of its own.
const RARE: f64 = 0.02;

impl Observed {
    /// Fits a style to the first two thirds of the recorded time, and simulates the last third with it; `None` if the
    /// recordings are too short to be simulated. θ is moved until its drivers change lanes as often as recorded in the
    /// time before, as a number of each other model is: what a driver wants in a second does not say how often
    /// simulated drivers get it. `show` is told what share of the simulations is done, from 0 to 1.
    ///
    /// # Errors
    /// If a style cannot be fitted to the first two thirds, or the place cannot be simulated.
    pub fn judge(&self, rollouts: &Rollouts, show: &(dyn Fn(f64) + Sync)) -> Result<Option<Judged>, Fault> {
        let split = Split::of(&self.sources);
        if split.before.is_empty() || split.after.is_empty() {
            return Ok(None);
        }
        let observed = self.of(split.fitted)?;
        let asked = Asked { draws: rollouts.count.div_ceil(SAME_DRAW as u32), ..observed.asked() };
        observed.check_changes()?;
        let (study, _) = observed.corrected(Study::alone(&observed.observations, &asked), &asked)?;
        let report = FitReport::of(&observed, &study)?;
        let moved = |by: f64| {
            let study = study.clone().with_thresholds_moved(by);
            let (classes, styles) = styles(&observed, &study, &report)?;
            let shares = classes.iter().map(|it| it.share);
            Ok(Drivers { styles: styles.into_iter().map(|it| it.text).zip(shares).collect(), draw: None })
        };
        let fitted = moved(0.0)?;
        let default = Drivers { styles: vec![(self.request.prior_source()?.text, 1.0)], draw: None };
        let advance = Advance::of(Contestant::simulations(rollouts, 2), show);
        let before = self.stages(&split.before, &fitted)?;
        let rate = Rate { stages: &before.stages, per_km: before.recorded.rate().unwrap_or(0.0) };
        // Where nobody changed lanes the rate does not tell θ.
        let is_told = rate.per_km > 0.0;
        let theta_moved_by = if is_told { rate.reached(MOVED, moved, &advance)? } else { 0.0 };
        let drivers = [moved(theta_moved_by)?, default];
        let models = Contestant::all(drivers, &rate, (rollouts.threads, &advance))?;
        let (third, judged) = self.stages(&split.after, &fitted)?.judged(&models, rollouts, &advance)?;
        let (snapshots, _) = self.stages(&split.snapshots, &fitted)?.judged(&models, rollouts, &advance)?;
        Ok(Some(Judged {
            fitted_s: observed.sources.seconds(),
            events_used: observed.observations.used().count(),
            theta_moved_by,
            rollouts: rollouts.count as usize,
            models: judged,
            third,
            snapshots,
        }))
    }

    /// The same with other recordings.
    fn of(&self, sources: Sources) -> Result<Observed, Fault> {
        self.request.observed(sources, self.request.prior_style()?)
    }

    /// The stages of pieces, and what was recorded there.
    fn stages(&self, pieces: &[Piece], drivers: &Drivers) -> Result<Stages<'_>, Fault> {
        let stage = |it: &Piece| Ok((Stage::of(&self.sources, it, drivers)?, self.scope(it)));
        let stages = pieces.iter().map(stage).collect::<Result<_, Fault>>()?;
        let step = |it: &Piece| self.sources.parts[it.part].recording.step;
        let seconds = pieces.iter().map(|it| (it.measured[1] - it.measured[0]) as f64 * step(it)).sum();
        Ok(Stages { stages, recorded: self.recorded(pieces)?, seconds })
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
