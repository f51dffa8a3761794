//! What is fixed before a run.

use laneweave_maps::Problem;
use laneweave_sim::Place;

use super::basis::Basis;
use crate::capacity::Estimate;
use crate::remarks::Remark;
use crate::style::StyleTemplate;

/// What is fixed before a run, and the same with every seed.
pub struct Conditions {
    /// Steps before anything is measured.
    pub warmup_steps: u32,
    /// Steps that are measured.
    pub steps: u32,
    /// Steps between two samples of a trajectory, if there are any.
    pub record_steps: Option<u32>,
    /// Steps between two checkpoints, if there are any.
    pub checkpoint_steps: Option<u32>,
    /// Steps over which flows are measured, if they are.
    pub flows_steps: Option<u32>,
    /// Mean demand over all origins while it is measured [veh/h].
    pub demand_veh_h: f64,
    /// Where trips start, each with its demand [veh/h].
    pub origins: Vec<(Place, f64)>,
    /// The basis of the demand.
    pub basis: Basis,
    /// The estimated capacity of the map.
    pub capacity: Estimate,
    /// Names and weights of the styles.
    pub styles: Vec<(String, f64)>,
    /// The styles from which the drivers are drawn, with their weights.
    pub(super) mixture: Vec<(StyleTemplate, f64)>,
    /// Elements of the map that could not be used unchanged.
    pub problems: Vec<Problem>,
    /// Remarks on the traffic of the map.
    pub remarks: Vec<Remark>,
    /// Latitude and longitude of the map's (0, 0) [°], if it was projected.
    pub origin: Option<(f64, f64)>,
}
