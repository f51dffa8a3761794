//! Records of lane changes under way, in slots that are reused.

use crate::record::events::LaneChange;
use crate::state::push_tight::push_tight;
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Records {
    kept: Vec<LaneChange>,
    free: Vec<u32>,
}

impl Records {
    /// Whether a slot exists.
    pub(crate) fn has(&self, slot: u32) -> bool {
        (slot as usize) < self.kept.len()
    }

    /// Whether every free slot exists.
    pub(crate) fn is_sound(&self) -> bool {
        self.free.iter().all(|it| self.has(*it))
    }

    /// Stores a record, and returns its slot.
    pub(crate) fn keep(&mut self, record: LaneChange) -> u32 {
        if let Some(slot) = self.free.pop() {
            self.kept[slot as usize] = record;
            return slot;
        }
        push_tight(&mut self.kept, record);
        self.kept.len() as u32 - 1
    }

    /// The record in `slot`.
    pub(crate) fn get_mut(&mut self, slot: u32) -> &mut LaneChange {
        &mut self.kept[slot as usize]
    }

    /// Frees `slot`.
    pub(crate) fn release(&mut self, slot: u32) {
        self.free.push(slot);
    }
}
