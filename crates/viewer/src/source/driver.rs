//! A driver in the words of `explain`, with the bars of its incentives.

use laneweave::sim::Vehicle;
use laneweave::{Decision, Phase, SideEvaluation, Simulation, VehicleId};
use serde::Serialize;

/// What is said of a vehicle.
#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct DriverFacts {
    pub(super) id: String,
    pub(super) class: &'static str,
    pub(super) style: Option<String>,
    pub(super) state: Option<&'static str>,
    pub(super) side: Option<&'static str>,
    pub(super) concentration: Option<&'static str>,
    pub(super) speed_kmh: f64,
    pub(super) desired_kmh: Option<f64>,
    pub(super) acceleration_mps2: Option<f64>,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) length_m: f64,
    pub(super) lanelet: Option<String>,
    pub(super) position_m: Option<f64>,
    pub(super) destination: Option<String>,
    pub(super) is_external: bool,
    pub(super) leader: Option<LeaderFacts>,
    pub(super) sides: Vec<SideFacts>,
    pub(super) gap_test: Option<String>,
    pub(super) act: Option<String>,
    pub(super) story: Option<String>,
}

/// The vehicle ahead.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LeaderFacts {
    id: String,
    gap_m: f64,
    speed_kmh: f64,
}

/// What a driver makes of one side.
#[derive(Clone, Debug, Serialize)]
pub(super) struct SideFacts {
    side: &'static str,
    /// None where safety forbids the change.
    gain: Option<f64>,
    threshold: f64,
    probability: f64,
    is_out_of_question: bool,
    rows: Vec<RowFacts>,
}

/// An incentive.
#[derive(Clone, Debug, Serialize)]
struct RowFacts {
    name: String,
    #[serde(rename = "yield")]
    earning: f64,
    weight: f64,
    product: f64,
}

impl DriverFacts {
    /// What is said of a vehicle of `simulation`.
    pub(super) fn of(simulation: &Simulation, vehicle: &Vehicle) -> DriverFacts {
        let (id, driver) = (vehicle.id(), vehicle.driver);
        let Some(state) = simulation.vehicle(id) else { return DriverFacts::default() };
        let facts = DriverFacts {
            id: id.to_string(),
            class: driver.class.body().name,
            style: Some(state.style),
            state: Some(driver.phase.name()),
            side: (driver.phase != Phase::Cruises).then(|| vehicle.lane_change.side.name()),
            speed_kmh: state.speed_mps * 3.6,
            desired_kmh: Some(f64::from(driver.desired) * 3.6),
            acceleration_mps2: Some(state.acceleration_mps2),
            x: state.x_m,
            y: state.y_m,
            length_m: state.length_m,
            lanelet: Some(state.lanelet.to_string()),
            position_m: Some(state.position_m),
            destination: state.destination.map(|it| it.to_string()),
            is_external: state.is_external,
            ..DriverFacts::default()
        };
        facts.with_evaluation(simulation, id)
    }

    /// The same, with what the driver makes of its lanes, if it is in one.
    fn with_evaluation(self, simulation: &Simulation, id: VehicleId) -> DriverFacts {
        let Some(evaluation) = simulation.evaluate(id) else { return self };
        let act = simulation.decision_in_words(id);
        let is_about_a_gap = matches!(
            evaluation.decision,
            Decision::Waits { .. } | Decision::Goes { .. } | Decision::GivesUp { .. }
        );
        let leader = evaluation.leader.map(|it| LeaderFacts {
            id: it.vehicle.to_string(),
            gap_m: it.gap_m,
            speed_kmh: it.speed_mps * 3.6,
        });
        DriverFacts {
            concentration: Some(if evaluation.is_concentrated { "concentrated" } else { "inattentive" }),
            leader,
            sides: evaluation.sides.iter().map(SideFacts::of).collect(),
            gap_test: act.clone().filter(|_| is_about_a_gap),
            act,
            story: simulation.explain(id),
            ..self
        }
    }

    /// The same of a vehicle that moves as it was recorded: nobody knows its driver.
    pub(super) fn of_recorded(self) -> DriverFacts {
        let DriverFacts {
            id, class, speed_kmh, acceleration_mps2, x, y, length_m, lanelet, position_m, ..
        } = self;
        let known = DriverFacts::default();
        DriverFacts { id, class, speed_kmh, acceleration_mps2, x, y, length_m, lanelet, position_m, ..known }
    }
}

impl SideFacts {
    fn of(side: &SideEvaluation) -> SideFacts {
        let rows = side.reasons.iter().filter(|it| it.weight != 0.0).map(|it| RowFacts {
            name: it.incentive.to_string(),
            earning: it.earning,
            weight: it.weight,
            product: it.contribution(),
        });
        SideFacts {
            side: side.side.name(),
            gain: side.utility,
            threshold: side.threshold,
            probability: side.probability,
            is_out_of_question: !side.is_considered,
            rows: rows.collect(),
        }
    }
}

/// The desire of the driver of a vehicle, as the byte of a frame: 128 + 127 tanh(G/θ) of the better side; 0 where no
/// change is allowed, or the driver has no reasons.
pub(super) fn desire(simulation: &Simulation, id: VehicleId) -> u8 {
    /// A threshold that is smaller counts as this: G would have no scale.
    const LEAST_THRESHOLD: f64 = 1e-6;
    let Some(evaluation) = simulation.evaluate(id) else { return 0 };
    let relative = |side: &SideEvaluation| {
        side.utility.unwrap_or(f64::NEG_INFINITY) / side.threshold.abs().max(LEAST_THRESHOLD)
    };
    let sides = evaluation.sides.iter().filter(|it| !it.reasons.is_empty());
    sides.map(relative).reduce(f64::max).map_or(0, |it| (128.0 + 127.0 * it.tanh()).round() as u8)
}
