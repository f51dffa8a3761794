//! A list of problems that does not grow with the file: the first few of each kind, and the number of others.

use laneweave_maps::Problem;

/// Problems of one kind that are listed.
const LISTED: usize = 10;

/// Problems by kind.
#[derive(Debug, Default)]
pub(crate) struct Problems {
    kinds: Vec<Kind>,
}

#[derive(Debug)]
struct Kind {
    name: &'static str,
    remedy: &'static str,
    listed: Vec<Problem>,
    more: usize,
}

impl Problems {
    /// Adds a problem of the kind `name` with this `remedy`. `place` names the element and the problem; it is called
    /// only for listed ones.
    pub(crate) fn add(
        &mut self,
        name: &'static str,
        remedy: &'static str,
        line: usize,
        place: impl FnOnce() -> (String, String),
    ) {
        let known = self.kinds.iter().position(|it| it.name == name);
        let at = known.unwrap_or_else(|| {
            self.kinds.push(Kind { name, remedy, listed: Vec::new(), more: 0 });
            self.kinds.len() - 1
        });
        let kind = &mut self.kinds[at];
        if kind.listed.len() < LISTED {
            let (element, what) = place();
            kind.listed.push(Problem { element, line: Some(line), what, remedy: remedy.into() });
        } else {
            kind.more += 1;
        }
    }

    /// The first of all problems.
    pub(crate) fn first(&self) -> Option<&Problem> {
        self.kinds.iter().filter_map(|it| it.listed.first()).min_by_key(|it| it.line)
    }

    /// All listed problems in order of lines, then the number of others of each kind.
    pub(crate) fn into_list(self) -> Vec<Problem> {
        let rest: Vec<Problem> = self.kinds.iter().filter(|it| it.more > 0).map(Kind::rest).collect();
        let mut list: Vec<Problem> = self.kinds.into_iter().flat_map(|it| it.listed).collect();
        list.sort_by_key(|it| it.line);
        list.extend(rest);
        list
    }
}

impl Kind {
    fn rest(&self) -> Problem {
        Problem {
            element: "the file".into(),
            line: None,
            what: format!("{} more of the kind \"{}\"", self.more, self.name),
            remedy: self.remedy.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_ten_of_a_kind_are_listed_and_the_others_counted() {
        let mut problems = Problems::default();
        for line in 1..=13 {
            problems.add("bent row", "straighten it", line, || (format!("row {line}"), "it is bent".into()));
        }
        problems.add("late row", "hurry", 2, || ("row 2".into(), "it is late".into()));
        assert_eq!(problems.first().map(|it| it.line), Some(Some(1)));
        let list = problems.into_list();
        assert_eq!(list.len(), 12);
        assert_eq!(list[2].to_string(), "row 2 (line 2): it is late; hurry");
        assert_eq!(list[11].to_string(), "the file: 3 more of the kind \"bent row\"; straighten it");
    }
}
