//! What has happened a short while ago, for pages that look when they can.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::source::Mark;

/// Pages show events for so long [s].
const KEPT_S: f64 = 60.0;

/// The events of the last minute of the traffic. Each has a number, and later ones have greater numbers.
#[derive(Clone, Debug, Default)]
pub struct Recent {
    marks: VecDeque<Arc<Mark>>,
    /// The number of all events so far.
    count: u64,
}

impl Recent {
    /// Adds events that happened until now [s], and forgets old ones.
    pub(crate) fn add(&mut self, marks: Vec<Mark>, now_s: f64) {
        self.count += marks.len() as u64;
        self.marks.extend(marks.into_iter().map(Arc::new));
        while self.marks.front().is_some_and(|it| it.time_s < now_s - KEPT_S) {
            self.marks.pop_front();
        }
    }

    /// Forgets all: the traffic is now at another time.
    pub(crate) fn clear(&mut self) {
        self.marks.clear();
    }

    /// The events after the first `known` ones, as far as they are kept, and how many there were in all.
    pub(crate) fn since(&self, known: u64) -> (Vec<&Mark>, u64) {
        let new = usize::try_from(self.count - known).map_or(self.marks.len(), |it| it.min(self.marks.len()));
        (self.marks.range(self.marks.len() - new..).map(|it| &**it).collect(), self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::MarkKind;

    fn mark(time_s: f64) -> Mark {
        let (vehicle, other, side, text) = ("1".to_owned(), None, None, None);
        Mark { kind: MarkKind::LaneChange, time_s, x: 0.0, y: 0.0, vehicle, other, side, text }
    }

    fn times(recent: &Recent, known: u64) -> Vec<f64> {
        recent.since(known).0.iter().map(|it| it.time_s).collect()
    }

    #[test]
    fn what_is_not_known_yet_is_told_unless_it_is_old() {
        let mut recent = Recent::default();
        recent.add(vec![mark(1.0), mark(2.0)], 2.0);
        assert_eq!((times(&recent, 0), times(&recent, 1), recent.since(2).1), (vec![1.0, 2.0], vec![2.0], 2));
        recent.add(vec![mark(61.5)], 61.5);
        assert_eq!((times(&recent, 0), times(&recent, 2)), (vec![2.0, 61.5], vec![61.5]));
        recent.add(Vec::new(), 200.0);
        assert_eq!((times(&recent, 2), recent.since(0).1), (Vec::new(), 3));
    }

    #[test]
    fn nothing_of_another_time_is_told() {
        let mut recent = Recent::default();
        recent.add(vec![mark(100.0)], 100.0);
        recent.clear();
        recent.add(vec![mark(5.0)], 5.0);
        assert_eq!(times(&recent, 0), vec![5.0]);
    }
}
