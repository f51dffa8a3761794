//! A ring of identical cars: its steps, and small waves on it.

use std::f64::consts::TAU;

use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Pace};

use crate::following::cars::{Car, LENGTH, runge_kutta};

/// Identical cars on a ring, the leader of each the next.
pub(crate) struct Ring {
    pub(crate) model: FollowingModel,
    pub(crate) desired: f64,
    pub(crate) circumference: f64,
    pub(crate) cars: Vec<Car>,
}

/// The integration of a ring over one step [s].
pub(crate) type Step = fn(&mut Ring, f64);

impl Ring {
    pub(crate) const CARS: usize = 100;

    pub(crate) fn new(model: FollowingModel, desired: f64, gap: f64, speed: f64) -> Ring {
        Ring::of(Ring::CARS, model, desired, gap, speed)
    }

    pub(crate) fn of(cars: usize, model: FollowingModel, desired: f64, gap: f64, speed: f64) -> Ring {
        let spacing = gap + LENGTH;
        let circumference = cars as f64 * spacing;
        let cars = (0..cars).map(|i| Car::at(i as f64 * spacing, speed)).collect();
        Ring { model, desired, circumference, cars }
    }

    fn wishes(&self, cars: &[Car]) -> Vec<f64> {
        let wish = |(i, car): (usize, &Car)| {
            let lap = if i + 1 == cars.len() { self.circumference } else { 0.0 };
            let leader = cars[(i + 1) % cars.len()];
            let leader = Car { position: leader.position + lap, ..leader };
            car.wish(&self.model, self.desired, Some(leader))
        };
        cars.iter().enumerate().map(wish).collect()
    }

    /// Accelerations are constant within the step, as in the simulator.
    pub(crate) fn advance(&mut self, dt: f64) {
        let wishes = self.wishes(&self.cars);
        for (car, wish) in self.cars.iter_mut().zip(wishes) {
            *car = car.moved(wish, dt);
        }
    }

    /// By the Runge-Kutta method.
    pub(crate) fn advance_precisely(&mut self, dt: f64) {
        self.cars = runge_kutta(&self.cars, dt, |cars, _| self.wishes(cars));
    }

    pub(crate) fn mean_speed(&self) -> f64 {
        self.cars.iter().map(|car| car.speed).sum::<f64>() / self.cars.len() as f64
    }

