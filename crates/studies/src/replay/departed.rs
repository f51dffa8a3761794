//! What happened otherwise than recorded in a replay, vehicle by vehicle.

use laneweave_scenario::{HandOver, Start};
use serde::Serialize;

use super::trace::Trace;
use super::{Traces, Watched};

/// A hand-over of the first rollout.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HandedOver {
    /// The id in the recording.
    pub recorded: i64,
    /// The id in the tables.
    pub vehicle: u32,
    /// Who was in the way: its id in the tables.
    pub because_of: u32,
    /// When it left its record [s].
    pub from_s: f64,
    /// When it was back, or left the road [s]; none: not before the end.
    pub until_s: Option<f64>,
    /// Where it left its record: east and north [m].
    pub at_m: [f64; 2],
}

/// A driver in several rollouts, from the moment on in which it became one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Example {
    /// Its id in the recording.
    pub recorded: i64,
    /// Its recorded speeds, step by step [m/s].
    pub recorded_mps: Vec<f64>,
    /// Its speeds in each rollout, as long as it is compared [m/s].
    pub driven_mps: Vec<Vec<f64>>,
}

/// A driver of the first rollout who began later than its record, or behind it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LateStart {
    /// Its id in the recording.
    pub recorded: i64,
    /// How late it began [s].
    pub late_s: f64,
    /// How far behind its place it began [m].
    pub behind_m: f64,
    /// The vehicle in the tables that was in the way; none: it was in no lane that leads on.
    pub because_of: Option<u32>,
}

impl HandedOver {
    pub(super) fn of(it: &HandOver, dt: f64) -> HandedOver {
        let HandOver { recorded, vehicle, because_of, at, .. } = *it;
        let seconds = |step: u32| f64::from(step) * dt;
        let (from_s, until_s) = (seconds(it.from_step), it.until_step.map(seconds));
        HandedOver { recorded, vehicle, because_of, from_s, until_s, at_m: at }
    }
}

impl Example {
    pub(super) fn of(record: &Traces, rollouts: &[Watched]) -> Option<Example> {
        /// Rollouts that are shown.
        const SHOWN: usize = 4;
        let traces = |id: &i64| rollouts.iter().filter_map(|it| it.tracer.traces.get(id)).collect::<Vec<_>>();
        let compared = |id: &i64| traces(id).iter().map(|it| it.samples.len()).sum::<usize>();
        let (recorded, recorded_trace) = record
            .iter()
            .max_by_key(|(id, it)| (compared(id).min(it.samples.len() * rollouts.len()), -**id))?;
        let speeds = |trace: &Trace| trace.samples.iter().map(|it| it.speed).collect::<Vec<f64>>();
        let driven_mps = traces(recorded).into_iter().take(SHOWN).map(speeds).collect();
        Some(Example { recorded: *recorded, recorded_mps: speeds(recorded_trace), driven_mps })
    }
}

impl LateStart {
    pub(super) fn of(start: &Start, dt: f64) -> LateStart {
        let Start { recorded, late_steps, behind_m, because_of, .. } = *start;
        LateStart { recorded, late_s: f64::from(late_steps) * dt, behind_m, because_of }
    }
}
