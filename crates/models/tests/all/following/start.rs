//! A column starts, one vehicle after the other.

use laneweave_models::Reading;
use laneweave_models::follow::{FollowingModel, Fvdm};

use crate::following::cars::{Car, runge_kutta};
use crate::following::sets::{literal_fvdm, literal_gfm, literal_ovm};
use crate::near::assert_near;

/// Headway at which the literal optimal velocity is about 0 [m].
const STANDING: f64 = 7.4;
/// V₁ + V₂, the final speed of all cars [m/s].
const FREE: f64 = 14.66;

/// Times [s] at which the cars of a column of `cars` reach half of their final speed.
fn starts(model: FollowingModel, cars: usize, dt: f64) -> Vec<f64> {
    let mut column: Vec<_> = (0..cars).map(|i| Car::at(-STANDING * i as f64, 0.0)).collect();
    let mut started = vec![None; cars];
    let mut time = 0.0;
    while started.contains(&None) {
        let after = runge_kutta(&column, dt, |cars, _| {
            let leaders = std::iter::once(None).chain(cars.iter().copied().map(Some));
            cars.iter().zip(leaders).map(|(car, leader)| car.wish(&model, FREE, leader)).collect()
        });
        for (started, (before, after)) in started.iter_mut().zip(column.iter().zip(&after)) {
            if started.is_none() && after.speed >= 0.5 * FREE {
                let part = (0.5 * FREE - before.speed) / (after.speed - before.speed);
                *started = Some(time + part * dt);
            }
        }
        (time, column) = (time + dt, after);
    }
    started.into_iter().flatten().collect()
}

#[test]
fn v14_each_car_of_a_column_starts_so_much_after_the_one_before() {
    let slower = Fvdm { reading: Reading::Literal, relative_sensitivity: 0.2, ..Fvdm::default() };
    for (model, delay) in [
        (literal_ovm(), 1.6228),
        (literal_gfm(), 2.111),
        (literal_fvdm(), 1.4228),
        (FollowingModel::Fvdm(slower), 1.730),
    ] {
        const CARS: usize = 61;
        let started = starts(model, CARS, 0.05);
        assert_near((started[60] - started[40]) / 20.0, delay, 0.02);
    }
}

#[test]
fn v14_the_tenth_and_the_eleventh_car() {
    for (model, delay) in [(literal_ovm(), 1.624), (literal_gfm(), 2.113), (literal_fvdm(), 1.432)] {
        let started = starts(model, 12, 0.01);
        assert_near(started[11] - started[10], delay, 0.02);
    }
}
