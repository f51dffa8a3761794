//! Weights without what errors of the recorded positions do to them.

use laneweave_calibration::{Asked, Estimate, MULTIPLES, Study, extrapolated};
use laneweave_recorded::Drone;
use laneweave_recordings::clean;
use laneweave_scenario::Fault;

use super::Observed;
use super::found::weights;
use super::report::Correction;
use super::sources::{Part, Sources};

/// Recordings with more errors are made so often for each multiple of the variance (ours).
const REPEATS: u64 = 4;

/// Added to the seed: keeps the added errors independent of those of `observe`.
const OWN_SEEDS: u64 = 0x6f75_7273_0000_0000;

impl Observed {
    /// The study with the weights as they would be without errors of positions, if their size is known: by
    /// simulation-extrapolation.
    ///
    /// # Errors
    /// If the style's numbers make no sense for a driver.
    pub(super) fn corrected(
        &self,
        study: Study,
        asked: &Asked,
    ) -> Result<(Study, Option<Correction>), Fault> {
        let Some(position_error_m) = self.request.position_error_m else { return Ok((study, None)) };
        let plain = self.with_errors(&study, asked, 0.0, 0)?;
        let mut repeated: [Vec<Vec<Estimate>>; MULTIPLES.len()] = Default::default();
        for (number, (all, multiple)) in repeated.iter_mut().zip(MULTIPLES).enumerate() {
            for repeat in 0..REPEATS {
                let seed = number as u64 * REPEATS + repeat;
                all.push(self.with_errors(&study, asked, position_error_m * multiple.sqrt(), seed)?);
            }
        }
        let of = |at: usize| {
            extrapolated(plain[at], &repeated.each_ref().map(|it| it.iter().map(|it| it[at]).collect()))
        };
        let corrected: Vec<Estimate> = (0..plain.len()).map(of).collect();
        let uncorrected = weights(self, &study);
        let correction = Correction { position_error_m, uncorrected };
        Ok((study.corrected(&plain, &corrected), Some(correction)))
    }

    /// Intercept and weights if all positions had `more` errors [m]. Speeds are those of a tracker, whatever `more` is.
    fn with_errors(
        &self,
        study: &Study,
        asked: &Asked,
        more: f64,
        seed: u64,
    ) -> Result<Vec<Estimate>, Fault> {
        let drone = drone(more, self.request.seed.wrapping_add(seed));
        let err = |it: &Part| {
            let drone = Drone { frames_per_second: 1.0 / it.recording.step, ..drone };
            Part { name: it.name.clone(), recording: clean(drone.observe(&it.recording)).0, site: it.site }
        };
        let parts = self.sources.parts.iter().map(err).collect();
        let maps = self.sources.sites.iter().map(|it| it.map.clone()).collect();
        let sources = Sources::of(maps, parts);
        let observations = sources.observations(&self.prior.typical, self.request.begin())?;
        Ok(study.repeated(&observations, asked))
    }
}

/// A drone that adds errors of `noise` [m].
fn drone(noise: f64, seed: u64) -> Drone {
    Drone { noise, seed: seed.wrapping_add(OWN_SEEDS), ..Drone::exact(1.0) }
}

#[cfg(test)]
mod tests {
    use laneweave_recordings::{Recording, RoadUser, State, Track};

    use super::*;

    /// Errors that are those of the recording again would add up to more than their variances do.
    #[test]
    fn errors_are_not_those_of_a_recording_that_was_made_with_the_same_seed() {
        let state = |frame: i64| State { frame, x: 10.0 * frame as f64, y: 0.0, speed: 10.0, heading: 0.0 };
        let track = Track {
            id: 1,
            class: RoadUser::Car,
            length: 4.5,
            width: 1.8,
            states: (0..400).map(state).collect(),
        };
        let exact = Recording { step: 1.0, tracks: vec![track], ..Recording::default() };
        let errors = |drone: Drone| -> Vec<f64> {
            drone.observe(&exact).tracks[0].states.iter().map(|it| it.y).collect()
        };
        let recorded = errors(Drone { noise: 0.1, seed: 1, ..Drone::exact(1.0) });
        let added = errors(drone(0.1, 1));
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let correlation =
            product(&recorded, &added) / (product(&recorded, &recorded) * product(&added, &added)).sqrt();
        assert!(correlation.abs() < 0.2, "{correlation}");
    }
}
