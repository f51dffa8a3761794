//! What has happened a short while ago, for pages that look when they can.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::source::{Mark, MarkKind};

/// Pages show lane changes for so long [s].
const KEPT_S: f64 = 60.0;
/// Of collisions and the like so many are kept.
const INCIDENTS: usize = 500;

/// The lane changes of the last minute, and the last incidents: all other events.
#[derive(Clone, Debug, Default)]
pub struct Recent {
    lane_changes: Last,
    incidents: Last,
}

/// How many events of both kinds a page knows, or has missed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Heard {
    lane_changes: u64,
    incidents: u64,
}

/// The last events of some kind.
#[derive(Clone, Debug, Default)]
struct Last {
    marks: VecDeque<Arc<Mark>>,
    /// The number of all so far.
    count: u64,
}

impl Last {
    fn add(&mut self, mark: Mark) {
        self.marks.push_back(Arc::new(mark));
        self.count += 1;
    }

    /// The events that are not heard yet, as far as they are kept.
    fn since(&self, heard: &mut u64) -> impl Iterator<Item = &Mark> {
        let kept = self.marks.len();
        let new = usize::try_from(self.count - *heard).map_or(kept, |it| it.min(kept));
        *heard = self.count;
        self.marks.range(kept - new..).map(|it| &**it)
    }
}

impl Recent {
    /// Adds events that happened until now [s], and forgets old ones.
    pub(crate) fn add(&mut self, marks: Vec<Mark>, now_s: f64) {
        let Recent { lane_changes, incidents } = self;
        for mark in marks {
            if mark.kind == MarkKind::LaneChange { lane_changes.add(mark) } else { incidents.add(mark) }
        }
        while lane_changes.marks.front().is_some_and(|it| it.time_s < now_s - KEPT_S) {
            lane_changes.marks.pop_front();
        }
        while incidents.marks.len() > INCIDENTS {
            incidents.marks.pop_front();
        }
    }

    /// Forgets all: the traffic is now at another time.
    pub(crate) fn clear(&mut self) {
        self.lane_changes.marks.clear();
        self.incidents.marks.clear();
    }

    /// The events that a page has not heard of yet, as far as they are kept.
    pub(crate) fn since(&self, heard: &mut Heard) -> Vec<&Mark> {
        let lane_changes = self.lane_changes.since(&mut heard.lane_changes);
        lane_changes.chain(self.incidents.since(&mut heard.incidents)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(kind: MarkKind, time_s: f64) -> Mark {
        let (vehicle, other, side, text) = ("1".to_owned(), None, None, None);
        Mark { kind, time_s, x: 0.0, y: 0.0, vehicle, other, side, text }
    }

    fn add(recent: &mut Recent, kind: MarkKind, times: &[f64], now_s: f64) {
        recent.add(times.iter().map(|it| mark(kind, *it)).collect(), now_s);
    }

    fn times(recent: &Recent, heard: &mut Heard) -> Vec<f64> {
        recent.since(heard).iter().map(|it| it.time_s).collect()
    }

    #[test]
    fn each_page_is_told_what_it_has_not_heard_unless_it_is_old() {
        let (mut recent, [mut first, mut second]) = (Recent::default(), [Heard::default(); 2]);
        add(&mut recent, MarkKind::LaneChange, &[1.0, 2.0], 2.0);
        assert_eq!(times(&recent, &mut first), [1.0, 2.0]);
        add(&mut recent, MarkKind::LaneChange, &[61.5], 61.5);
        assert_eq!((times(&recent, &mut first), times(&recent, &mut second)), (vec![61.5], vec![2.0, 61.5]));
        add(&mut recent, MarkKind::LaneChange, &[], 200.0);
        assert_eq!((times(&recent, &mut second), times(&recent, &mut Heard::default())), (vec![], vec![]));
    }

    #[test]
    fn incidents_are_kept_for_longer_but_not_all() {
        let mut recent = Recent::default();
        add(&mut recent, MarkKind::Collision, &[1.0], 1.0);
        add(&mut recent, MarkKind::LaneChange, &[5.0], 500.0);
        assert_eq!(times(&recent, &mut Heard::default()), [1.0]);
        (0..INCIDENTS).for_each(|_| add(&mut recent, MarkKind::EmergencyBraking, &[600.0], 600.0));
        let kept = times(&recent, &mut Heard::default());
        assert!(kept.len() == INCIDENTS && kept[0] == 600.0);
    }

    #[test]
    fn nothing_of_another_time_is_told() {
        let mut recent = Recent::default();
        add(&mut recent, MarkKind::MissedTurn, &[99.0], 100.0);
        add(&mut recent, MarkKind::LaneChange, &[100.0], 100.0);
        recent.clear();
        add(&mut recent, MarkKind::LaneChange, &[5.0], 5.0);
        assert_eq!(times(&recent, &mut Heard::default()), [5.0]);
    }
}
