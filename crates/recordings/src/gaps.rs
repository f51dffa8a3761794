//! Gaps in which nobody was recorded part a recording: only its fullest part is read.
//!
//! One row with a wrong time, or the rows of another day, would make everything that follows the clock endless.

use std::collections::BTreeMap;

use laneweave_maps::Problem;

use crate::recording::Recording;

/// The longest time in which nobody is there [s]. Ours: far longer than any gap of a recorded road by day.
const LONGEST: f64 = 300.0;
/// Parts that are named.
const NAMED: usize = 3;

/// A part of a recording.
#[derive(Clone, Copy)]
struct Part {
    first: i64,
    last: i64,
    states: usize,
}

/// Leaves out of `recording` what lies beyond gaps; `problems` says what was left out.
pub(crate) fn leave_out_parts(recording: &mut Recording, problems: &mut Vec<Problem>) {
    let parts = parts(recording);
    // Of equal ones the first counts.
    let Some(kept) = parts.iter().copied().rev().max_by_key(|it| it.states) else { return };
    if parts.len() == 1 {
        return;
    }
    for track in &mut recording.tracks {
        track.states.retain(|it| (kept.first..=kept.last).contains(&it.frame));
    }
    recording.tracks.retain(|it| !it.states.is_empty());
    let others: Vec<Part> = parts.into_iter().filter(|it| it.first != kept.first).collect();
    let named = others.iter().take(NAMED).map(|it| match it.first == it.last {
        true => format!("frame {}", it.first),
        false => format!("frames {} to {}", it.first, it.last),
    });
    let mut named: Vec<String> = named.collect();
    if others.len() > NAMED {
        named.push(format!("{} more parts", others.len() - NAMED));
    }
    let states: usize = others.iter().map(|it| it.states).sum();
    problems.push(Problem {
        element: "the recording".into(),
        line: None,
        what: format!(
            "for more than {LONGEST} s nobody is there, so only its fullest part is used, frames {} to {}; {states} \
             states are left out: {}",
            kept.first,
            kept.last,
            named.join(", ")
        ),
        remedy: "correct their times, or give each part as a file of its own".into(),
    });
}

/// The parts between gaps, in order.
fn parts(recording: &Recording) -> Vec<Part> {
    let gap = ((LONGEST / recording.step).min(1e15) as i64).max(1);
    let block = |frame: i64| frame.div_euclid(gap);
    // Within a block no gap is too long.
    let mut blocks: BTreeMap<i64, Part> = BTreeMap::new();
    for track in &recording.tracks {
        for together in track.states.chunk_by(|a, b| block(a.frame) == block(b.frame)) {
            let (first, last) = (together[0].frame, together[together.len() - 1].frame);
            let it = blocks.entry(block(first)).or_insert(Part { first, last, states: 0 });
            *it = Part {
                first: it.first.min(first),
                last: it.last.max(last),
                states: it.states + together.len(),
            };
        }
    }
    let mut parts: Vec<Part> = Vec::new();
    for it in blocks.into_values() {
        match parts.last_mut().filter(|before| it.first - before.last <= gap) {
            Some(before) => (before.last, before.states) = (it.last, before.states + it.states),
            None => parts.push(it),
        }
    }
    parts
}