    /// Root mean square of the deviation of the speeds from their mean [m/s].
    pub(crate) fn unevenness(&self) -> f64 {
        let mean = self.mean_speed();
        let squares: f64 = self.cars.iter().map(|it| (it.speed - mean).powi(2)).sum();
        (squares / self.cars.len() as f64).sqrt()
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Complex {
    pub(crate) re: f64,
    pub(crate) im: f64,
}

impl Complex {
    fn new(re: f64, im: f64) -> Complex {
        Complex { re, im }
    }

    pub(crate) fn on_circle(angle: f64) -> Complex {
        Complex::new(angle.cos(), angle.sin())
    }

    pub(crate) fn plus(self, other: Complex) -> Complex {
        Complex::new(self.re + other.re, self.im + other.im)
    }

    pub(crate) fn times(self, other: Complex) -> Complex {
        Complex::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }

    pub(crate) fn scaled(self, by: f64) -> Complex {
        Complex::new(self.re * by, self.im * by)
    }

    pub(crate) fn size(self) -> f64 {
        self.re.hypot(self.im)
    }

    pub(crate) fn angle(self) -> f64 {
        self.im.atan2(self.re)
    }

    fn root(self) -> Complex {
        Complex::on_circle(0.5 * self.angle()).scaled(self.size().sqrt())
    }
}

/// A model in equilibrium: its slopes in the gap, the own speed and the leader's.
pub(crate) struct Equilibrium {
    pub(crate) model: FollowingModel,
    pub(crate) desired: f64,
    pub(crate) speed: f64,
    pub(crate) gap: f64,
    /// On its ring.
    cars: usize,
    slopes: [f64; 3],
}

impl Equilibrium {
    /// At `speed` [m/s].
    pub(crate) fn at_speed(model: FollowingModel, desired: f64, speed: f64) -> Equilibrium {
        Equilibrium::new(model, desired, speed, model.equilibrium_gap(Pace::new(speed, desired)))
    }

    /// At net gap `gap` [m].
    pub(crate) fn at_gap(model: FollowingModel, desired: f64, gap: f64) -> Equilibrium {
        let (mut low, mut high) = (0.0, desired);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            let wish = model.acceleration(Pace::new(middle, desired), Some(Ahead::steady(gap, middle)));
            if wish > 0.0 { low = middle } else { high = middle }
        }
        Equilibrium::new(model, desired, low, gap)
    }

    fn new(model: FollowingModel, desired: f64, speed: f64, gap: f64) -> Equilibrium {
        const SMALL: f64 = 1e-5;
        let wish = |[gap_off, speed_off, leader_off]: [f64; 3]| {
            let ahead = Ahead::steady(gap + gap_off, speed + leader_off);
            model.acceleration(Pace::new(speed + speed_off, desired), Some(ahead))
        };
        let slopes = std::array::from_fn(|which| {
            let off = |by: f64| std::array::from_fn(|i| if i == which { by } else { 0.0 });
            (wish(off(SMALL)) - wish(off(-SMALL))) / (2.0 * SMALL)
        });
        Equilibrium { model, desired, speed, gap, cars: Ring::CARS, slopes }
    }

    /// The same on a ring of so many cars.
    pub(crate) fn of(self, cars: usize) -> Equilibrium {
        Equilibrium { cars, ..self }
    }

    pub(crate) fn ring(&self) -> Ring {
        Ring::of(self.cars, self.model, self.desired, self.gap, self.speed)
    }

    /// k: the angle by which a wave with `mode` periods on the ring turns from car to car.
    pub(crate) fn number(&self, mode: usize) -> f64 {
        TAU * mode as f64 / self.cars as f64
    }

    /// λ [1/s] of the wave with `mode` periods on the ring: λ² = f_s (e^{ik} − 1) + (f_v + f_l e^{ik}) λ, the root
    /// that grows faster.
    pub(crate) fn rate(&self, mode: usize) -> Complex {
        let [of_gap, of_speed, of_leader] = self.slopes;
        let ahead = Complex::on_circle(self.number(mode));
        let half = ahead.scaled(of_leader).plus(Complex::new(of_speed, 0.0)).scaled(0.5);
        let root = half.times(half).plus(ahead.plus(Complex::new(-1.0, 0.0)).scaled(of_gap)).root();
        let (first, second) = (half.plus(root), half.plus(root.scaled(-1.0)));
        if first.re > second.re { first } else { second }
    }

    /// The wave that grows fastest, and its growth [1/s].
    pub(crate) fn fastest(&self) -> (usize, f64) {
        let growths = (1..=self.cars / 2).map(|mode| (mode, self.rate(mode).re));
        growths.max_by(|a, b| a.1.total_cmp(&b.1)).expect("there are waves")
    }

    /// λ [1/s] of the wave, measured on a ring that starts with this wave, 0.1 mm high, after the first third of
    /// `duration` [s].
    pub(crate) fn measured_rate(&self, mode: usize, step: Step, dt: f64, duration: f64) -> Complex {
        const HEIGHT: f64 = 1e-4;
        let number = self.number(mode);
        let (rate, mut ring) = (self.rate(mode), self.ring());
        for (i, car) in ring.cars.iter_mut().enumerate() {
            let wave = Complex::on_circle(number * i as f64).scaled(HEIGHT);
            car.position += wave.re;
            car.speed += wave.times(rate).re;
        }
        let spacing = ring.circumference / self.cars as f64;
        let (mut fit, mut last, mut turned) = (Line::default(), 0.0, 0.0);
        let mut turn = Line::default();
        let steps = (duration / dt).round() as usize;
        for taken in 1..=steps {
            step(&mut ring, dt);
            let time = taken as f64 * dt;
            let wave = |(i, car): (usize, &Car)| {
                let off = car.position - i as f64 * spacing - self.speed * time;
                Complex::on_circle(-number * i as f64).scaled(off)
            };
            let found = ring.cars.iter().enumerate().map(wave).fold(Complex::new(0.0, 0.0), Complex::plus);
            turned += (found.angle() - last + 1.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
            last = found.angle();
            if 3 * taken > steps {
                fit.add(time, found.size().ln());
                turn.add(time, turned);
            }
        }
        Complex::new(fit.slope(), turn.slope())
    }
}

/// A straight line through points, by least squares.
#[derive(Default)]
pub(crate) struct Line {
    points: Vec<(f64, f64)>,
}

impl Line {
    pub(crate) fn add(&mut self, x: f64, y: f64) {
        self.points.push((x, y));
    }

    pub(crate) fn slope(&self) -> f64 {
        let count = self.points.len() as f64;
        let mean = |of: fn(&(f64, f64)) -> f64| self.points.iter().map(of).sum::<f64>() / count;
        let (x_mean, y_mean) = (mean(|it| it.0), mean(|it| it.1));
        let (above, below) = self.points.iter().fold((0.0, 0.0), |(above, below), (x, y)| {
            (above + (x - x_mean) * (y - y_mean), below + (x - x_mean).powi(2))
        });
        above / below
    }
}
