//! One instant as drivers see it: where vehicles are, and which ones are next to each other.

pub(crate) mod fork;
pub(crate) mod pose;
pub(crate) mod scene;
pub(crate) mod sight;
pub(crate) mod snapshot;
