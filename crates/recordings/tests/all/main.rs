//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod alongside;
mod cleaning;
mod commonroad;
mod cut_ins;
mod datasets;
mod drawn_twice;
mod far_away;
mod interaction;
mod interaction_write;
mod join;
mod mona_east;
mod two_lanes;
mod utm;
mod written_otherwise;
