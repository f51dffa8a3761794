//! Car-following: exact reference values, and the motion of cars that follow each other.

mod cars;
mod delayed;
mod idm_plus;
mod limits;
mod optimal;
mod points;
mod queues;
mod rarer_points;
mod ring;
mod runs;
mod sets;
mod start;
mod stops;
mod waves;
