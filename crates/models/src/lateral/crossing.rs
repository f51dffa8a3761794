//! A vehicle in a lane change.

/// A vehicle in a lane change: what its lateral motion depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Speed [m/s].
    pub speed: f64,
    /// Length of the vehicle [m].
    pub length: f64,
    /// Time of the change for a vehicle that is not slow [s].
    pub duration: f64,
}

impl Crossing {
    /// Distance over which a slow car changes lanes [m]: the sharpest bend of this path over 3.5 m has a radius of 7 m,
    /// which is near that of a full lock; ours.
    const LEAST_WAY: f64 = 12.0;
    /// The same for a long vehicle, in vehicle lengths; ours.
    const LENGTHS: f64 = 1.5;
    /// A slower vehicle does not move sideways [m/s]; ours.
    const STANDS: f64 = 0.1;
    /// However little road is left, the vehicle may be this fast, so that it gets on [m/s]; ours.
    const CREEPS: f64 = 0.15;

    /// Distance over which the vehicle changes lanes while it is slow [m].
    #[inline]
    pub fn least_way(self) -> f64 {
        (Crossing::LENGTHS * self.length).max(Crossing::LEAST_WAY)
    }

    /// Distance that the change takes at this speed [m].
    #[inline]
    pub fn way(self) -> f64 {
        (self.speed * self.duration).max(self.least_way())
    }

    /// Rate of the change, 1 for a vehicle that is not slow: for a slow vehicle the distance counts, not the time. A
    /// vehicle that stands does not move sideways.
    #[inline]
    pub fn pace(self) -> f64 {
        self.paced(1.0 / self.least_way())
    }

    /// Share of its time by which the change progresses in `dt` [s], where the road is so short that at least the share
    /// `per_metre` of the change has to be done on each metre; 0 if it is long.
    #[inline]
    pub fn progress_in(self, dt: f64, per_metre: f64) -> f64 {
        self.paced(per_metre.max(1.0 / self.least_way())) * dt / self.duration
    }

    /// The highest speed at which the share `per_metre` of the change can be done on each metre [m/s].
    #[inline]
    pub fn fastest(self, per_metre: f64) -> f64 {
        (1.0 / (self.duration * per_metre)).max(Crossing::CREEPS)
    }

    /// Usually a change takes no less than its time. A vehicle that creeps does it on the road that is left all the
    /// same: it cannot be slower.
    #[inline]
    fn paced(self, per_metre: f64) -> f64 {
        let most = (Crossing::CREEPS * self.duration * per_metre).max(1.0);
        if self.speed < Crossing::STANDS { 0.0 } else { (self.speed * self.duration * per_metre).min(most) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_creeps_is_across_on_the_road_that_is_left() {
        // Half of a change of 13 s on 0.8 m: at 0.15 m/s it would take 6.5 s, and the road is over after 5.3 s.
        let per_metre = 0.5 / 0.8;
        let creeping = Crossing { speed: 0.15, length: 4.5, duration: 13.0 };
        assert_eq!(creeping.fastest(per_metre), 0.15);
        assert!((creeping.progress_in(0.8 / 0.15, per_metre) - 0.5).abs() < 1e-12);
        // Who is faster takes the time of the change, and slows down for that reason.
        let faster = Crossing { speed: 2.0, duration: 4.0, ..creeping };
        assert_eq!(faster.progress_in(0.4, per_metre), 0.1);
        assert!(faster.fastest(per_metre) < 0.5);
        // With road enough nobody is faster than usual.
        assert!((creeping.pace() - 0.15 * 13.0 / 12.0).abs() < 1e-12);
    }
}
