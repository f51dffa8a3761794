//! The traffic law on a map: speed limits where the map gives none, and the use of lanes.

use laneweave_network::LaneUse;

/// Kilometres an hour in a mile an hour.
pub(crate) const KMH_PER_MPH: f64 = 1.609_344;

/// The traffic law that applies on a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Law {
    /// That of Germany.
    #[default]
    Germany,
    /// That of most of the United States.
    UnitedStates,
}

impl Law {
    /// Which lanes it wants drivers to use. Many states ask only slower traffic to keep to the slow side; none of that
    /// is read here.
    pub fn lane_use(self) -> LaneUse {
        match self {
            Law::Germany => LaneUse::SlowSide,
            Law::UnitedStates => LaneUse::Free,
        }
    }
    /// The limit of a lanelet of this subtype in this location, in Lanelet2's terms [km/h].
    pub(crate) fn limit(self, subtype: Option<&str>, location: Option<&str>) -> f64 {
        match self {
            Law::Germany => germany(subtype, location),
            Law::UnitedStates => KMH_PER_MPH * united_states(subtype, location),
        }
    }
}

/// Germany [km/h], with the values of the reference library: 130 on a motorway (where it is only advised), 7 in a
/// play street, otherwise 100 outside of towns and 50 inside (StVO §3, §18, §42;
/// Autobahn-Richtgeschwindigkeits-Verordnung).
fn germany(subtype: Option<&str>, location: Option<&str>) -> f64 {
    match (subtype, location) {
        (Some("highway"), _) => 130.0,
        (Some("play_street"), _) => 7.0,
        (_, Some("nonurban")) => 100.0,
        _ => 50.0,
    }
}

/// The United States [mph], where each state has its own law. On ordinary roads those of the Uniform Vehicle Code
/// (§11-801.1): 30 in an urban district, 55 elsewhere. On freeways the commonest maximum of the states (Insurance
/// Institute for Highway Safety, Maximum posted speed limits): 70, in towns 65. The figures are from memory. In a play
/// street, for which there is no such rule, 15: ours.
fn united_states(subtype: Option<&str>, location: Option<&str>) -> f64 {
    match (subtype, location) {
        (Some("highway"), Some("urban")) => 65.0,
        (Some("highway"), _) => 70.0,
        (Some("play_street"), _) => 15.0,
        (_, Some("nonurban")) => 55.0,
        _ => 30.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limit(law: Law, subtype: &str, location: &str) -> f64 {
        law.limit(Some(subtype), Some(location))
    }

    #[test]
    fn german_defaults_hold_without_a_tag() {
        assert_eq!(limit(Law::Germany, "road", "urban"), 50.0);
        assert_eq!(limit(Law::Germany, "road", "nonurban"), 100.0);
        assert_eq!(limit(Law::Germany, "highway", "nonurban"), 130.0);
        assert_eq!(limit(Law::Germany, "play_street", "urban"), 7.0);
        assert_eq!(Law::Germany.limit(None, None), 50.0);
    }

    #[test]
    fn american_defaults_are_in_miles() {
        let mph = |subtype, location| (limit(Law::UnitedStates, subtype, location) / 1.609344).round();
        assert_eq!([mph("road", "urban"), mph("road", "nonurban")], [30.0, 55.0]);
        assert_eq!([mph("highway", "urban"), mph("highway", "nonurban")], [65.0, 70.0]);
        assert_eq!(mph("play_street", "urban"), 15.0);
    }
}
