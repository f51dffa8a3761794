//! Traffic in the browser: a page with the roads, the vehicles and the reasons of their drivers, and the server that
//! sends them there.
//!
//! A [`Source`] has the traffic. The [`stage`] owns it on a thread of its own, and publishes snapshots. The
//! [`Server`] sends each page what is in its view, at the page's pace. Watching changes nothing: what pages see is
//! copied, and only what is done by hand reaches the traffic, as commands of the library.

mod asked;
mod export;
mod frame;
mod message;
mod recent;
mod render;
mod saves;
mod scene;
mod server;
mod snapshot;
pub mod source;
pub mod stage;

pub use asked::{Asked, LONGEST};
pub use export::export;
pub use frame::{Slots, View};
pub use recent::Recent;
pub use render::{Camera, Picture, Pictures, picture, render};
pub use scene::{Scene, Surroundings};
pub use server::{Address, Doorway, Server, Token};
pub use snapshot::{Body, Colour, Seen, Snapshot};
pub use source::{Hand, Live, Recorded, Rerun, Shown, Source};

/// The page, in one file. It is generated from `web/`.
const PAGE: &str = include_str!("../page/index.html");
