//! How a table is written: what separates its fields, and what commas in its numbers mean.

use super::rows::{Fields, Rows};

/// So much of the beginning shows how a table is written [B].
const SAMPLE: usize = 1 << 16;

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dialect {
    pub(super) separator: Separator,
    pub(super) commas: Commas,
}

/// What separates fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Tab,
    Semicolon,
    Comma,
    /// Any number of them.
    Blanks,
}

/// What commas in numbers mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Commas {
    /// 1,118,846.98: they group digits.
    Group,
    /// 1.118.846,98: the decimal sign; points group digits.
    Decimal,
}

impl Dialect {
    /// How a table with this beginning is written.
    pub(crate) fn of(start: &[u8]) -> Dialect {
        let separator = Separator::of(start);
        // What no number tells: between commas as separators those in fields group digits.
        let usual = if separator == Separator::Comma { Commas::Group } else { Commas::Decimal };
        let dialect = Dialect { separator, commas: usual };
        Dialect { commas: dialect.commas_in(&start[..start.len().min(SAMPLE)]).unwrap_or(usual), separator }
    }

    /// What the first number with commas in the `sample` tells of them.
    fn commas_in(self, sample: &[u8]) -> Option<Commas> {
        if self.separator == Separator::Comma && !sample.contains(&b'"') {
            return None;
        }
        let mut rows = Rows::of(sample, self);
        while let Ok(Some(row)) = rows.next() {
            if let Some(commas) = row.iter().find_map(Commas::of) {
                return Some(commas);
            }
        }
        None
    }

    /// The first row of a table that begins with `start`, as `read` sees it.
    pub(crate) fn first_row<T>(start: &[u8], read: impl FnOnce(&Fields) -> T) -> Option<T> {
        let mut rows = Rows::of(start, Dialect::of(start));
        rows.next().ok().flatten().map(|it| read(&it))
    }
}

impl Separator {
    /// The one in the first line that is not empty.
    fn of(start: &[u8]) -> Separator {
        let start = start.trim_ascii_start();
        let line = start.split(|it| matches!(it, b'\r' | b'\n')).next().unwrap_or_default();
        let mut is_quoted = false;
        let mut found = Separator::Blanks;
        for byte in line {
            is_quoted ^= *byte == b'"';
            let separator = match byte {
                _ if is_quoted => continue,
                b'\t' => return Separator::Tab,
                b';' => Separator::Semicolon,
                b',' if found == Separator::Blanks => Separator::Comma,
                _ => continue,
            };
            found = separator;
        }
        let is_one_column = !line.trim_ascii().contains(&b' ');
        if found == Separator::Blanks && is_one_column { Separator::Comma } else { found }
    }

    pub(super) fn byte(self) -> u8 {
        match self {
            Separator::Tab => b'\t',
            Separator::Semicolon => b';',
            Separator::Comma => b',',
            Separator::Blanks => b' ',
        }
    }
}

impl Commas {
    /// What a number tells of them; `None` if it tells nothing, as 5,235 does.
    fn of(number: &[u8]) -> Option<Commas> {
        let digits = number.strip_prefix(b"-").unwrap_or(number);
        let is_number = digits.iter().all(|it| it.is_ascii_digit() || matches!(it, b',' | b'.'));
        let comma = digits.iter().position(|it| *it == b',').filter(|_| is_number)?;
        let groups = |text: &[u8], mark: u8| ungrouped(text, mark).is_some();
        let rest = &digits[comma + 1..];
        if rest.iter().any(|it| matches!(it, b',' | b'.')) {
            return groups(digits, b',').then_some(Commas::Group);
        }
        let is_open = groups(digits, b',') && !digits.contains(&b'.');
        (!is_open).then_some(Commas::Decimal)
    }

    /// The number in a field.
    pub(super) fn number(self, field: &[u8]) -> Option<f64> {
        let number = str::from_utf8(field).ok().and_then(|it| it.parse().ok());
        number.or_else(|| self.plain(field)?.parse().ok())
    }

    /// A number as it is written in programs; `None` if its digits are not in groups of three.
    fn plain(self, number: &[u8]) -> Option<String> {
        match self {
            Commas::Group => ungrouped(number, b','),
            Commas::Decimal => ungrouped(number, b'.').map(|it| it.replace(',', ".")),
        }
    }
}

/// A number without the `mark`s between groups of three of its whole digits.
fn ungrouped(number: &[u8], mark: u8) -> Option<String> {
    let decimal = if mark == b',' { b'.' } else { b',' };
    let (sign, number) = if number.starts_with(b"-") { ("-", &number[1..]) } else { ("", number) };
    let end = number.iter().position(|it| *it == decimal).unwrap_or(number.len());
    let (whole, fraction) = number.split_at(end);
    let mut groups = whole.split(|it| *it == mark);
    let first = groups.next()?;
    let is_alone = first.len() == whole.len();
    let is_first = is_alone || ((1..=3).contains(&first.len()) && first[0] != b'0');
    let are_of_three = groups.all(|it| it.len() == 3 && it.iter().all(u8::is_ascii_digit));
    if !is_first || !are_of_three {
        return None;
    }
    let digits = whole.iter().filter(|it| **it != mark).chain(fraction);
    let digits: Vec<u8> = digits.copied().collect();
    Some(format!("{sign}{}", str::from_utf8(&digits).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_tells_the_separator() {
        for (text, separator) in [
            ("a,b;c\tx\n", Separator::Tab),
            ("a,b;c\n1,2\t", Separator::Semicolon),
            ("\n\"a;b\",c d\n", Separator::Comma),
            ("  2  13 437\n", Separator::Blanks),
            ("only\n1,2\n", Separator::Comma),
        ] {
            assert_eq!(Separator::of(text.as_bytes()), separator, "{text}");
        }
    }

    #[test]
    fn numbers_tell_what_commas_mean() {
        let of = |text: &str| Commas::of(text.as_bytes());
        for text in ["1,118,846", "6,454,415.049", "-1,234.5"] {
            assert_eq!(of(text), Some(Commas::Group), "{text}");
        }
        for text in ["1038,657", "-26,59", "0,041", "1.118.846,98", "1,2345"] {
            assert_eq!(of(text), Some(Commas::Decimal), "{text}");
        }
        for text in ["5,235", "-5,235", "7", "lane 1, wet", "1,2,3", ""] {
            assert_eq!(of(text), None, "{text}");
        }
        let commas = |text: &str| Dialect::of(text.as_bytes()).commas;
        assert_eq!(commas("a;b\n5,235;1\n"), Commas::Decimal);
        assert_eq!(commas("a,b\n\"5,235\",1\n"), Commas::Group);
        assert_eq!(commas("a,b\n\"5,235\",1\n\"5,2\",1\n"), Commas::Decimal);
        assert_eq!(commas("a\tb\n5,235\t1,118,846\n"), Commas::Group);
    }

    #[test]
    fn groups_of_three_digits_are_one_number() {
        let group = |text: &str| Commas::Group.plain(text.as_bytes());
        assert_eq!(group("1,118,846,980,200").as_deref(), Some("1118846980200"));
        assert_eq!(group("-1,873,017.19").as_deref(), Some("-1873017.19"));
        assert_eq!([group("1,2"), group("0,123"), group("1234,567"), group(",123")], [const { None }; 4]);
        let decimal = |text: &str| Commas::Decimal.plain(text.as_bytes());
        assert_eq!(decimal("-1.038,657").as_deref(), Some("-1038.657"));
        assert_eq!(decimal("0,041").as_deref(), Some("0.041"));
        assert_eq!(decimal("1.2,5"), None);
    }
}
