//! The server, as pages and others meet it.

mod client;
mod frames;
mod guarded;
mod limits;
mod watching;
