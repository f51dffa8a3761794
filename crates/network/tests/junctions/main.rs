//! Junctions: where lanes get in each other's way, who goes first there, and what lights show.

mod drawn;
mod lights;
mod nearby;
mod precedence;
mod shared;
mod widths;
mod zones;
