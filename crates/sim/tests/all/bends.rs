//! Drivers slow down for bends and lower limits before they reach them, gently, and drive on as fast as before.

use laneweave_models::{Manner, Style};
use laneweave_network::{ChainIndex, DrivingSide, Lanelet, LaneletIndex, Network, Point, Polyline};
use laneweave_sim::{Class, Placement, Setup, World};

use crate::roads::drivers;

/// Where the bend, or the lower limit, begins and ends [m].
const SLOW: [f64; 2] = [400.0, 460.0];
const LENGTH: f64 = 900.0;
const LIMIT: f64 = 70.0 / 3.6;

/// A lane with a bend of `radius` [m], and with `lower` [m/s] as the limit there.
fn road(radius: f64, lower: f64) -> Network {
    Network::new(lanelets(radius, lower), DrivingSide::Right).expect("the lanelets fit")
}

/// The same lane with a bend, but at the end of the bend a straight lane joins it: there a chain ends.
fn joined(radius: f64) -> Network {
    let mut lanelets = lanelets(radius, LIMIT);
    let (start, direction) = (lanelets[2].centre.points()[0], lanelets[2].centre.heading(0.0));
    let (sin, cos) = direction.sin_cos();
    let of = |aside: f64| {
        let at = |along: f64| {
            Point::new(start.x + along * cos - aside * sin, start.y + along * sin + aside * cos, 0.0)
        };
        Polyline::new([at(-100.0), at(0.0)]).expect("a line")
    };
    let mut joins = Lanelet::alone(4, [of(1.75), of(-1.75), of(0.0)], LIMIT);
    joins.following = vec![LaneletIndex(2)];
    lanelets.push(joins);
    Network::new(lanelets, DrivingSide::Right).expect("the lanelets fit")
}

fn lanelets(radius: f64, lower: f64) -> Vec<Lanelet> {
    let mut at = Point::new(0.0, 0.0, 0.0);
    let mut points = vec![at];
    for metre in 1..=LENGTH as u32 {
        let way = (f64::from(metre) - 0.5).clamp(SLOW[0], SLOW[1]) - SLOW[0];
        let (sin, cos) = (way / radius).sin_cos();
        at = Point::new(at.x + cos, at.y + sin, 0.0);
        points.push(at);
    }
    let pieces = [(0.0, SLOW[0], LIMIT), (SLOW[0], SLOW[1], lower), (SLOW[1], LENGTH, LIMIT)];
    let lanelets = pieces.iter().zip(1..).map(|((from, to, limit), id): (_, u32)| {
        let of = |aside: f64| {
            let centre =
                Polyline::new(points[*from as usize..=*to as usize].iter().copied()).expect("a line");
            let count = to - from;
            Polyline::new((0..=count as u32).map(|it| centre.beside(f64::from(it), aside))).expect("a line")
        };
        let mut lanelet = Lanelet::alone(i64::from(id), [of(1.75), of(-1.75), of(0.0)], *limit);
        lanelet.following = (id < 3).then_some(LaneletIndex(id)).into_iter().collect();
        lanelet
    });
    lanelets.collect()
}

/// What a driver alone on a road did.
#[derive(Default)]
struct Drive {
    /// Hardest braking [m/s²].
    braking: f64,
    /// Highest speed within the slow place [m/s], and at the end of the road.
    within: f64,
    at_the_end: f64,
    /// Highest speed on a second chain while half of the vehicle is still on the first one [m/s].
    leaving: f64,
}

fn drive(network: Network, style: Style, class: Class) -> Drive {
    let demand = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let mut world = World::new(network, vec![style], demand, Setup { step: 0.1, seed: 1, threads: 1 })
        .expect("it can be made");
    let length = class.body().length;
    let placement = Placement {
        chain: ChainIndex(0),
        x: length,
        speed: 18.0,
        class,
        parameters: 0,
        destination: Some(0),
    };
    world.place(placement).expect("it fits on the road");
    let mut drive = Drive::default();
    while world.on_road() > 0 {
        world.step();
        for vehicle in world.vehicles() {
            let x = vehicle.motion.x;
            drive.braking = drive.braking.max(-f64::from(vehicle.motion.acceleration));
            if (SLOW[0] + 3.0..SLOW[1] - 3.0).contains(&x) {
                drive.within = drive.within.max(vehicle.speed());
            }
            if vehicle.spot.chain != ChainIndex(0) && x < 0.5 * length {
                drive.leaving = drive.leaving.max(vehicle.speed());
            }
            drive.at_the_end = vehicle.speed();
        }
    }
    drive
}

/// The styles that brake comfortably, and bear this lateral acceleration [m/s²].
fn styles(lateral_acceleration: f64) -> [Style; 2] {
    let manner = Manner { comfortable_deceleration: 2.0, lateral_acceleration, ..Manner::default() };
    [drivers::conservative(), drivers::aggressive()].map(|it| Style { manner, ..it })
}

#[test]
fn drivers_come_to_a_bend_at_a_speed_that_fits_without_hard_braking() {
    for (largest, radius) in [(2.5, 40.0), (3.5, 20.0), (2.0, 100.0)] {
        for style in styles(largest) {
            let name = style.name.clone();
            let it = drive(road(radius, LIMIT), style, Class::Car);
            let lateral = it.within * it.within / radius;
            assert!((0.8 * largest..1.15 * largest).contains(&lateral), "{name} {radius}: {lateral} m/s²");
            assert!(it.braking <= 2.2, "{name} {radius}: brakes with {} m/s²", it.braking);
            assert!(it.at_the_end > 0.95 * LIMIT, "{name}: {}", it.at_the_end);
        }
    }
}

#[test]
fn a_vehicle_half_of_which_is_in_a_bend_drives_no_faster_where_another_lane_joins() {
    for style in styles(2.5) {
        for (class, largest) in [(Class::Car, 2.5), (Class::Bus, 0.7 * 2.5)] {
            let (radius, name) = (20.0, style.name.clone());
            let it = drive(joined(radius), style.clone(), class);
            let lateral = it.leaving * it.leaving / radius;
            assert!((0.5 * largest..1.15 * largest).contains(&lateral), "{name} {class:?}: {lateral} m/s²");
            assert!(it.at_the_end > 0.95 * LIMIT, "{name}: {}", it.at_the_end);
        }
    }
}

#[test]
fn long_vehicles_drive_more_slowly_through_a_bend() {
    let [style, _] = styles(2.5);
    let [car, bus] = [Class::Car, Class::Bus].map(|it| drive(road(30.0, LIMIT), style.clone(), it).within);
    assert!(bus < 0.9 * car, "{bus} {car}");
}

#[test]
fn drivers_come_to_a_lower_limit_at_that_limit_without_hard_braking() {
    for style in styles(0.0) {
        let (name, lower) = (style.name.clone(), 30.0 / 3.6);
        let fitting = lower * style.speed_factor;
        let it = drive(road(1e6, lower), style, Class::Car);
        assert!((0.95 * fitting..1.03 * fitting).contains(&it.within), "{name}: {} {fitting}", it.within);
        assert!(it.braking <= 2.2, "{name}: brakes with {} m/s²", it.braking);
    }
}

#[test]
fn who_bears_any_lateral_acceleration_and_brakes_by_its_model_alone_does_not_look_ahead() {
    for style in [drivers::conservative(), drivers::aggressive()] {
        let it = drive(road(40.0, LIMIT), style, Class::Car);
        assert!(it.within > 0.95 * LIMIT && it.braking < 0.5, "{} {}", it.within, it.braking);
    }
}
