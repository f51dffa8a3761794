//! Studies: questions that take many simulations, or a simulation and recorded traffic. Each stands on
//! [`Simulation`](laneweave::Simulation) alone, and knows nothing of what is behind it.

pub mod branch;
pub mod check;
pub mod compare;
pub mod cut_ins;
mod draws;
pub mod experiments;
pub mod fit;
mod parallel;
pub mod replay;
pub mod routes;
pub mod sweep;

pub use draws::{DrawnMeasure, Draws, PER_DRAW, draws};
pub use parallel::{in_parallel, in_parallel_while};
