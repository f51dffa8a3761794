//! α, the rate of the paper's probability of coming back, by maximum likelihood.
//!
//! Observed are changes of drivers who had to come back: y = 1 if they did in time, with x = T_h S. P = 1 − e^(−αx), a
//! generalised linear model with the complementary log-log link and the offset ln x. In ln α its likelihood has one
//! maximum.

/// A driver who had to come back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attempt {
    /// T_h S [s·m].
    pub x: f64,
    /// The share of drivers who came back: 1 or 0 for a single one.
    pub came_back: f64,
}

/// An estimate of α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReturnRate {
    /// α [1/(s·m)].
    pub alpha: f64,
    /// Standard error of ln α.
    pub log_error: f64,
}

/// Estimates α. `None` if all came back, or none did: then α is not identified.
pub fn return_rate(attempts: &[Attempt]) -> Option<ReturnRate> {
    /// Newton steps in ln α, and the longest.
    const STEPS: usize = 200;
    const LONGEST: f64 = 2.0;
    let useful: Vec<&Attempt> = attempts.iter().filter(|it| it.x > 0.0 && it.x.is_finite()).collect();
    let came: f64 = useful.iter().map(|it| it.came_back).sum();
    if came <= 0.0 || came >= useful.len() as f64 {
        return None;
    }
    let mean = useful.iter().map(|it| it.x).sum::<f64>() / useful.len() as f64;
    let mut log_alpha = -libm::log(mean);
    for _ in 0..STEPS {
        let (slope, curvature) = derivatives(&useful, log_alpha);
        let step = (slope / curvature).clamp(-LONGEST, LONGEST);
        log_alpha += step;
        if step.abs() < 1e-13 {
            break;
        }
    }
    let (_, curvature) = derivatives(&useful, log_alpha);
    Some(ReturnRate { alpha: libm::exp(log_alpha), log_error: 1.0 / curvature.sqrt() })
}

/// The derivative of the log-likelihood by ln α, and the expected information.
fn derivatives(attempts: &[&Attempt], log_alpha: f64) -> (f64, f64) {
    attempts.iter().fold((0.0, 0.0), |(slope, information), it| {
        let events = it.x * libm::exp(log_alpha);
        let (comes, stays) = (-libm::expm1(-events), libm::exp(-events));
        let comes = comes.max(f64::MIN_POSITIVE);
        // d ln P/d ln α = events · (1 − P)/P for those who came back, −events for the others.
        let slope = slope + events * (it.came_back * stays / comes - (1.0 - it.came_back));
        (slope, information + events * events * stays / comes)
    })
}

#[cfg(test)]
mod tests {
    use laneweave_sim::{Purpose, Random};

    use super::*;

    fn attempts(pairs: &[(f64, f64)]) -> Vec<Attempt> {
        pairs.iter().map(|(x, came_back)| Attempt { x: *x, came_back: *came_back }).collect()
    }

    #[test]
    fn v32_alpha_of_the_papers_probability_and_of_six_attempts() {
        let alpha = |pairs: &[(f64, f64)]| return_rate(&attempts(pairs)).unwrap().alpha;
        // At one x the estimate has a closed form: −ln(1 − y)/x.
        assert!((alpha(&[(20.0, 0.686514)]) - 0.058000).abs() < 1e-6);
        let mixed = [(10.0, 1.0), (10.0, 0.0), (20.0, 1.0), (20.0, 1.0), (40.0, 1.0), (5.0, 0.0)];
        assert!((alpha(&mixed) - 0.092646).abs() < 1e-6);
    }

    #[test]
    fn alpha_is_not_identified_where_all_come_back_or_nobody_does() {
        assert_eq!(return_rate(&attempts(&[(10.0, 1.0), (20.0, 1.0)])), None);
        assert_eq!(return_rate(&attempts(&[(10.0, 0.0)])), None);
        assert_eq!(return_rate(&[]), None);
        assert_eq!(return_rate(&attempts(&[(0.0, 1.0), (10.0, 0.0)])), None);
        assert_eq!(return_rate(&attempts(&[(f64::NAN, 1.0), (10.0, 0.0)])), None);
    }

    /// 2,000 drivers who had to come back, of whom it is known whether they did. Time headways are those of gaps and
    /// speeds with errors of .14 m and .2 m/s, remaining distances have errors of .1 m.
    #[test]
    fn alpha_comes_back_where_returns_are_seen_with_the_errors_of_a_drone() {
        const ALPHA: f64 = 0.058;
        let random = Random::new(4);
        let seen = |driver: u32| {
            let uniform = |part: u32| random.uniform(driver, Purpose::Observation, part);
            // The sum of twelve uniform numbers, less its mean, is almost normal.
            let normal = |first: u32| (0..12).map(|it| uniform(first + it)).sum::<f64>() - 6.0;
            let [gap, speed, left] =
                [5.0 + 60.0 * uniform(0), 2.0 + 28.0 * uniform(1), 2.0 + 38.0 * uniform(2)];
            let came_back = f64::from(u8::from(uniform(3) < -libm::expm1(-ALPHA * gap / speed * left)));
            let headway = (gap + 0.14 * normal(4)) / (speed + 0.2 * normal(16));
            Attempt { x: headway * (left + 0.1 * normal(28)), came_back }
        };
        let all: Vec<Attempt> = (0..2000).map(seen).collect();
        let found = return_rate(&all).unwrap();
        assert!((found.alpha / ALPHA - 1.0).abs() < 0.1, "{found:?}");
        assert!(found.log_error < 0.05, "{found:?}");
    }
}
