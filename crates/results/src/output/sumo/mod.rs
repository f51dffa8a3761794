//! Files as SUMO (Eclipse SUMO 1.28) writes them, for whoever has scripts that read those: names, units and order of
//! the attributes as in its files and schemas. Numbers have two decimals, as there.

mod fcd;
mod lanechange;
mod lanes;
mod tripinfo;
mod xml;

pub(super) use fcd::Fcd;
pub(super) use lanechange::LaneChangeOutput;
pub(super) use lanes::Lanes;
pub(super) use tripinfo::TripInfo;
