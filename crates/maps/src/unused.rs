//! What a map holds and traffic does not use: named once for its kind, with its number.

use std::collections::BTreeMap;
use std::fmt::Display;

use crate::problem::Problem;

/// Kinds of elements that traffic does not use.
#[derive(Clone, Debug, Default)]
pub struct Unused(BTreeMap<(String, Meaning), Found>);

/// What it means that something is not used: what traffic does instead, and what a user can do.
pub type Meaning = (&'static str, &'static str);

/// The elements of one kind.
#[derive(Clone, Debug)]
struct Found {
    first: (&'static str, String, usize),
    count: usize,
}

/// What an element is, its id, and its line.
pub(crate) type Place<Id> = (&'static str, Id, usize);

/// Maximum of kinds: names of kinds come from the file.
const MAXIMUM_KINDS: usize = 100;

/// Maximum of letters of a name from the file.
const LETTERS: usize = 60;

impl Unused {
    /// Counts an element of a kind named in the plural, such as `lanelets of the subtype walkway`.
    pub fn add(&mut self, kind: &str, (name, id, line): Place<impl Display>, meaning: Meaning) {
        let kind: String = kind.chars().take(LETTERS).collect();
        let key = (kind, meaning);
        let first = || Found { first: (name, id.to_string(), line), count: 0 };
        if self.0.len() >= MAXIMUM_KINDS && !self.0.contains_key(&key) {
            let others = ("elements of still other kinds".into(), meaning);
            self.0.entry(others).or_insert_with(first).count += 1;
            return;
        }
        self.0.entry(key).or_insert_with(first).count += 1;
    }

    /// One problem for each kind.
    pub fn problems(self) -> impl Iterator<Item = Problem> {
        self.0.into_iter().map(|((kind, (what, remedy)), Found { first: (name, id, line), count })| Problem {
            element: format!("{name} {id}"),
            line: Some(line),
            what: format!("{kind}, {count} in all: {what}"),
            remedy: remedy.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_is_named_once_with_its_number() {
        const MEANING: Meaning = ("nobody drives there", "leave it so");
        let mut unused = Unused::default();
        for id in 7..10 {
            unused.add("stairs", ("lanelet", id, 40 + id as usize), MEANING);
        }
        unused.add("rails", ("lanelet", 3, 9), MEANING);
        let told: Vec<String> = unused.problems().map(|it| it.to_string()).collect();
        assert_eq!(
            told,
            [
                "lanelet 3 (line 9): rails, 1 in all: nobody drives there; leave it so",
                "lanelet 7 (line 47): stairs, 3 in all: nobody drives there; leave it so"
            ]
        );
    }

    #[test]
    fn the_number_of_kinds_is_limited() {
        let mut unused = Unused::default();
        (0..10_000).for_each(|id| unused.add(&format!("kind {id}"), ("way", id, 1), ("", "")));
        assert_eq!(unused.problems().count(), MAXIMUM_KINDS + 1);
    }
}
