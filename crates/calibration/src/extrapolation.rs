//! Simulation-extrapolation (Cook, Stefanski 1994): how an estimate would be without the errors of what was measured.
//!
//! More errors of the known kind are added, with variances that are multiples λ of theirs, and the estimate is
//! repeated. A parabola through the estimates over λ is read at λ = −1, where no error is left. What is assumed: errors
//! are independent of everything and have the known size, and the parabola holds beyond what was tried.

/// The multiples λ, in their order.
pub const MULTIPLES: [f64; 4] = [0.5, 1.0, 1.5, 2.0];

/// The value at λ = −1 of a parabola by least squares, as weights of the values at λ = 0 and at [`MULTIPLES`].
const AT_NO_ERROR: [f64; 5] = [3.0, -0.4, -1.8, -1.2, 1.4];

/// An estimate with its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// The estimate without errors. `plain` is that with the errors as they are; `repeated` has for each of [`MULTIPLES`]
/// the estimates with more errors: at least one, each with other draws.
///
/// The standard error has three parts: the extrapolated variance of the estimates; the variance that the errors as they
/// are add, by how repeated estimates differ (Stefanski, Cook 1995); and the chance of the draws themselves. With one
/// estimate for each multiple the last two are unknown, and are left out.
pub fn extrapolated(plain: Estimate, repeated: &[Vec<Estimate>; MULTIPLES.len()]) -> Estimate {
    let mean = |of: fn(&Estimate) -> f64, at: usize| {
        repeated[at].iter().map(of).sum::<f64>() / repeated[at].len() as f64
    };
    let at_no_error = |of: fn(&Estimate) -> f64| {
        let rest = (0..MULTIPLES.len()).map(|at| AT_NO_ERROR[1 + at] * mean(of, at));
        AT_NO_ERROR[0] * of(&plain) + rest.sum::<f64>()
    };
    let per_multiple = variance_per_multiple(repeated);
    let by_draws: f64 = (0..MULTIPLES.len())
        .map(|at| AT_NO_ERROR[1 + at].powi(2) * MULTIPLES[at] / repeated[at].len() as f64)
        .sum();
    let square = |it: &Estimate| it.standard_error * it.standard_error;
    // The parabola may fall below what is possible.
    let variance = at_no_error(square).max(square(&plain)) + per_multiple * (1.0 + by_draws);
    Estimate { value: at_no_error(|it| it.value), standard_error: variance.sqrt() }
}

/// How the variance of repeated estimates grows with λ, by all of them together; 0 if none was repeated.
fn variance_per_multiple(repeated: &[Vec<Estimate>; MULTIPLES.len()]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (estimates, multiple) in repeated.iter().zip(MULTIPLES) {
        let mean = estimates.iter().map(|it| it.value).sum::<f64>() / estimates.len() as f64;
        sum += estimates.iter().map(|it| (it.value - mean).powi(2)).sum::<f64>() / multiple;
        count += estimates.len() as f64 - 1.0;
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(value: f64) -> Estimate {
        Estimate { value, standard_error: 0.1 }
    }

    #[test]
    fn a_parabola_is_read_where_no_error_is_left() {
        let at = |multiple: f64| known(2.0 - 0.7 * multiple + 0.1 * multiple * multiple);
        let found = extrapolated(at(0.0), &MULTIPLES.map(|it| vec![at(it); 2]));
        assert!((found.value - 2.8).abs() < 1e-12);
        assert!((found.standard_error - 0.1).abs() < 1e-12);
    }

    /// A slope on a regressor that is measured with errors comes out too small by 1/(1 + s²) of the variance (Fuller
    /// 1987): with a quarter of the variance the parabola mends most of that.
    #[test]
    fn most_of_an_attenuation_is_mended() {
        let at = |multiple: f64| known(1.0 / (1.0 + 0.25 * (1.0 + multiple)));
        let found = extrapolated(at(0.0), &MULTIPLES.map(|it| vec![at(it)]));
        assert!((at(0.0).value - 0.8).abs() < 1e-12);
        assert!((found.value - 0.98).abs() < 0.02, "{found:?}");
    }

    #[test]
    fn draws_that_differ_make_the_estimate_less_certain() {
        let spread =
            |multiple: f64| vec![known(1.0 - multiple.sqrt() * 0.1), known(1.0 + multiple.sqrt() * 0.1)];
        let found = extrapolated(known(1.0), &MULTIPLES.map(spread));
        // Two draws with ± .1 √λ have the variance .02 λ; 9.4/2 comes from their number.
        assert!((found.standard_error - f64::sqrt(0.01 + 0.02 * (1.0 + 4.7))).abs() < 1e-12, "{found:?}");
        assert!((found.value - 1.0).abs() < 1e-12);
    }
}
