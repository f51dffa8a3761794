//! The names of enumerated values in serialized data: those of the tables.

use laneweave_network::{LightState, Side};
use laneweave_sim::{Class, IncidentKind, Kind, Phase};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

/// A value with a name in tables.
pub(super) trait Named: Copy + PartialEq + 'static {
    /// All values with their names.
    const NAMES: &'static [(&'static str, Self)];
}

impl Named for Class {
    const NAMES: &'static [(&'static str, Class)] = &[
        ("car", Class::Car),
        ("truck", Class::Truck),
        ("bus", Class::Bus),
        ("motorcycle", Class::Motorcycle),
    ];
}

impl Named for Phase {
    const NAMES: &'static [(&'static str, Phase)] = &[
        ("cruises", Phase::Cruises),
        ("wants", Phase::Wants),
        ("changes", Phase::Changes),
        ("aborts", Phase::Aborts),
    ];
}

impl Named for Kind {
    const NAMES: &'static [(&'static str, Kind)] =
        &[("discretionary", Kind::Discretionary), ("route", Kind::Route), ("keeping", Kind::Keeping)];
}

impl Named for Side {
    const NAMES: &'static [(&'static str, Side)] = &[("left", Side::Left), ("right", Side::Right)];
}

impl Named for IncidentKind {
    const NAMES: &'static [(&'static str, IncidentKind)] =
        &[("collision", IncidentKind::Collision), ("overlap", IncidentKind::Overlap)];
}

impl Named for LightState {
    const NAMES: &'static [(&'static str, LightState)] =
        &[("green", LightState::Green), ("yellow", LightState::Yellow), ("red", LightState::Red)];
}

/// Writes the name of a value.
pub(super) fn serialize<T: Named, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    let found = T::NAMES.iter().find(|(_, it)| it == value);
    serializer.serialize_str(found.map_or("", |(name, _)| name))
}

/// Reads a value by its name.
pub(super) fn deserialize<'de, T: Named, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    let name = String::deserialize(deserializer)?;
    let found = T::NAMES.iter().find(|(it, _)| *it == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let known: Vec<&str> = T::NAMES.iter().map(|(name, _)| *name).collect();
        D::Error::custom(format!("unknown name {name:?}; known are {}", known.join(", ")))
    })
}
