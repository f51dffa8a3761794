//! Proper scores of predictions: how far a forecast in the form of equally likely values was from what came. The less,
//! the better; a forecast that claims more than it knows is not rewarded (Gneiting and Raftery 2007).

/// The continuous ranked probability score of `values` for what was `observed`, in their unit: the mean distance to it,
/// less half of the mean distance between two of them. It is fair to few values (Ferro 2014). `None` with fewer than
/// two.
pub fn crps(values: &[f64], observed: f64) -> Option<f64> {
    let count = values.len() as f64;
    if values.len() < 2 {
        return None;
    }
    let off = values.iter().map(|it| (it - observed).abs()).sum::<f64>() / count;
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    // In order, the value with the number k is subtracted n - 1 - k times and added k times.
    let apart = (0..).zip(&sorted).map(|(at, it)| (2.0 * f64::from(at) + 1.0 - count) * it).sum::<f64>();
    Some(off - apart / (count * (count - 1.0)))
}

/// The negative logarithm of how likely an `observed` count is for a negative binomial distribution with the mean and
/// the variance of `counts`, or for Poisson's if their variance is not above the mean. `None` without counts.
pub fn count_score(counts: &[f64], observed: u32) -> Option<f64> {
    if counts.is_empty() {
        return None;
    }
    let count = counts.len() as f64;
    // Half an event among all counts: what never happened in them can still happen.
    let mean = (counts.iter().sum::<f64>() + 0.5) / (count + 0.5);
    let squares = counts.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>();
    let variance = squares / (count - 1.0).max(1.0);
    let k = f64::from(observed);
    let log = if variance > mean {
        let size = mean * mean / (variance - mean);
        let share = mean / (size + mean);
        libm::lgamma(k + size) - libm::lgamma(size) - libm::lgamma(k + 1.0)
            + size * libm::log1p(-share)
            + k * libm::log(share)
    } else {
        k * libm::log(mean) - mean - libm::lgamma(k + 1.0)
    };
    Some(-log)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ranked_score_is_the_distance_less_half_of_the_spread() {
        assert_eq!(crps(&[3.0, 3.0], 5.0), Some(2.0));
        // Distances 1, 1 and 3; between pairs 2, 4 and 2.
        assert_eq!(crps(&[0.0, 2.0, 4.0], 1.0), Some(5.0 / 3.0 - 0.5 * 8.0 / 3.0));
        assert_eq!(crps(&[1.0], 1.0), None);
    }

    #[test]
    fn a_wide_forecast_is_worse_than_a_narrow_one_that_is_right_and_better_than_one_that_is_wrong() {
        let around = |centre: f64, width: f64| {
            (0..101).map(|it| centre + width * (f64::from(it) / 50.0 - 1.0)).collect::<Vec<f64>>()
        };
        let [right, wide, wrong] =
            [(10.0, 1.0), (10.0, 8.0), (20.0, 1.0)].map(|(at, by)| crps(&around(at, by), 10.0));
        assert!(right < wide && wide < wrong, "{right:?} {wide:?} {wrong:?}");
    }

    #[test]
    fn counts_are_scored_by_the_negative_binomial_of_their_mean_and_variance() {
        // Five times 2, and half an event more: no spread above that of Poisson.
        let poisson = count_score(&[2.0; 5], 3).expect("there are counts");
        let mean: f64 = 10.5 / 5.5;
        assert!((poisson - (mean - 3.0 * mean.ln() + 6.0_f64.ln())).abs() < 1e-12);
        let spread = [0.0, 10.0, 20.0];
        let likely: f64 = (0..500).filter_map(|it| count_score(&spread, it)).map(|it| (-it).exp()).sum();
        assert!((likely - 1.0).abs() < 1e-6, "{likely}");
        assert!(count_score(&spread, 40) < count_score(&[10.0; 3], 40));
        assert!(count_score(&[0.0; 10], 1).is_some_and(f64::is_finite));
    }
}
