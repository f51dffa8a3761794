//! A figure, and the numbers that it shows.

use std::fmt::{Display, Write as _};

/// A figure with its data.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The figure as SVG text.
    pub svg: String,
    /// The values that it shows, as comma-separated values after RFC 4180, with a line of names.
    pub csv: String,
}

/// The values of a figure under construction.
pub(super) struct Values {
    csv: String,
}

impl Values {
    /// No values yet, in columns with these names.
    pub(super) fn of<'a>(columns: impl IntoIterator<Item = &'a str>) -> Values {
        let mut values = Values { csv: String::new() };
        values.row(columns.into_iter().map(text));
        values
    }

    /// Adds a row of cells; texts that may hold a comma are made by [`text`], and numbers by [`value`].
    pub(super) fn row<T: Display>(&mut self, cells: impl IntoIterator<Item = T>) {
        for (number, cell) in cells.into_iter().enumerate() {
            // Writing to a string never fails.
            let _ = write!(self.csv, "{}{cell}", if number == 0 { "" } else { "," });
        }
        self.csv.push('\n');
    }

    /// The text.
    pub(super) fn finish(self) -> String {
        self.csv
    }
}

/// A text as a cell, in quotes where it needs them.
pub(super) fn text(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

/// A number as a cell, with six significant digits; empty where there is none.
pub(super) fn value(number: f64) -> String {
    /// Significant digits.
    const DIGITS: i32 = 6;
    if !number.is_finite() {
        return String::new();
    }
    let magnitude = if number == 0.0 { 0 } else { libm::floor(libm::log10(number.abs())) as i32 };
    let decimals = (DIGITS - 1 - magnitude).clamp(0, 12) as usize;
    let text = format!("{number:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_six_digits_and_no_needless_zeros() {
        let texts = [0.0, 12.5, 123_456.7, 0.001_234_567, -3.0, f64::NAN, 100.0].map(value);
        assert_eq!(texts, ["0", "12.5", "123457", "0.00123457", "-3", "", "100"]);
    }

    #[test]
    fn a_text_with_a_comma_is_one_cell() {
        let mut values = Values::of(["a, b", "c"]);
        values.row([text("say \"x\""), value(1.0)]);
        assert_eq!(values.finish(), "\"a, b\",c\n\"say \"\"x\"\"\",1\n");
    }
}
