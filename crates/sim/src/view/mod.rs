//! One instant as it is seen: who is where, and who is next to whom.

pub(crate) mod fork;
pub(crate) mod pose;
pub(crate) mod scene;
pub(crate) mod sight;
pub(crate) mod snapshot;
