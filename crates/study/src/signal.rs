//! The queue at a traffic light with constant arrivals and departures (D/D/1), the reference for a simulated queue.
//!
//! During red, r = C − g, the queue grows to q r; in green it shrinks with s − q and is gone after q r/(s − q). Mean
//! delay over all vehicles: r²/(2 C (1 − q/s)), the first term of Webster (1958, from memory).

use crate::units::SECONDS_PER_HOUR;

/// A light and its traffic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Signal {
    /// C: length of a cycle [s].
    pub cycle_s: f64,
    /// g: green of each cycle [s].
    pub green_s: f64,
    /// q: arrivals [veh/h].
    pub arrivals_veh_h: f64,
    /// s: departures from a queue at green [veh/h].
    pub saturation_veh_h: f64,
}

/// The queue in each cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalQueue {
    /// Mean delay over all vehicles [s].
    pub mean_delay_s: f64,
    /// Longest queue, at the end of red [veh].
    pub longest_veh: f64,
    /// Time after the beginning of green at which the queue is gone [s].
    pub cleared_s: f64,
}

impl Signal {
    /// The queue of each cycle; `None` if more vehicles arrive in a cycle than can leave in its green: then the queue
    /// grows without bound.
    pub fn queue(&self) -> Option<SignalQueue> {
        let [arrivals, saturation] =
            [self.arrivals_veh_h, self.saturation_veh_h].map(|it| it / SECONDS_PER_HOUR);
        let red = self.cycle_s - self.green_s;
        let cleared_s = arrivals * red / (saturation - arrivals);
        let is_served = arrivals < saturation && red >= 0.0 && cleared_s <= self.green_s;
        is_served.then(|| SignalQueue {
            mean_delay_s: red * red / (2.0 * self.cycle_s * (1.0 - arrivals / saturation)),
            longest_veh: arrivals * red,
            cleared_s,
        })
    }
}

impl Signal {
    /// x: arrivals as a share of the vehicles that can leave.
    pub fn saturation(&self) -> f64 {
        self.arrivals_veh_h * self.cycle_s / (self.saturation_veh_h * self.green_s)
    }

    /// Mean delay of vehicles that arrive at random, as a Poisson process [s] (Webster, 1958, from memory): with
    /// λ = g/C, C (1 − λ)²/(2 (1 − λ x)) + x²/(2 q (1 − x)) − 0.65 (C/q²)^⅓ x^(2 + 5 λ). `None` if as many or more
    /// arrive than can leave, or nobody.
    pub fn random_delay_s(&self) -> Option<f64> {
        let (x, share) = (self.saturation(), self.green_s / self.cycle_s);
        let arrivals = self.arrivals_veh_h / SECONDS_PER_HOUR;
        if !(x > 0.0 && x < 1.0) {
            return None;
        }
        let uniform = self.cycle_s * (1.0 - share).powi(2) / (2.0 * (1.0 - share * x));
        let random = x * x / (2.0 * arrivals * (1.0 - x));
        let correction =
            0.65 * libm::cbrt(self.cycle_s / (arrivals * arrivals)) * libm::pow(x, 2.0 + 5.0 * share);
        Some(uniform + random - correction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: Signal =
        Signal { cycle_s: 60.0, green_s: 30.0, arrivals_veh_h: 600.0, saturation_veh_h: 1800.0 };

    #[track_caller]
    fn assert_near(value: f64, expected: f64) {
        assert!((value - expected).abs() < 1e-9, "{value} is not {expected}");
    }

    #[test]
    fn v23_a_light_that_is_green_half_the_time_delays_a_third_of_saturation_by_11_and_a_quarter_seconds() {
        let queue = HALF.queue().unwrap();
        assert_near(queue.mean_delay_s, 11.25);
        assert_near(queue.longest_veh, 5.0);
        assert_near(queue.cleared_s, 15.0);
    }

    #[test]
    fn v23_the_delay_is_the_area_under_the_queue_over_who_comes() {
        const STEP: f64 = 1e-3;
        for arrivals_veh_h in [100.0, 600.0, 850.0] {
            let signal = Signal { arrivals_veh_h, ..HALF };
            let (mut queue, mut area, mut longest) = (0.0_f64, 0.0, 0.0_f64);
            for step in 0..60_000 {
                let leaves = if f64::from(step) * STEP < 30.0 { 0.0 } else { 0.5 };
                queue = (queue + (arrivals_veh_h / 3600.0 - leaves) * STEP).max(0.0);
                area += queue * STEP;
                longest = longest.max(queue);
            }
            let expected = signal.queue().unwrap();
            assert!((area / (arrivals_veh_h / 60.0) - expected.mean_delay_s).abs() < 0.01);
            assert!((longest - expected.longest_veh).abs() < 0.01);
        }
    }

    #[test]
    fn webster_s_delay_of_random_arrivals_at_two_thirds_of_saturation() {
        // 7.5/(1 − 1/3) + (4/9)/(2/6 · 1/3) − 0.65 · 2160^⅓ · (2/3)^4.5.
        assert_near(HALF.saturation(), 2.0 / 3.0);
        let delay = HALF.random_delay_s().unwrap();
        assert!((delay - (11.25 + 4.0 - 0.65 * 12.926_608 * 0.161_281)).abs() < 1e-4, "{delay}");
        assert_eq!(Signal { arrivals_veh_h: 900.0, ..HALF }.random_delay_s(), None);
        assert_eq!(Signal { arrivals_veh_h: 0.0, ..HALF }.random_delay_s(), None);
    }

    #[test]
    fn a_light_at_which_more_come_than_can_leave_has_no_lasting_queue() {
        assert_eq!(Signal { arrivals_veh_h: 901.0, ..HALF }.queue(), None);
        assert!(Signal { arrivals_veh_h: 899.0, ..HALF }.queue().is_some());
        assert_eq!(Signal { arrivals_veh_h: 1800.0, ..HALF }.queue(), None);
        assert_eq!(Signal { green_s: 61.0, ..HALF }.queue(), None);
        let always_green = Signal { green_s: 60.0, ..HALF }.queue().unwrap();
        assert_eq!((always_green.mean_delay_s, always_green.longest_veh), (0.0, 0.0));
    }
}
