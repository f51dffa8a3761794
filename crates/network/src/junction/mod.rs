//! Junctions as plain data: where chains conflict, which has priority, and where drivers stop. They are found in
//! `regulate`.

mod junctions;
mod light;
mod nearby;
mod on_chain;
mod plan;
mod regulations;
mod zone;

pub use junctions::Junctions;
pub use light::{InPlan, Light, LightIndex, LightState, Phase, Program};
pub use nearby::Nearby;
pub use on_chain::{Crossing, OnChain, Place, PlaceKind, Sign, Stop};
pub use plan::{Extension, LightConflict, SignalPlan, Turn};
pub use regulations::{Priority, Regulations, StopKind, StopRule};
pub use zone::{Precedence, Reach, Touch, Zone, ZoneIndex, ZoneKind};
