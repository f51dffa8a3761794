//! Places for pages. Each allows so much work, whichever pages have it one after the other: a page that goes and comes
//! again gets no more done than one that stays.

use std::sync::{Arc, Mutex, PoisonError};

use tokio::time::Instant;

/// Pages at the same time.
const PLACES: usize = 16;
/// Work of a page a second, on average and at once, where a message that asks for little counts as 1.
const RATE: f64 = 200.0;
const BURST: f64 = 400.0;

/// The places that are free.
pub(super) struct Places(Mutex<Vec<Allowance>>);

/// The place of a page.
pub(super) struct Place {
    allowance: Allowance,
    places: Arc<Places>,
}

/// How much work is left.
#[derive(Clone, Copy)]
struct Allowance {
    left: f64,
    at: Instant,
}

impl Allowance {
    fn left(&self, now: Instant) -> f64 {
        let since = now.saturating_duration_since(self.at);
        (self.left + RATE * since.as_secs_f64()).min(BURST)
    }
}

impl Places {
    /// All of them.
    pub(super) fn new(now: Instant) -> Arc<Places> {
        Arc::new(Places(Mutex::new(vec![Allowance { left: BURST, at: now }; PLACES])))
    }

    /// The free place with the most work left, if one is free.
    pub(super) fn take(self: &Arc<Places>, now: Instant) -> Option<Place> {
        let mut free = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let left = |it: &usize| free[*it].left(now);
        let most = (0..free.len()).max_by(|a, b| left(a).total_cmp(&left(b)))?;
        Some(Place { allowance: free.swap_remove(most), places: Arc::clone(self) })
    }
}

impl Place {
    /// Takes work off what is left. Returns whether it was enough.
    pub(super) fn allows(&mut self, work: f64, now: Instant) -> bool {
        let left = self.allowance.left(now);
        self.allowance = Allowance { left: (left - work).max(0.0), at: now };
        left >= work
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.places.0.lock().unwrap_or_else(PoisonError::into_inner).push(self.allowance);
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    /// Work that a page gets done before it is cut off.
    fn spent(place: &mut Place, work: f64, now: Instant) -> f64 {
        (0..).take_while(|_| place.allows(work, now)).count() as f64 * work
    }

    #[test]
    fn who_comes_again_and_again_gets_no_more_done_than_who_stays() {
        let begin = Instant::now();
        let places = Places::new(begin);
        let come = |now: Instant| spent(&mut places.take(now).expect("a place"), 1.0, now);
        let at_once: f64 = (0..1000).map(|_| come(begin)).sum();
        assert_eq!(at_once, PLACES as f64 * BURST);
        let later: f64 = (1..=1000).map(|it| come(begin + Duration::from_millis(it))).sum();
        assert!(later <= PLACES as f64 * RATE, "{later} in a second");
    }

    #[test]
    fn a_page_that_asks_for_much_is_cut_off_sooner_and_one_that_asks_for_little_never() {
        let begin = Instant::now();
        let places = Places::new(begin);
        let (mut greedy, mut modest) = (places.take(begin).expect("one"), places.take(begin).expect("one"));
        assert_eq!(spent(&mut greedy, 100.0, begin), BURST);
        let asks = (0..100_000).map(|it| modest.allows(1.0, begin + Duration::from_millis(it * 6)));
        assert!(asks.into_iter().all(|it| it));
    }

    #[test]
    fn there_are_so_many_places_and_who_leaves_makes_room() {
        let now = Instant::now();
        let places = Places::new(now);
        let mut taken: Vec<Place> = std::iter::from_fn(|| places.take(now)).collect();
        assert_eq!(taken.len(), PLACES);
        taken.pop();
        assert!(places.take(now).is_some());
    }
}
