//! Numbers in a form for people.

use laneweave_study::Interval;

/// A number with so many significant digits, without an exponent; a dash for values that are not finite.
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let magnitude = libm::floor(libm::log10(value.abs())) as i64;
    let decimals = (digits as i64 - 1 - magnitude).max(0) as usize;
    let text = format!("{value:.decimals$}");
    text.replacen('-', "−", 1)
}

/// A difference with so many decimals, and its sign.
pub fn signed(value: f64, decimals: usize) -> String {
    format!("{value:+.decimals$}").replacen('-', "−", 1)
}

/// A count, with its digits in groups of three.
pub fn counted(count: u64) -> String {
    /// A narrow no-break space.
    const BETWEEN: char = '\u{202f}';
    let digits = count.to_string();
    let mut text = String::new();
    for (place, digit) in digits.char_indices() {
        if place > 0 && digits.len() > 4 && (digits.len() - place).is_multiple_of(3) {
            text.push(BETWEEN);
        }
        text.push(digit);
    }
    text
}

/// A share in per cent.
pub fn percent(share: f64) -> String {
    number(100.0 * share, if share < 0.1 { 2 } else { 3 }) + " %"
}

/// A value with its interval, both with so many significant digits of the value.
pub fn with_interval(value: f64, Interval { lower, upper }: Interval, digits: usize) -> String {
    if !(lower.is_finite() && upper.is_finite()) {
        return number(value, digits);
    }
    let largest = value.abs().max(upper.abs());
    let magnitude = if largest > 0.0 { libm::floor(libm::log10(largest)) as i64 } else { 0 };
    let decimals = (digits as i64 - 1 - magnitude).max(0) as usize;
    format!("{value:.decimals$} ({lower:.decimals$} to {upper:.decimals$})").replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_significant_digits_and_no_exponent() {
        let texts = [0.0, 0.014_2, 3.0, 1234.5, -2.5e-7].map(|it| number(it, 3));
        assert_eq!(texts, ["0", "0.0142", "3.00", "1234", "−0.000000250"]);
        assert_eq!([number(f64::NAN, 3), percent(0.0213), percent(0.5)], ["–", "2.1 %", "50.0 %"]);
    }

    #[test]
    fn a_difference_has_a_sign() {
        assert_eq!([signed(2.0, 0), signed(-0.25, 2), signed(0.0, 1)], ["+2", "−0.25", "+0.0"]);
    }

    #[test]
    fn large_counts_are_grouped() {
        let texts = [0, 999, 1234, 12_345, 1_234_567].map(counted);
        assert_eq!(texts, ["0", "999", "1234", "12\u{202f}345", "1\u{202f}234\u{202f}567"]);
    }

    #[test]
    fn an_interval_has_the_digits_of_its_value() {
        let of = |value, lower, upper| with_interval(value, Interval { lower, upper }, 3);
        assert_eq!(of(0.1417, 0.1239, 0.1612), "0.142 (0.124 to 0.161)");
        assert_eq!(of(7.0, f64::NEG_INFINITY, f64::INFINITY), "7.00");
        assert_eq!(of(0.0, 0.0, 3.69), "0.00 (0.00 to 3.69)");
    }
}
