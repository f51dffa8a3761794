//! The step: the only part that changes a world.

pub(crate) mod advance;
pub(crate) mod checkpoint;
pub(crate) mod enter;
pub(crate) mod gather;
pub(crate) mod grant_reservations;
pub(crate) mod guide;
pub(crate) mod move_all;
pub(crate) mod note_incidents;
pub(crate) mod note_milestones;
pub(crate) mod pool;
pub(crate) mod put_vehicle;
pub(crate) mod queries;
pub(crate) mod reserve_on_entering;
pub(crate) mod resolve;
pub(crate) mod switch_lights;
pub(crate) mod transfer;
pub(crate) mod vehicle;
pub(crate) mod wait_cycles;
pub(crate) mod work;
pub(crate) mod world;
