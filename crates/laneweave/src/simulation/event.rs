//! What happened in a step, in the words of the road.

use laneweave_network::{Id, Network, Position, Side};
use laneweave_sim::{
    self as sim, BrakingCause, Class, DrivingEventKind, IncidentKind, LaneChangeKind, VehicleId, World,
};
use serde::{Deserialize, Serialize};

use super::evaluation::Reason;

/// Something that happened in a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// A vehicle entered the map.
    Entered(Occurrence),
    /// A vehicle left the map: its trip is completed.
    Completed {
        /// Which vehicle, when and where.
        #[serde(flatten)]
        occurrence: Occurrence,
        /// Its time on the map [s].
        duration_s: f64,
    },
    /// The user took a vehicle off the road.
    Removed(Occurrence),
    /// A lane change was completed or aborted.
    LaneChange(LaneChange),
    /// Two vehicles began to touch each other.
    Incident(Incident),
    /// A vehicle began to brake as kinematics, not its model, demand.
    EmergencyBraking(Occurrence),
    /// A vehicle began to brake with more than 4 m/s², whoever decided it.
    HardBraking {
        /// Which vehicle, when and where.
        #[serde(flatten)]
        occurrence: Occurrence,
        /// What it braked for.
        cause: BrakingCause,
    },
    /// A vehicle came to a halt.
    Halt(Occurrence),
    /// A vehicle drove on after a standstill.
    SetOff {
        /// Which vehicle, when and where.
        #[serde(flatten)]
        occurrence: Occurrence,
        /// Time for which it stood [s].
        stood_s: f64,
    },
    /// A driver missed a turn. It takes another route if there is one.
    MissedTurn(Occurrence),
    /// A driver left its route for a better one.
    RouteChange(Occurrence),
}

/// Which vehicle, when and where.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Occurrence {
    /// Its id.
    pub vehicle: VehicleId,
    /// Time [s].
    pub time_s: f64,
    /// The id of the lanelet on which its front bumper was.
    pub lanelet: Id,
    /// Position of its front bumper along the lanelet [m].
    pub position_m: f64,
}

/// A lane change that was completed or aborted. Its fields have the names of the columns of the table `lane_changes`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneChange {
    /// Which vehicle.
    pub vehicle: VehicleId,
    /// The class of the vehicle that changes lanes.
    pub class: Class,
    /// Time when the centre crossed the line, or the change was aborted [s].
    pub time_s: f64,
    /// Time when the lateral motion began [s].
    pub started_s: f64,
    /// Time from the beginning to the end of the lateral motion [s].
    pub duration_s: f64,
    /// The id of the old lanelet.
    pub from_lanelet: Id,
    /// The id of the new lanelet.
    pub to_lanelet: Id,
    /// The style of its driver.
    pub style: String,
    /// The side to which it changed.
    pub side: Side,
    /// The kind of the change.
    pub kind: LaneChangeKind,
    /// Speed when the centre crossed the line [m/s].
    pub speed_mps: f64,
    /// Anticipated speed gain when the desire came [m/s].
    pub speed_gain_mps: f64,
    /// Its reasons: the incentives, when the desire came.
    pub reasons: Vec<Reason>,
    /// G: the utility of the change when the desire came. `None` if it was not made for its utility.
    pub utility: Option<f64>,
    /// θ: the threshold of the utility.
    pub threshold: f64,
    /// Gap to the new leader when the change began [m]; none if nobody was in sight.
    pub gap_ahead_m: Option<f64>,
    /// Gap to the new follower when the change began [m]; none if nobody was in sight.
    pub gap_behind_m: Option<f64>,
    /// Time to collision with the new leader when the change began [s]; none if they did not approach each other.
    pub ttc_ahead_s: Option<f64>,
    /// Time to collision of the new follower when the change began [s]; none if they did not approach each other.
    pub ttc_behind_s: Option<f64>,
    /// Position of its front bumper in the new lane on the map, to the east [m].
    pub x_m: f64,
    /// The same, to the north [m].
    pub y_m: f64,
    /// Whether it was completed; otherwise it was aborted.
    pub is_completed: bool,
}

/// Two vehicles that began to touch each other; the one with the smaller id comes first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Incident {
    /// Whether it is a collision or an overlap.
    pub kind: IncidentKind,
    /// Time when it was detected [s].
    pub time_s: f64,
    /// The two vehicles, the smaller id first.
    pub vehicles: [VehicleId; 2],
    /// The ids of the lanelets on which their front bumpers are.
    pub lanelets: [Id; 2],
    /// Positions of their front bumpers along the lanelets [m].
    pub positions_m: [f64; 2],
    /// Their speeds [m/s].
    pub speeds_mps: [f64; 2],
    /// The point halfway between their centres, to the east [m].
    pub x_m: f64,
    /// The same point, to the north [m].
    pub y_m: f64,
    /// How deep they intersect [m].
    pub depth_m: f64,
}

