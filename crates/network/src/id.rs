//! Names of things on a map.

use std::cmp::Ordering;
use std::collections::HashSet;
use std::fmt;
use std::iter::Peekable;
use std::str::Chars;
use std::sync::{LazyLock, Mutex, PoisonError};

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The id of something on a map, as the map's file writes it: a text such as `edge_0`, or a whole number.
///
/// A text that a whole number displays as is that number: `Id::from("12")` equals `Id::from(12)`. Ids are in natural
/// order: numbers first, by their values, then texts, in which digits count as numbers (`lane_2` before `lane_10`).
///
/// It can be copied, because what refers to lanes and lights is copied all the time. For this, each text is kept once
/// for as long as the program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Id(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    Number(i64),
    Text(&'static str),
}

impl Id {
    /// The whole number that it is.
    pub fn number(self) -> Option<i64> {
        match self.0 {
            Kind::Number(number) => Some(number),
            Kind::Text(_) => None,
        }
    }

    /// Gives its bytes to a hash: eight bytes of a number, or those of a text.
    pub fn hash_with(self, mut update: impl FnMut(&[u8])) {
        match self.0 {
            Kind::Number(number) => update(&number.to_le_bytes()),
            Kind::Text(text) => update(text.as_bytes()),
        }
    }
}

impl From<i64> for Id {
    fn from(number: i64) -> Id {
        Id(Kind::Number(number))
    }
}

impl From<&str> for Id {
    fn from(text: &str) -> Id {
        match text.parse::<i64>() {
            Ok(number) if number.to_string() == text => Id::from(number),
            _ => Id(Kind::Text(kept(text))),
        }
    }
}

impl PartialEq<i64> for Id {
    fn eq(&self, number: &i64) -> bool {
        *self == Id::from(*number)
    }
}

impl PartialEq<&str> for Id {
    fn eq(&self, text: &&str) -> bool {
        *self == Id::from(*text)
    }
}

/// The one copy of this text.
fn kept(text: &str) -> &'static str {
    static TEXTS: LazyLock<Mutex<HashSet<&'static str>>> = LazyLock::new(Mutex::default);
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = texts.get(text) {
        return known;
    }
    let new: &'static str = Box::leak(text.into());
    texts.insert(new);
    new
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Kind::Number(number) => number.fmt(f),
            Kind::Text(text) => text.fmt(f),
        }
    }
}

impl Ord for Id {
    fn cmp(&self, other: &Id) -> Ordering {
        match (self.0, other.0) {
            (Kind::Number(one), Kind::Number(other)) => one.cmp(&other),
            (Kind::Number(_), Kind::Text(_)) => Ordering::Less,
            (Kind::Text(_), Kind::Number(_)) => Ordering::Greater,
            (Kind::Text(one), Kind::Text(other)) => natural(one, other).then_with(|| one.cmp(other)),
        }
    }
}

impl PartialOrd for Id {
    fn partial_cmp(&self, other: &Id) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Which of two texts comes first, if runs of digits count as numbers.
fn natural(one: &str, other: &str) -> Ordering {
    let (mut one, mut other) = (one.chars().peekable(), other.chars().peekable());
    loop {
        let order = match (one.peek().copied(), other.peek().copied()) {
            (Some(a), Some(b)) if a.is_ascii_digit() && b.is_ascii_digit() => {
                let [a, b] = [digits(&mut one), digits(&mut other)];
                a.len().cmp(&b.len()).then_with(|| a.cmp(&b))
            }
            (Some(a), Some(b)) => {
                one.next();
                other.next();
                a.cmp(&b)
            }
            (a, b) => return a.cmp(&b),
        };
        if order != Ordering::Equal {
            return order;
        }
    }
}

/// Takes the run of digits at the beginning, without zeros in front.
fn digits(text: &mut Peekable<Chars<'_>>) -> String {
    let mut all = String::new();
    while let Some(digit) = text.next_if(char::is_ascii_digit) {
        if digit != '0' || !all.is_empty() {
            all.push(digit);
        }
    }
    all
}

impl Serialize for Id {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Reads a text or, where the format tells what follows, a whole number.
impl<'de> Deserialize<'de> for Id {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Id, D::Error> {
        if deserializer.is_human_readable() {
            deserializer.deserialize_any(Reader)
        } else {
            deserializer.deserialize_str(Reader)
        }
    }
}

struct Reader;

impl Visitor<'_> for Reader {
    type Value = Id;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an id: a text or a whole number")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Id, E> {
        Ok(Id::from(text))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Id, E> {
        Ok(Id::from(number))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Id, E> {
        Ok(Id::from(number.to_string().as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_written_as_text_is_that_number() {
        assert_eq!(Id::from("-12"), Id::from(-12));
        for other in ["012", "+12", "12 ", "1e3", "", "99999999999999999999"] {
            assert_eq!(Id::from(other).number(), None, "{other}");
            assert_eq!(Id::from(other).to_string(), other);
        }
    }

    #[test]
    fn ids_are_in_natural_order() {
        let mut ids = ["b", "a_10", "a_2", "-3", "10", "9", "a_02", "a", "a_2_1"].map(Id::from);
        ids.sort();
        let texts = ids.map(|it| it.to_string());
        assert_eq!(texts, ["-3", "9", "10", "a", "a_02", "a_2", "a_2_1", "a_10", "b"]);
    }

    #[test]
    fn files_hold_texts_and_may_hold_numbers() {
        let read = |text: &str| serde_json::from_str::<Id>(text);
        assert_eq!(read("12").expect("a number"), Id::from(12));
        assert_eq!(read(r#""12""#).expect("a text"), Id::from(12));
        assert_eq!(read(r#""edge_0""#).expect("a text"), Id::from("edge_0"));
        assert!(read("1.5").is_err());
        assert_eq!(serde_json::to_string(&Id::from(12)).expect("it is text"), r#""12""#);
    }
}
