//! Parts of a sweep, for as many programs that know nothing of each other.

use std::str::FromStr;

/// A part of a sweep: one run in so many. The default is all of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Its number, from 0 on.
    number: usize,
    /// The number of parts.
    of: usize,
}

impl Default for Shard {
    fn default() -> Shard {
        Shard { number: 0, of: 1 }
    }
}

impl Shard {
    /// Whether the run at this place is of this part.
    pub(super) fn has(self, place: usize) -> bool {
        place % self.of == self.number
    }

    /// Whether it is all of the sweep.
    pub fn is_all(self) -> bool {
        self.of == 1
    }
}

impl FromStr for Shard {
    type Err = String;

    /// Part i of n: `i/n`, from 1 on.
    fn from_str(text: &str) -> Result<Shard, String> {
        let wrong = || format!("{text:?} is no part such as 1/3, 2/3 or 3/3");
        let (number, of) = text.split_once('/').ok_or_else(wrong)?;
        let count = |it: &str| it.parse::<usize>().ok().filter(|it| *it > 0);
        match (count(number), count(of)) {
            (Some(number), Some(of)) if number <= of => Ok(Shard { number: number - 1, of }),
            _ => Err(wrong()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_run_is_of_one_part() {
        let parts: Vec<Shard> = ["1/3", "2/3", "3/3"].map(|it| it.parse().expect("a part")).into();
        for place in 0..100 {
            assert_eq!(parts.iter().filter(|it| it.has(place)).count(), 1);
        }
        assert!((0..100).all(|it| Shard::default().has(it)));
    }

    #[test]
    fn what_is_no_part_is_refused() {
        for text in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }
}
