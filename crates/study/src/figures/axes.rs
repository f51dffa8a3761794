//! Axes with round ticks.

/// A range of values with its round steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// Its quantity, with the unit.
    pub(super) label: String,
    /// First value.
    pub(super) from: f64,
    /// Last value.
    pub(super) to: f64,
    /// The spacing of its ticks.
    pub(super) ticks: Ticks,
}

/// The spacing of the ticks of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ticks {
    /// At equal distances in value.
    Every(f64),
    /// At the powers of ten, at equal distances on the page.
    Decades,
}

impl Axis {
    /// From `low` to `high` with at most so many steps; the ticks lie within.
    pub(super) fn spanning(label: &str, low: f64, high: f64, steps: f64) -> Axis {
        let is_range = low.is_finite() && high.is_finite() && low < high;
        let (from, to) = if is_range { (low, high) } else { (0.0, 1.0) };
        Axis { label: label.into(), from, to, ticks: Ticks::Every(round_step((to - from) / steps)) }
    }

    /// From zero to the first tick at or beyond `high`, with at most so many steps up to there.
    pub(super) fn from_zero(label: &str, high: f64, steps: f64) -> Axis {
        let tight = Axis::spanning(label, 0.0, high, steps);
        let step = tight.step();
        Axis { to: (tight.to / step - 1e-9).ceil() * step, ..tight }
    }

    /// The same, and from the first tick at or below `low` on, which is at most zero.
    pub(super) fn around_zero(label: &str, [low, high]: [f64; 2], steps: f64) -> Axis {
        if low >= 0.0 {
            return Axis::from_zero(label, high, steps);
        }
        let tight = Axis::spanning(label, low, high.max(0.0), steps);
        let step = tight.step();
        let from = (tight.from / step + 1e-9).floor() * step;
        Axis { from, to: (tight.to / step - 1e-9).ceil() * step, ..tight }
    }

    /// From the power of ten at or below `low` to that at or above `high`.
    pub(super) fn decades(label: &str, low: f64, high: f64) -> Axis {
        let is_range = low > 0.0 && high.is_finite() && low <= high;
        let [low, high] = if is_range { [low, high].map(libm::log10) } else { [0.0, 1.0] };
        let first = (low + 1e-9).floor();
        let last = (high - 1e-9).ceil().max(first + 1.0);
        let [from, to] = [first, last].map(|it| libm::pow(10.0, it));
        Axis { label: label.into(), from, to, ticks: Ticks::Decades }
    }

    /// Distance between ticks, if it is constant; for decades the whole axis.
    pub(super) fn step(&self) -> f64 {
        match self.ticks {
            Ticks::Every(step) => step,
            Ticks::Decades => self.to - self.from,
        }
    }

    /// Position of `value` between the ends: 0 to 1.
    pub(super) fn share(&self, value: f64) -> f64 {
        match self.ticks {
            Ticks::Every(_) => (value - self.from) / (self.to - self.from),
            // A value below stands at the end.
            Ticks::Decades if value <= self.from => 0.0,
            Ticks::Decades => libm::log10(value / self.from) / libm::log10(self.to / self.from),
        }
    }

    /// The round values along the axis, each with its text.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let shown = |value: f64, unit: f64| {
            let decimals = (-libm::log10(unit) - 1e-9).ceil().max(0.0) as usize;
            (value, format!("{value:.decimals$}"))
        };
        let between = |unit: f64, from: f64, to: f64| {
            ((from / unit - 1e-9).ceil() as i64, (to / unit + 1e-9).floor() as i64)
        };
        match self.ticks {
            Ticks::Every(step) => {
                let (first, last) = between(step, self.from, self.to);
                (first..=last).map(|tick| shown(tick as f64 * step, step)).collect()
            }
            Ticks::Decades => {
                let (first, last) = between(1.0, libm::log10(self.from), libm::log10(self.to));
                let powers = (first..=last).map(|tick| libm::pow(10.0, tick as f64));
                powers.map(|it| shown(it, it)).collect()
            }
        }
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `step`.
fn round_step(step: f64) -> f64 {
    let magnitude = libm::pow(10.0, libm::floor(libm::log10(step)));
    let factor = [1.0, 2.0, 5.0].into_iter().find(|it| it * magnitude >= step * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * magnitude
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn steps_are_one_two_or_five_times_a_power_of_ten() {
        let steps = [0.11, 1.0, 1.3, 3.0, 5.1, 420.0].map(round_step);
        assert_eq!(steps, [0.2, 1.0, 2.0, 5.0, 10.0, 500.0]);
    }

    #[test]
    fn an_axis_from_zero_ends_at_a_tick() {
        let axis = Axis::from_zero("density [veh/km]", 43.0, 10.0);
        assert_eq!((axis.from, axis.to), (0.0, 45.0));
        assert_eq!(texts(&axis), ["0", "5", "10", "15", "20", "25", "30", "35", "40", "45"]);
    }

    #[test]
    fn a_spanning_axis_ends_with_the_data_and_has_its_ticks_within() {
        let axis = Axis::spanning("position [km]", 0.13, 1.37, 10.0);
        assert_eq!((axis.share(0.13), axis.share(1.37)), (0.0, 1.0));
        assert_eq!(texts(&axis), ["0.2", "0.4", "0.6", "0.8", "1.0", "1.2"]);
    }

    #[test]
    fn decades_are_equally_high() {
        let axis = Axis::decades("share [%]", 0.02, 43.0);
        assert_eq!(texts(&axis), ["0.01", "0.1", "1", "10", "100"]);
        assert!((axis.share(1.0) - 0.5).abs() < 1e-12);
        assert_eq!((axis.share(0.0), axis.share(0.001)), (0.0, 0.0));
        assert_eq!(texts(&Axis::decades("", 0.0, 0.0)), ["1", "10"]);
        assert_eq!(texts(&Axis::decades("", 10.0, 10.0)), ["10", "100"]);
    }

    #[test]
    fn an_axis_without_data_goes_from_zero_to_one() {
        for (low, high) in [(f64::INFINITY, f64::NEG_INFINITY), (3.0, 3.0), (f64::NAN, 1.0)] {
            let axis = Axis::spanning("time [s]", low, high, 10.0);
            assert_eq!((axis.from, axis.to), (0.0, 1.0));
        }
    }
}
