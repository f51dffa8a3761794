//! Sizes of files, in the form that people write.

use std::fmt;
use std::str::FromStr;

/// A size of a file [B].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Size(pub u64);

/// The units of sizes, the largest first [B].
const UNITS: [(&str, u64); 7] = [
    ("GiB", 1 << 30),
    ("GB", 1_000_000_000),
    ("MiB", 1 << 20),
    ("MB", 1_000_000),
    ("KiB", 1 << 10),
    ("kB", 1_000),
    ("B", 1),
];

const BYTES_PER_MB: f64 = 1e6;

impl Size {
    /// The largest size that can be chosen.
    pub const MAXIMUM: Size = Size(2 << 30);

    /// So many megabytes.
    pub fn of_mb(megabytes: f64) -> Size {
        Size((megabytes * BYTES_PER_MB).round() as u64)
    }

    /// In megabytes.
    pub fn mb(self) -> f64 {
        self.0 as f64 / BYTES_PER_MB
    }
}

/// The default limit for maps.
impl Default for Size {
    fn default() -> Size {
        Size(1 << 30)
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Size, String> {
        const REMEDY: &str = "write a size such as 500MB, at most 2GiB";
        let digits = text.trim_end_matches(|it: char| it.is_ascii_alphabetic());
        let (number, unit) = (digits.trim(), &text[digits.len()..]);
        let (_, factor) =
            UNITS.into_iter().find(|(name, _)| name.eq_ignore_ascii_case(unit)).ok_or(REMEDY)?;
        let bytes = number.parse::<f64>().map_err(|_| REMEDY)? * factor as f64;
        if (1.0..=Size::MAXIMUM.0 as f64).contains(&bytes) {
            Ok(Size(bytes as u64))
        } else {
            Err(REMEDY.into())
        }
    }
}

/// In the largest unit of which it is a multiple.
impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (unit, factor) =
            UNITS.into_iter().find(|(_, factor)| self.0.is_multiple_of(*factor)).unwrap_or(("B", 1));
        write!(f, "{} {unit}", self.0 / factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_read_with_its_unit_and_written_with_the_largest() {
        for (text, bytes, shown) in [
            ("500MB", 500_000_000, "500 MB"),
            ("2GiB", 2 << 30, "2 GiB"),
            ("1.5 gb", 1_500_000_000, "1500 MB"),
            ("64kib", 65_536, "64 KiB"),
            ("4097B", 4097, "4097 B"),
        ] {
            let size: Size = text.parse().unwrap();
            assert_eq!((size, size.to_string().as_str()), (Size(bytes), shown));
        }
        for text in ["", "MB", "12", "-1MB", "3GiB", "0.5B", "1 furlong", "NaNMB", "ünB"] {
            assert!(text.parse::<Size>().is_err(), "{text}");
        }
    }
}
