//! Cars on a line, and how they move.

use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Pace};

/// Net length of every vehicle [m].
pub(crate) const LENGTH: f64 = 5.0;

/// A vehicle on a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Car {
    /// Front bumper [m].
    pub(crate) position: f64,
    /// Speed [m/s].
    pub(crate) speed: f64,
    /// Acceleration of the last step [m/s²].
    pub(crate) acceleration: f64,
}

impl Car {
    pub(crate) fn at(position: f64, speed: f64) -> Car {
        Car { position, speed, acceleration: 0.0 }
    }

    /// A car `gap` [m] ahead of a follower at 0.
    pub(crate) fn at_gap(gap: f64, speed: f64) -> Car {
        Car::at(gap + LENGTH, speed)
    }

    /// The car after `dt` [s] at a constant acceleration [m/s²]; it stops within the step if it must.
    pub(crate) fn moved(self, acceleration: f64, dt: f64) -> Car {
        let speed = self.speed + acceleration * dt;
        if speed >= 0.0 {
            Car { position: self.position + 0.5 * (self.speed + speed) * dt, speed, acceleration }
        } else {
            let braking = self.speed * self.speed / (-2.0 * acceleration);
            let acceleration = -self.speed / dt;
            Car { position: self.position + braking, speed: 0.0, acceleration }
        }
    }

    pub(crate) fn behind(self, leader: Car) -> Ahead {
        let gap = leader.position - LENGTH - self.position;
        Ahead { gap, speed: leader.speed, acceleration: leader.acceleration }
    }

    /// The acceleration that its driver wants behind `leader`, with the desired speed `desired` [m/s].
    pub(crate) fn wish(self, model: &FollowingModel, desired: f64, leader: Option<Car>) -> f64 {
        model.acceleration(Pace::new(self.speed, desired), leader.map(|it| self.behind(it)))
    }
}

/// The cars after a step of `dt` [s] by the Runge-Kutta method of fourth order; `wishes` are the accelerations of
/// such cars after so many seconds.
pub(crate) fn runge_kutta(cars: &[Car], dt: f64, wishes: impl Fn(&[Car], f64) -> Vec<f64>) -> Vec<Car> {
    let on = |slopes: &[(f64, f64)], dt: f64| -> Vec<Car> {
        let moved = |(car, (speed, acceleration)): (&Car, &(f64, f64))| Car {
            position: car.position + speed * dt,
            speed: car.speed + acceleration * dt,
            acceleration: *acceleration,
        };
        cars.iter().zip(slopes).map(moved).collect()
    };
    let slopes = |cars: &[Car], after: f64| -> Vec<(f64, f64)> {
        cars.iter().zip(wishes(cars, after)).map(|(car, wish)| (car.speed, wish)).collect()
    };
    let first = slopes(cars, 0.0);
    let second = slopes(&on(&first, 0.5 * dt), 0.5 * dt);
    let third = slopes(&on(&second, 0.5 * dt), 0.5 * dt);
    let fourth = slopes(&on(&third, dt), dt);
    let mean = |i: usize, of: fn(&(f64, f64)) -> f64| {
        (of(&first[i]) + 2.0 * of(&second[i]) + 2.0 * of(&third[i]) + of(&fourth[i])) / 6.0
    };
    let means: Vec<_> = (0..cars.len()).map(|i| (mean(i, |it| it.0), mean(i, |it| it.1))).collect();
    on(&means, dt)
}
