//! Maximum likelihood estimate of α in P = 1 − e^(−αx), from observations whether drivers came back to a lane.
//!
//! x = T_h S, headway times remaining distance. A generalized linear model with complementary log-log link and the
//! offset ln x, which has one parameter: its likelihood has one maximum, where the score Σ [y x e^(−αx)/(1 − e^(−αx))
//! − (1 − y) x] vanishes.

use libm::expm1;

/// A driver who had to come back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attempt {
    /// x = T_h S [s·m], above 0.
    pub exposure: f64,
    /// y: 1 if the driver came back, 0 if not; of several with the same exposure the share that did.
    pub came_back: f64,
}

/// α [1/(s·m)] of maximum likelihood for the `attempts`. `None` without attempts, or if all or none came back: then
/// every larger, or smaller, α would be better.
pub fn returning_rate(attempts: &[Attempt]) -> Option<f64> {
    const HALVINGS: u32 = 200;
    let score = |alpha: f64| -> f64 {
        let of = |it: &Attempt| {
            let Attempt { exposure: x, came_back: y } = *it;
            // e^(−αx)/(1 − e^(−αx)) = 1/(e^(αx) − 1)
            y * x / expm1(alpha * x) - (1.0 - y) * x
        };
        attempts.iter().map(of).sum()
    };
    let is_known = |it: &Attempt| it.exposure > 0.0 && (0.0..=1.0).contains(&it.came_back);
    let (some, not_all) =
        (attempts.iter().any(|it| it.came_back > 0.0), attempts.iter().any(|it| it.came_back < 1.0));
    if !(some && not_all && attempts.iter().all(is_known)) {
        return None;
    }
    // The score falls from +∞ at 0 to a negative number.
    let (mut low, mut high) = (0.0, 1.0);
    while score(high) > 0.0 {
        high *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if score(middle) > 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(attempts: &[(f64, f64)]) -> Option<f64> {
        let all = attempts
            .iter()
            .map(|(exposure, came_back)| Attempt { exposure: *exposure, came_back: *came_back });
        returning_rate(&all.collect::<Vec<_>>())
    }

    #[test]
    fn v32_the_papers_alpha_comes_back_from_its_own_probability() {
        let alpha = rate(&[(20.0, 0.686514); 50]).unwrap();
        assert!((alpha - 0.058).abs() < 1e-6, "{alpha}");
    }

    #[test]
    fn v32_six_attempts_of_different_exposure() {
        let alpha =
            rate(&[(10.0, 1.0), (10.0, 0.0), (20.0, 1.0), (20.0, 1.0), (40.0, 1.0), (5.0, 0.0)]).unwrap();
        assert!((alpha - 0.092646).abs() < 1e-6, "{alpha}");
    }

    #[test]
    fn nothing_is_estimated_where_all_did_the_same_or_nothing_is_known() {
        assert_eq!(rate(&[]), None);
        assert_eq!(rate(&[(10.0, 1.0), (20.0, 1.0)]), None);
        assert_eq!(rate(&[(10.0, 0.0)]), None);
        assert_eq!(rate(&[(0.0, 1.0), (10.0, 0.0)]), None);
        assert_eq!(rate(&[(f64::NAN, 1.0), (10.0, 0.0)]), None);
    }
}