impl Event {
    /// The event `it` of the last step of `world`.
    pub(super) fn of(world: &World, it: &sim::Event) -> Event {
        let (network, now) = (world.network(), world.clock().time());
        match it {
            sim::Event::Entered(vehicle) => Event::Entered(Occurrence::entered(world, *vehicle)),
            sim::Event::Left { vehicle, duration, chain, motion, .. } => {
                // The last step may end beyond the road.
                let x = motion.x.min(network.chain(*chain).length);
                let occurrence = Occurrence::at(network, *vehicle, now, Position::new(*chain, x));
                Event::Completed { occurrence, duration_s: *duration }
            }
            sim::Event::Removed { vehicle, at } => {
                Event::Removed(Occurrence::at(network, *vehicle, now, *at))
            }
            sim::Event::LaneChange(it) => Event::LaneChange(LaneChange::of(world, it)),
            sim::Event::Incident(it) => Event::Incident(Incident::of(network, it)),
            sim::Event::Driving(it) => {
                let occurrence = Occurrence::at(network, it.vehicle, it.time, it.at);
                match it.kind {
                    DrivingEventKind::EmergencyBraking => Event::EmergencyBraking(occurrence),
                    DrivingEventKind::HardBraking(cause) => Event::HardBraking { occurrence, cause },
                    DrivingEventKind::Halt => Event::Halt(occurrence),
                    DrivingEventKind::SetOff { stood } => {
                        Event::SetOff { occurrence, stood_s: f64::from(stood) }
                    }
                    DrivingEventKind::MissedTurn => Event::MissedTurn(occurrence),
                    DrivingEventKind::RouteChange => Event::RouteChange(occurrence),
                }
            }
        }
    }
}

impl Occurrence {
    fn at(network: &Network, vehicle: VehicleId, time_s: f64, at: Position) -> Occurrence {
        let (lanelet, position_m) = network.lanelet_at(at);
        Occurrence { vehicle, time_s, lanelet: lanelet.id, position_m }
    }

    /// A vehicle that has just entered; its trip record knows where and when.
    fn entered(world: &World, vehicle: VehicleId) -> Occurrence {
        let of_trip = world.trip(vehicle).map(|it| (it.entered, it.from));
        let (time_s, at) = of_trip.unwrap_or_else(|| {
            let at = world.vehicle(vehicle).map(|it| Position::new(it.spot.chain, it.x()));
            (world.clock().time(), at.unwrap_or(Position::new(laneweave_network::ChainIndex(0), 0.0)))
        });
        Occurrence::at(world.network(), vehicle, time_s, at)
    }
}

impl LaneChange {
    fn of(world: &World, it: &sim::LaneChange) -> LaneChange {
        let network = world.network();
        let style = &world.driver_parameters()[it.parameters as usize];
        let place = network.chain(it.to.chain).centre.at(it.to.x);
        let finite = |it: f64| Some(it).filter(|it| it.is_finite());
        let [from_lanelet, to_lanelet] = [it.from, it.to].map(|at| network.lanelet_at(at).0.id);
        LaneChange {
            vehicle: it.vehicle,
            class: it.class,
            time_s: it.time,
            started_s: it.started,
            duration_s: it.duration,
            from_lanelet,
            to_lanelet,
            side: it.side,
            kind: it.kind,
            speed_mps: it.speed,
            speed_gain_mps: it.speed_gain,
            style: style.name.clone(),
            reasons: Reason::of(&style.change, &it.appraisal),
            utility: finite(it.appraisal.gain),
            threshold: it.appraisal.theta,
            gap_ahead_m: finite(it.gap_ahead),
            gap_behind_m: finite(it.gap_behind),
            ttc_ahead_s: finite(it.ttc_ahead),
            ttc_behind_s: finite(it.ttc_behind),
            x_m: place.x,
            y_m: place.y,
            is_completed: it.is_completed,
        }
    }
}

impl Incident {
    fn of(network: &Network, it: &sim::Incident) -> Incident {
        let places = it.places.map(|at| network.lanelet_at(at));
        Incident {
            kind: it.kind,
            time_s: it.time,
            vehicles: it.vehicles,
            lanelets: places.map(|(lanelet, _)| lanelet.id),
            positions_m: places.map(|(_, along)| along),
            speeds_mps: it.speeds,
            x_m: it.at.x,
            y_m: it.at.y,
            depth_m: it.depth,
        }
    }
}
