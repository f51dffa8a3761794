//! The step: the only part that changes a world.

pub(crate) mod advance;
pub(crate) mod answers;
pub(crate) mod checkpoint;
pub(crate) mod enter;
pub(crate) mod gather;
pub(crate) mod granting;
pub(crate) mod guide;
pub(crate) mod lights;
pub(crate) mod milestones;
pub(crate) mod move_all;
pub(crate) mod pool;
pub(crate) mod put;
pub(crate) mod reserve;
pub(crate) mod resolve;
pub(crate) mod transfer;
pub(crate) mod vehicle;
pub(crate) mod wait_cycles;
pub(crate) mod watch;
pub(crate) mod work;
pub(crate) mod world;
