//! Drivers at junctions: who waits, who goes, and that no driver waits for ever.

mod actuated;
mod disutility;
mod flow;
mod giving_way;
mod guided;
mod lights;
mod minor_road;
mod room;
mod roundabouts;
mod same_bits;
mod town;
