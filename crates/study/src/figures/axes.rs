//! Linear axes with round ticks.

/// A range of values with its round steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// What it shows, with its unit.
    pub(super) label: String,
    /// First value.
    pub(super) from: f64,
    /// Last value.
    pub(super) to: f64,
    /// Distance of its ticks.
    pub(super) step: f64,
}

impl Axis {
    /// From `low` to `high` with at most so many steps; the ticks lie within.
    pub(super) fn spanning(label: &str, low: f64, high: f64, steps: f64) -> Axis {
        let is_range = low.is_finite() && high.is_finite() && low < high;
        let (from, to) = if is_range { (low, high) } else { (0.0, 1.0) };
        Axis { label: label.into(), from, to, step: round_step((to - from) / steps) }
    }

    /// From zero to the first tick at or beyond `high`, with at most so many steps up to there.
    pub(super) fn from_zero(label: &str, high: f64, steps: f64) -> Axis {
        let tight = Axis::spanning(label, 0.0, high, steps);
        let steps = (tight.to / tight.step - 1e-9).ceil();
        Axis { to: steps * tight.step, ..tight }
    }

    /// Where `value` lies between the ends: 0 to 1.
    pub(super) fn share(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }

    /// The round values along the axis, each with its text.
    pub(super) fn ticks(&self) -> impl Iterator<Item = (f64, String)> + '_ {
        let first = (self.from / self.step - 1e-9).ceil() as i64;
        let last = (self.to / self.step + 1e-9).floor() as i64;
        let decimals = (-libm::log10(self.step) - 1e-9).ceil().max(0.0) as usize;
        (first..=last).map(move |tick| {
            let value = tick as f64 * self.step;
            (value, format!("{value:.decimals$}"))
        })
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
        axis.ticks().map(|(_, text)| text).collect()
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
    fn an_axis_without_data_goes_from_zero_to_one() {
        for (low, high) in [(f64::INFINITY, f64::NEG_INFINITY), (3.0, 3.0), (f64::NAN, 1.0)] {
            let axis = Axis::spanning("time [s]", low, high, 10.0);
            assert_eq!((axis.from, axis.to), (0.0, 1.0));
        }
    }
}
