//! Junctions: where lanes get in each other's way, who goes first there, and what lights show.

mod drawn;
mod lights;
mod precedence;
mod zones;
