//! Let a recorded driver perceive a recorded frame, as simulated drivers perceive their traffic.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::maps::{ReadOptions, load};
use laneweave::sim::{Navigator, Seen, Snapshot, perceive};
use laneweave::style::Population;
use laneweave::{Class, Fault, Side};

/// A frame of a recording: vehicle, lanelet, metres along it, speed [m/s].
const FRAME: [(u32, i64, f64, f64); 4] =
    [(1, 21, 60.0, 30.0), (2, 21, 100.0, 22.0), (3, 22, 10.0, 31.0), (4, 22, 180.0, 33.0)];

/// Vehicle 1 comes up to vehicle 2. Beside it there is a gap between the vehicles 3 and 4.
pub fn main() -> Result<(), Fault> {
    let path = "maps/motorway_2_lanes.osm";
    let map = load(path.as_ref(), &ReadOptions::default());
    let network = map.map_err(|error| Fault::new(path, error, "correct the map"))?.network;
    let seen = FRAME.map(|(id, lanelet, position_m, speed)| {
        let start = network.start_of(network.lanelet_with(lanelet).expect("it is on the map"));
        Seen {
            id,
            chain: start.chain,
            x: start.x + position_m,
            speed,
            acceleration: 0.0,
            length: 4.5,
            class: Class::Car,
            parameters: 0,
            desired: 33.0,
            destination: None,
            change: None,
        }
    });
    let drivers = Population::usual(1)?.driver_parameters;
    let (navigator, snapshot) = (Navigator::new(&network), Snapshot::new(&network, seen));
    let scene = snapshot.scene(&network, &navigator, &drivers);
    let spot = snapshot.spot(1).expect("it is in the frame");
    let situation = perceive(&scene, spot, Side::Left).expect("there is a lane to the left");

    let ahead = situation.here.ahead.expect("it follows vehicle 2");
    let behind = situation.there.behind.expect("vehicle 3 comes from behind");
    println!("the leader is {:.1} m ahead; the follower beside is {:.1} m behind", ahead.gap, behind.gap);
    let [here, there] = [situation.here, situation.there].map(|it| it.anticipated_speed);
    println!("anticipated speeds: {here:.1} m/s here, {there:.1} m/s to the left");
    let appraisal = drivers[0].change.appraise(&situation);
    println!("a driver of the style {} gains {:.2} from the change", drivers[0].name, appraisal.gain);

    assert!((ahead.gap - 35.5).abs() < 1e-9 && (behind.gap - 45.5).abs() < 1e-9);
    assert!(there > here + 5.0 && appraisal.gain > appraisal.theta);
    Ok(())
}
