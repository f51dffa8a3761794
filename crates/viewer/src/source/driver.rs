//! A driver in the words of `explain`, with the bars of its incentives.

use laneweave::models::{Concentration, change::LaneChangeModel};
use laneweave::network::Position;
use laneweave::sim::{Account, Act, SideAccount, Spot, Vehicle, World};
use laneweave::{Phase, explain};
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
    name: &'static str,
    #[serde(rename = "yield")]
    earning: f64,
    weight: f64,
    product: f64,
}

impl DriverFacts {
    /// What is said of a vehicle of `world`.
    pub(super) fn of(world: &World, vehicle: &Vehicle) -> DriverFacts {
        let (network, driver, motion) = (world.network(), vehicle.driver, vehicle.motion);
        let (lanelet, position_m) = network.lanelet_at(Position::new(vehicle.spot.chain, motion.x));
        let (pose, [length_m, _]) = (vehicle.pose(), vehicle.size());
        let number = world.scene().navigator.number(driver.goal.destination());
        let destination = number.and_then(|it| world.demand().destinations.get(it)).map(|it| it.id());
        let told = vehicle.is_in_lane().then(|| Told::of(world, vehicle.spot));
        let Told { sides, gap_test, act, story, concentration, leader } = told.unwrap_or_default();
        DriverFacts {
            id: motion.id.to_string(),
            class: driver.class.body().name,
            style: Some(vehicle.style().name.clone()),
            state: Some(driver.phase.name()),
            side: (driver.phase != Phase::Cruises).then(|| vehicle.lane_change.side.name()),
            concentration,
            speed_kmh: vehicle.speed() * 3.6,
            desired_kmh: Some(f64::from(driver.desired) * 3.6),
            acceleration_mps2: Some(f64::from(motion.acceleration)),
            x: pose.at.x,
            y: pose.at.y,
            length_m,
            lanelet: Some(lanelet.id.to_string()),
            position_m: Some(position_m),
            destination: destination.map(|it| it.to_string()),
            is_external: driver.is_external,
            leader,
            sides,
            gap_test,
            act,
            story,
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

/// What the driver at a spot makes of its lanes.
#[derive(Default)]
struct Told {
    sides: Vec<SideFacts>,
    gap_test: Option<String>,
    act: Option<String>,
    story: Option<String>,
    concentration: Option<&'static str>,
    leader: Option<LeaderFacts>,
}

impl Told {
    fn of(world: &World, spot: Spot) -> Told {
        let account = laneweave::sim::explain(world, spot);
        let act = explain::act(&account);
        let waits = matches!(account.act, Act::Waits(..) | Act::Goes(_) | Act::GivesUp(_));
        Told {
            sides: account.sides.iter().flatten().map(|it| side(&account, it)).collect(),
            gap_test: waits.then(|| act.clone()),
            act: Some(act),
            story: explain::now(world, account.vehicle),
            concentration: Some(match account.state {
                Concentration::Concentrated => "concentrated",
                Concentration::Inattentive => "inattentive",
            }),
            leader: leader(world, spot),
        }
    }
}

fn leader(world: &World, spot: Spot) -> Option<LeaderFacts> {
    let scene = world.scene();
    let from = scene.viewpoint(spot);
    let ahead = scene.ahead(from)?;
    let leader = scene.motion(scene.leader_spot(from)?);
    Some(LeaderFacts { id: leader.id.to_string(), gap_m: ahead.gap, speed_kmh: ahead.speed * 3.6 })
}

fn side(account: &Account, it: &SideAccount) -> SideFacts {
    let named = it.appraisal.rows.iter().zip(account.change.row_names());
    let rows = named.filter(|(row, name)| !name.is_empty() && row.weight != 0.0).map(|(row, name)| {
        RowFacts { name, earning: row.earning, weight: row.weight, product: row.weight * row.earning }
    });
    SideFacts {
        side: it.side.name(),
        gain: Some(it.appraisal.gain).filter(|it| it.is_finite()),
        threshold: it.appraisal.theta,
        probability: it.chance,
        is_out_of_question: it.is_out_of_question,
        rows: rows.collect(),
    }
}

/// The desire of the driver at a spot, as the byte of a frame: 128 + 127 tanh(G/θ) of the better side; 0 where no
/// change is allowed.
pub(super) fn desire(world: &World, spot: Spot) -> u8 {
    /// A threshold that is smaller counts as this: G would have no scale.
    const LEAST_THRESHOLD: f64 = 1e-6;
    let account = laneweave::sim::explain(world, spot);
    if matches!(&*account.change, LaneChangeModel::ConstantHazard(_)) {
        return 0;
    }
    let sides = account.sides.iter().flatten().map(|it| &it.appraisal);
    let relative = sides.map(|it| it.gain / it.theta.abs().max(LEAST_THRESHOLD)).reduce(f64::max);
    relative.map_or(0, |it| (128.0 + 127.0 * it.tanh()).round() as u8)
}
