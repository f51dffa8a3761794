//! Files in the format of SUMO (Eclipse SUMO 1.28), for scripts that read SUMO's output. Names, units and order of
//! the attributes are those of its files and schemas. Numbers have two decimals, as in SUMO.

mod fcd;
mod lanechange;
mod lanes;
mod tripinfo;
mod xml;

pub(super) use fcd::Fcd;
pub(super) use lanechange::LaneChangeOutput;
pub(super) use lanes::Lanes;
pub(super) use tripinfo::TripInfo;
pub(super) use xml::attribute;
