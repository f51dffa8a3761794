//! Who holds which conflict zone, and what the lights show.

pub(crate) mod claim;
pub(crate) mod controller;
pub(crate) mod need;
pub(crate) mod passages;
pub(crate) mod refuge;
pub(crate) mod rings;
pub(crate) mod signals;
pub(crate) mod state;
