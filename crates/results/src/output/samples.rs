//! Samples of all vehicles at regular steps.

use std::mem;
use std::path::PathBuf;
use std::sync::mpsc::Receiver;

use laneweave_scenario::Fault;
use laneweave_sim::World;

use super::Output;
use super::batch::{Batch, BatchSender};
use super::frame::Frame;
use crate::outcome::Summary;

/// Samples all vehicles at regular steps.
pub(super) struct Samples {
    every: u32,
    frame: Frame,
    /// Whether no core is free for the writers while the world uses all its threads.
    is_machine_full: bool,
    sender: BatchSender,
    written: Receiver<Frame>,
    /// Frames that were sent and not yet written, and one to continue with.
    under_way: usize,
    spare: Frame,
}

impl Samples {
    /// Samples at every `every`-th step. Written frames come back through `written`.
    pub(super) fn new(
        every: u32,
        is_machine_full: bool,
        sender: BatchSender,
        written: Receiver<Frame>,
    ) -> Samples {
        let [frame, spare] = [Frame::default(), Frame::default()];
        Samples { every, frame, is_machine_full, sender, written, under_way: 0, spare }
    }

    /// Sends the frame. Threads of the world spin while they wait for each other. Where the writers would take the
    /// core of one of them, it is better to wait until they have written.
    fn hand_over(&mut self, world: &World) -> Result<(), Fault> {
        let full = mem::replace(&mut self.frame, mem::take(&mut self.spare));
        self.sender.hand_over(Batch::Frame(full))?;
        self.under_way += 1;
        let must_wait = self.is_machine_full && world.moves_on_all_threads();
        while self.under_way > 0 {
            // If the writers failed, the next send reports it.
            let frame = if must_wait { self.written.recv().ok() } else { self.written.try_recv().ok() };
            let Some(frame) = frame else { break };
            self.under_way -= 1;
            self.spare = frame;
        }
        Ok(())
    }
}

impl Output for Samples {
    fn save(&mut self, world: &World) -> Result<Vec<u8>, Fault> {
        if !self.frame.is_empty() {
            self.hand_over(world)?;
        }
        Ok(Vec::new())
    }

    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        if !world.clock().step.is_multiple_of(self.every) {
            return Ok(());
        }
        self.frame.sample(world);
        if self.frame.is_full() { self.hand_over(world) } else { Ok(()) }
    }

    fn finish(mut self: Box<Self>, world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        self.hand_over(world)?;
        Ok(Vec::new())
    }
}
