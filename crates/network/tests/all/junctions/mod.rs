//! Junctions: where lanes conflict, which has priority, and what lights show.

mod drawn;
mod forks;
mod lights;
mod nearby;
mod precedence;
mod shared;
mod widths;
mod zones;
