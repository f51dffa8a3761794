//! Problems of single elements of a map that is read nevertheless.

use std::collections::HashMap;
use std::fmt;

use serde::Serialize;

/// The element of the problem that many lanelets have in common: they lack borders.
pub const BORDERS: &str = "borders";

/// A part of a map that could not be used unchanged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// The element, such as `lanelet 4711`.
    pub element: String,
    /// The line of the file in which it begins.
    pub line: Option<usize>,
    /// What is wrong, and what was done about it.
    pub what: String,
    /// What the user can do about it.
    pub remedy: String,
}

impl Problem {
    /// The first problem of each kind, with their number, in the order in which they occurred.
    pub fn kinds(problems: &[Problem]) -> Vec<(&Problem, u64)> {
        let mut kinds: Vec<(&Problem, u64)> = Vec::new();
        let mut places: HashMap<(&str, &str), usize> = HashMap::new();
        for it in problems {
            let place = *places.entry((&it.what, &it.remedy)).or_insert(kinds.len());
            match kinds.get_mut(place) {
                Some((_, count)) => *count += 1,
                None => kinds.push((it, 1)),
            }
        }
        kinds
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.element)?;
        if let Some(line) = self.line {
            write!(f, " (line {line})")?;
        }
        write!(f, ": {}; {}", self.what, self.remedy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_of_a_kind_are_one_row() {
        let problem = |element: &str, what: &str| Problem {
            element: element.into(),
            line: None,
            what: what.into(),
            remedy: "mend it".into(),
        };
        let problems = [problem("a", "bent"), problem("b", "broken"), problem("c", "bent")];
        let kinds: Vec<(&str, u64)> =
            Problem::kinds(&problems).into_iter().map(|(it, count)| (it.element.as_str(), count)).collect();
        assert_eq!(kinds, [("a", 2), ("b", 1)]);
    }

    #[test]
    fn a_problem_has_a_place_and_a_remedy() {
        let mut problem = Problem {
            element: "lanelet 4711".into(),
            line: Some(903),
            what: "left border is missing".into(),
            remedy: "add a way with the role left".into(),
        };
        assert_eq!(
            problem.to_string(),
            "lanelet 4711 (line 903): left border is missing; add a way with the role left"
        );
        problem.line = None;
        assert!(problem.to_string().starts_with("lanelet 4711: left border"));
    }
}
