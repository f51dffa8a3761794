//! How often pages may save.

use std::time::{Duration, Instant};

use laneweave::Fault;

/// Time between two at least.
const EVERY: Duration = Duration::from_secs(1);
/// All that one server saves.
const MOST: u32 = 100;

/// What was saved so far.
#[derive(Debug, Default)]
pub(crate) struct Saves {
    count: u32,
    last: Option<Instant>,
}

impl Saves {
    /// Counts one that is to be made `now`.
    ///
    /// # Errors
    /// If it comes too soon, or is one too many.
    pub(crate) fn count_one(&mut self, now: Instant) -> Result<(), Fault> {
        if self.last.is_some_and(|it| now.duration_since(it) < EVERY) {
            return Err(Fault::new("save", "it was saved just now", "save again in a second"));
        }
        if self.count >= MOST {
            let remedy = "end laneweave view, and view the last of them";
            return Err(Fault::new("save", format!("{MOST} scenarios were saved"), remedy));
        }
        self.count += 1;
        self.last = Some(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_saves_without_end_fills_no_disk() {
        let (begin, mut saves) = (Instant::now(), Saves::default());
        let saved = |saves: &mut Saves, tenths: u64| {
            saves.count_one(begin + Duration::from_millis(100 * tenths)).is_ok()
        };
        assert_eq!((0..100).filter(|it| saved(&mut saves, *it)).count(), 10, "one a second");
        assert_eq!((100..100_000).filter(|it| saved(&mut saves, *it)).count(), MOST as usize - 10);
    }
}
