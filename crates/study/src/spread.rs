//! The spread of values: quantiles, what of it lies between groups, and how often values of one set are more than those
//! of another.

/// The value below which this `share` of all values lies, from 0 to 1, between the two nearest ones in proportion;
/// `None` without any.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = share.clamp(0.0, 1.0) * last as f64;
    let (below, rest) = (at.floor() as usize, at.fract());
    Some(sorted[below] + rest * (sorted[(below + 1).min(last)] - sorted[below]))
}

/// The interval in which the middle 95 % of the values lie; `None` without any.
pub fn middle_95(values: &[f64]) -> Option<[f64; 2]> {
    Some([quantile(values, 0.025)?, quantile(values, 0.975)?])
}

/// The share of the variance between groups in all variance, by a one-way analysis of variance with random effects
/// (Fisher 1925): the groups have equal sizes of at least two. `None` for fewer than two groups, or without a spread.
pub fn share_between(groups: &[Vec<f64>]) -> Option<f64> {
    let (count, size) = (groups.len(), groups.iter().map(Vec::len).min()?);
    if count < 2 || size < 2 {
        return None;
    }
    let mean = |it: &[f64]| it.iter().sum::<f64>() / it.len() as f64;
    let squares = |it: &[f64], mean: f64| it.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>();
    let means: Vec<f64> = groups.iter().map(|it| mean(it)).collect();
    let of_means = squares(&means, mean(&means)) / (count - 1) as f64;
    let of_groups = groups.iter().zip(&means).map(|(it, mean)| squares(it, *mean) / (it.len() - 1) as f64);
    let within = of_groups.sum::<f64>() / count as f64;
    let between = (of_means - within / size as f64).max(0.0);
    let total = between + within;
    (total > 0.0).then(|| between / total)
}

/// The chance that one of `values` is more than one of `others` (Mann and Whitney 1947); equal ones count half. `None`
/// without any.
pub fn chance_of_more(values: &[f64], others: &[f64]) -> Option<f64> {
    if values.is_empty() || others.is_empty() {
        return None;
    }
    let of = |a: f64, b: f64| f64::from(u8::from(a > b)) + 0.5 * f64::from(u8::from(a == b));
    let sum: f64 = values.iter().map(|a| others.iter().map(|b| of(*a, *b)).sum::<f64>()).sum();
    Some(sum / (values.len() * others.len()) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_the_nearest_values() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(quantile(&values, 0.0), Some(1.0));
        assert_eq!(quantile(&values, 0.5), Some(2.5));
        assert_eq!(quantile(&values, 1.0), Some(4.0));
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(middle_95(&[0.0, 100.0]), Some([2.5, 97.5]));
    }

    #[test]
    fn the_share_between_groups_is_that_of_an_analysis_of_variance() {
        // Means 2, 6, 10: variance 16; within 2. Between: 16 − 2/2 = 15.
        let groups = vec![vec![1.0, 3.0], vec![5.0, 7.0], vec![9.0, 11.0]];
        assert!((share_between(&groups).unwrap() - 15.0 / 17.0).abs() < 1e-12);
        // Groups that differ less than their values do.
        assert_eq!(share_between(&[vec![1.0, 3.0], vec![1.0, 3.0]]), Some(0.0));
        assert_eq!(share_between(&[vec![1.0, 3.0]]), None);
        assert_eq!(share_between(&[vec![1.0, 1.0], vec![1.0, 1.0]]), None);
    }

    #[test]
    fn equal_values_count_half() {
        assert_eq!(chance_of_more(&[1.0, 2.0], &[1.0, 0.0]), Some(0.875));
        assert_eq!(chance_of_more(&[], &[1.0]), None);
    }
}
