//! How good predicted probabilities are.

use crate::matrix::{Cholesky, Matrix, add, dot, norm};

/// A prediction: the probability of an event, and whether it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The predicted probability, 0 to 1.
    pub probability: f64,
    /// Whether the event came.
    pub came: bool,
}

/// The mean logarithm of the probability of what happened [nats]; without predictions 0.
pub fn log_score(predictions: &[Prediction]) -> f64 {
    let of = |it: &Prediction| {
        let p = if it.came { it.probability } else { 1.0 - it.probability };
        libm::log(p.max(f64::MIN_POSITIVE))
    };
    predictions.iter().map(of).sum::<f64>() / predictions.len().max(1) as f64
}

/// Log-likelihood of a constant probability, the share of events among `count` observations with `events` events.
pub fn log_likelihood_of_share(count: usize, events: usize) -> f64 {
    let share = events as f64 / count as f64;
    let term = |times: usize, p: f64| if times == 0 { 0.0 } else { times as f64 * libm::log(p) };
    term(events, share) + term(count - events, 1.0 - share)
}

/// The mean squared error of the probabilities (Brier 1950); without predictions 0.
pub fn brier(predictions: &[Prediction]) -> f64 {
    let square = |it: &Prediction| {
        let off = it.probability - f64::from(u8::from(it.came));
        off * off
    };
    predictions.iter().map(square).sum::<f64>() / predictions.len().max(1) as f64
}

/// The area under the receiver operating characteristic: the chance that an event had a higher probability than a
/// non-event; ties count half. `None` without events, or without non-events.
pub fn roc_area(predictions: &[Prediction]) -> Option<f64> {
    let events = predictions.iter().filter(|it| it.came).count() as f64;
    let others = predictions.len() as f64 - events;
    if events == 0.0 || others == 0.0 {
        return None;
    }
    let mut sorted = predictions.to_vec();
    sorted.sort_by(|a, b| a.probability.total_cmp(&b.probability));
    let (mut below, mut area) = (0.0, 0.0);
    for tied in sorted.chunk_by(|a, b| a.probability == b.probability) {
        let came = tied.iter().filter(|it| it.came).count() as f64;
        let not = tied.len() as f64 - came;
        area += came * (below + 0.5 * not);
        below += not;
    }
    Some(area / (events * others))
}

/// The area under the curve of precision over recall, as the mean precision at each event; by chance it is the share of
/// events. `None` without events.
pub fn precision_recall_area(predictions: &[Prediction]) -> Option<f64> {
    let events = predictions.iter().filter(|it| it.came).count() as f64;
    if events == 0.0 {
        return None;
    }
    let mut sorted = predictions.to_vec();
    sorted.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let (mut all, mut found, mut area) = (0.0, 0.0, 0.0);
    for tied in sorted.chunk_by(|a, b| a.probability == b.probability) {
        let came = tied.iter().filter(|it| it.came).count() as f64;
        (all, found) = (all + tied.len() as f64, found + came);
        area += came * found / all;
    }
    Some(area / events)
}

/// Intercept and slope of a logit of the events on the logits of their probabilities: 0 and 1 for probabilities that
/// are right (Cox 1958). `None` if it has no maximum.
pub fn calibration(predictions: &[Prediction]) -> Option<[f64; 2]> {
    const STEPS: usize = 50;
    let bounded = |it: f64| it.clamp(1e-12, 1.0 - 1e-12);
    let logit = |it: f64| libm::log(bounded(it) / (1.0 - bounded(it)));
    let mut at = [0.0, 1.0];
    for _ in 0..STEPS {
        let (mut gradient, mut information) = ([0.0; 2], Matrix::zeros(2));
        for it in predictions {
            let x = [1.0, logit(it.probability)];
            let p = 1.0 / (1.0 + libm::exp(-dot(&at, &x)));
            add(&mut gradient, f64::from(u8::from(it.came)) - p, &x);
            information.add_outer(p * (1.0 - p), &x, &x);
        }
        let step = Cholesky::of(&information)?.solve(&gradient);
        add(&mut at, 1.0, &step);
        if norm(&step) < 1e-10 {
            return Some(at);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn predictions(events: &[f64], others: &[f64]) -> Vec<Prediction> {
        let of = |came| move |probability: &f64| Prediction { probability: *probability, came };
        events.iter().map(of(true)).chain(others.iter().map(of(false))).collect()
    }

    #[test]
    fn the_areas_of_a_toy() {
        let toy = predictions(&[0.8, 0.6], &[0.7, 0.3]);
        assert_eq!(roc_area(&toy), Some(0.75));
        // Precision 1 at the first event, 2 of 3 at the second.
        assert_eq!(precision_recall_area(&toy), Some(0.5 * (1.0 + 2.0 / 3.0)));
        assert_eq!(roc_area(&predictions(&[0.5], &[0.5])), Some(0.5));
        assert_eq!(roc_area(&predictions(&[0.5], &[])), None);
    }

    #[test]
    fn a_thousand_observations_with_base_one_tenth() {
        assert!((log_likelihood_of_share(1000, 100) + 325.082973).abs() < 1e-6);
        let constant = predictions(&[0.1; 100], &[0.1; 900]);
        assert!((1000.0 * log_score(&constant) + 325.082973).abs() < 1e-6);
        assert!((brier(&constant) - 0.09).abs() < 1e-12);
        assert!((precision_recall_area(&constant).unwrap() - 0.1).abs() < 1e-12);
    }

    #[test]
    fn probabilities_that_are_right_have_the_slope_one() {
        let mut all = Vec::new();
        for percent in 1..100 {
            let probability = f64::from(percent) / 100.0;
            all.extend((0..1000).map(|it| Prediction { probability, came: it < percent * 10 }));
        }
        let [intercept, slope] = calibration(&all).unwrap();
        assert!(intercept.abs() < 0.05 && (slope - 1.0).abs() < 0.05, "{intercept} {slope}");
    }
}
