//! Many worlds in which a program learns to drive: episodes with observations, actions and rewards.
//!
//! A [`Task`] says which vehicle the program drives, the ego, what it sees and may do, and what that is worth. A
//! [`Batch`] is many worlds of one task. The ego is one of the vehicles that arrive; it comes into traffic that has
//! been simulated before. Others see it as they see each other: they brake for it, let it in, and decide about their
//! lanes beside it.
//!
//! Same task, same seeds and same actions give the same bits, for any number of worlds and threads.

mod action;
mod batch;
mod observation;
mod reward;
mod start;
mod task;
mod world;

pub use action::{Action, Choice};
pub use batch::{Autoreset, Batch, Results};
pub use observation::{
    Grid, LANELET_COLUMNS, LINK_COLUMNS, Lanes, OWN_COLUMNS, Observation, Part, VEHICLE_COLUMNS,
};
pub use reward::{Rewards, TERMS};
pub use task::Task;
pub use world::AROUND;
