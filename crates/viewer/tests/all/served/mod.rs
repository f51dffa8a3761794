//! The server, as pages and others meet it.

mod client;
mod frames;
mod guarded;
mod limits;
#[cfg(target_os = "linux")]
mod sending;
mod watching;
