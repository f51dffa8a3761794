//! The step: the only part that changes a world.
//!
//! `world.rs` has the parts of a world and the list of verbs; each verb is a file of its name. Beside them:
//!
//! * `put_vehicle.rs` and `take_off.rs` vehicles come and go; `end_change.rs` ends a lane change; `wait_cycles.rs`
//!   drivers who wait for each other; `reserve_on_entering.rs` entrances within conflict areas
//! * `command.rs` takes commands of users, `change_roads.rs` and `carry_out.rs` carry them out, `settings.rs` tells
//!   what is set now; `insert.rs` and `names.rs` help
//! * `externals.rs`, `move_externals.rs`, `relocate.rs`, `obstacle.rs` and `show_rears.rs` the vehicles that users
//!   drive; `see_standing.rs` what others know of them; `recorded.rs` those that a recording moves; `put_obstacle.rs`
//!   what stands on the road and is no vehicle
//! * `work.rs` the threads and their memory
//! * `template.rs` many worlds of one kind
//! * `checkpoint.rs` and `seal.rs` the state of a world as bytes
//! * `queries.rs`, `columns.rs`, `column_poses.rs`, `vehicle.rs` and `index.rs` what a world tells of itself

pub(crate) mod advance;
pub(crate) mod carry_out;
pub(crate) mod change_roads;
pub(crate) mod checkpoint;
pub(crate) mod column_poses;
pub(crate) mod columns;
pub(crate) mod command;
pub(crate) mod command_error;
pub(crate) mod end_change;
pub(crate) mod enter;
pub(crate) mod externals;
pub(crate) mod gather;
pub(crate) mod grant_reservations;
pub(crate) mod guide;
pub(crate) mod index;
pub(crate) mod insert;
pub(crate) mod known_names;
pub(crate) mod move_all;
pub(crate) mod move_externals;
pub(crate) mod names;
pub(crate) mod note_incidents;
pub(crate) mod note_milestones;
pub(crate) mod obstacle;
pub(crate) mod place_vehicle;
pub(crate) mod put_obstacle;
pub(crate) mod put_vehicle;
pub(crate) mod queries;
pub(crate) mod recorded;
pub(crate) mod relocate;
pub(crate) mod reserve_on_entering;
pub(crate) mod resolve;
pub(crate) mod seal;
pub(crate) mod see_standing;
mod serve_stops;
pub(crate) mod settings;
pub(crate) mod show_rears;
pub(crate) mod switch_lights;
pub(crate) mod take_off;
pub(crate) mod template;
pub(crate) mod transfer;
pub(crate) mod vehicle;
pub(crate) mod wait_cycles;
pub(crate) mod work;
pub(crate) mod world;
