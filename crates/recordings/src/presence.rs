//! Who is there in a frame, found without a look at everybody.

use std::collections::HashMap;

use crate::recording::Track;

/// Tracks are listed for so many frames together.
const TOGETHER: i64 = 64;

/// The tracks that have states near a frame. It grows with the states, not with the time between them.
pub(crate) struct Presence {
    near: HashMap<i64, Vec<u32>>,
}

impl Presence {
    pub(crate) fn of(tracks: &[Track]) -> Presence {
        let mut near: HashMap<i64, Vec<u32>> = HashMap::new();
        for (number, track) in (0..).zip(tracks) {
            for together in track.states.chunk_by(|a, b| block(a.frame) == block(b.frame)) {
                near.entry(block(together[0].frame)).or_default().push(number);
            }
        }
        Presence { near }
    }

    /// The numbers of the tracks that may be there in `frame`, in order.
    pub(crate) fn near(&self, frame: i64) -> impl Iterator<Item = usize> {
        self.near.get(&block(frame)).into_iter().flatten().map(|it| *it as usize)
    }
}

fn block(frame: i64) -> i64 {
    frame.div_euclid(TOGETHER)
}
