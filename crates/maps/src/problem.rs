//! Problems of single elements of a map that is read nevertheless.

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
