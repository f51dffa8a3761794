//! Ids of road users as tables have them.

use std::fmt;

/// The id of a road user in a table.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Id {
    /// A whole number, also with a decimal point: 26, 26.0.
    Number(i64),
    /// Anything else: a name, a UUID.
    Text(Box<str>),
}

impl Id {
    /// Longer texts are no ids [B].
    pub(super) const LONGEST: usize = 100;

    /// The id in a field; `None` if it is empty or too long.
    pub(super) fn of(field: &[u8]) -> Option<Id> {
        if field.is_empty() || field.len() > Id::LONGEST {
            return None;
        }
        let Ok(text) = str::from_utf8(field) else {
            return Some(Id::Text(String::from_utf8_lossy(field).into()));
        };
        let whole = |(whole, decimals): (&str, &str)| {
            whole.parse().ok().filter(|_| decimals.bytes().all(|it| it == b'0'))
        };
        let number = text.parse().ok().or_else(|| text.split_once('.').and_then(whole));
        Some(number.map_or_else(|| Id::Text(text.into()), Id::Number))
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Id::Number(number) => number.fmt(f),
            Id::Text(text) => text.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_numbers_however_they_are_written() {
        let of = |text: &str| Id::of(text.as_bytes());
        for text in ["26", "26.0", "+26", "26."] {
            assert_eq!(of(text), Some(Id::Number(26)), "{text}");
        }
        for text in ["veh_26", "26.5", "P3", "0a1c2f9e-7d1b-4c8a-9c57-2f0d5f4a7e11", "2e5", "inf", "nan"] {
            assert_eq!(of(text), Some(Id::Text(text.into())), "{text}");
        }
        assert_eq!([of(""), of(&"x".repeat(101))], [None, None]);
    }
}
