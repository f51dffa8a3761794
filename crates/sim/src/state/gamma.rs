//! The gamma distribution function and its inverse, for shapes that need not be whole numbers.
//!
//! Series and continued fraction of the incomplete gamma function: Abramowitz and Stegun (1964), 6.5.29 and 6.5.31, the
//! latter in Lentz's form.

/// Sums end when a term is smaller than this share.
const PRECISION: f64 = 1e-15;
/// Upper limit of the number of terms, for shapes up to some thousands.
const MOST_TERMS: usize = 2_000;
/// Upper limit of the steps of the inverse. Where Newton's method fails, a step halves the interval.
const MOST_STEPS: usize = 200;

/// Q(k, x) = Γ(k, x)/Γ(k): probability that a gamma variable of shape `k` > 0 and scale 1 exceeds `x`.
pub(crate) fn survival(k: f64, x: f64) -> f64 {
    if x <= 0.0 {
        1.0
    } else if x < k + 1.0 {
        1.0 - lower_series(k, x)
    } else {
        upper_fraction(k, x)
    }
}

/// The number that a gamma variable of shape `k` and scale 1 exceeds with probability `u`, 0 < u < 1.
pub(crate) fn exceeded(k: f64, u: f64) -> f64 {
    let (mut low, mut high) = (0.0, k + 1.0);
    while survival(k, high) > u {
        (low, high) = (high, 2.0 * high);
    }
    let mut x = 0.5 * (low + high);
    for _ in 0..MOST_STEPS {
        let above = survival(k, x) - u;
        if above > 0.0 {
            low = x
        } else {
            high = x
        }
        let newton = x + above / density(k, x);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= PRECISION * x {
            return next;
        }
        x = next;
    }
    x
}

/// The density of the gamma distribution: xᵏ⁻¹ e⁻ˣ/Γ(k).
fn density(k: f64, x: f64) -> f64 {
    libm::exp((k - 1.0) * libm::log(x) - x - libm::lgamma(k))
}

/// 1 − Q by its series, which converges fast below the mean.
fn lower_series(k: f64, x: f64) -> f64 {
    let mut term = 1.0 / k;
    let mut sum = term;
    for n in 1..MOST_TERMS {
        term *= x / (k + n as f64);
        sum += term;
        if term < PRECISION * sum {
            break;
        }
    }
    sum * x * density(k, x)
}

/// Q by its continued fraction, which converges fast above the mean.
fn upper_fraction(k: f64, x: f64) -> f64 {
    /// Replaces a zero in the fraction.
    const TINY: f64 = 1e-300;
    let mut b = x + 1.0 - k;
    let mut c = 1.0 / TINY;
    let mut d = 1.0 / b;
    let mut fraction = d;
    for n in 1..MOST_TERMS {
        let n = n as f64;
        let a = n * (k - n);
        b += 2.0;
        let away = |value: f64| if value.abs() < TINY { TINY } else { value };
        d = 1.0 / away(a * d + b);
        c = away(b + a / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < PRECISION {
            break;
        }
    }
    fraction * x * density(k, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_shapes_have_closed_forms() {
        for x in [0.01, 0.5, 1.0, 3.0, 10.0, 40.0] {
            let by_hand = [1.0, 1.0 + x, 1.0 + x + 0.5 * x * x].map(|sum| sum * libm::exp(-x));
            for (k, expected) in (1..).zip(by_hand) {
                let found = survival(f64::from(k), x);
                assert!((found / expected - 1.0).abs() < 1e-12, "Q({k}, {x}) = {found}, not {expected}");
            }
        }
    }

    #[test]
    fn half_shapes_are_error_functions() {
        for x in [0.1, 1.0, 1.6, 4.0, 25.0] {
            let expected = libm::erfc(libm::sqrt(x));
            assert!((survival(0.5, x) / expected - 1.0).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn the_inverse_is_one() {
        for k in [0.1, 0.5, 1.0, 3.0625, 20.0, 400.0] {
            for u in [1e-9, 0.001, 0.25, 0.5, 0.9, 0.999] {
                let back = survival(k, exceeded(k, u));
                assert!((back - u).abs() < 1e-11, "shape {k}: {back}, not {u}");
            }
        }
    }
}
