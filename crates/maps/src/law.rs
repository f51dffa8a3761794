//! The traffic law on a map: speed limits where the map gives none, and the use of lanes.

use laneweave_network::{LaneUse, RoadLaw};

use crate::drawing::KMH_PER_MPS;

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
    /// Its rules of the road.
    ///
    /// * Germany: drivers keep to the right (StVO § 2 (2)), and pass on the left (§ 5 (1)). In towns, on roads with
    ///   several marked lanes, vehicles of up to 3.5 t choose their lane freely, and may pass on the right (§ 7 (3)).
    ///   Trucks and coaches drive at most 80 km/h (§ 3 (3), § 18 (5)); that trucks of more than 7.5 t drive at most
    ///   60 km/h outside of towns is left out.
    /// * United States: who drives slower than the traffic keeps to the right (Uniform Vehicle Code § 11-301 (b)); all
    ///   may pass on either side of roads with several lanes (§ 11-304). Most states limit trucks as cars, but most
    ///   trucks are governed at about 65 mph.
    ///
    /// All from memory. Slower than the traffic means here: slower than the limit.
    pub fn rules(self) -> RoadLaw {
        match self {
            Law::Germany => RoadLaw {
                lane_use: LaneUse::SlowSide,
                lane_use_in_town: LaneUse::Free,
                limit_of_long: 80.0 / KMH_PER_MPS,
            },
            Law::UnitedStates => RoadLaw {
                lane_use: LaneUse::SlowSideIfSlower,
                lane_use_in_town: LaneUse::SlowSideIfSlower,
                limit_of_long: 65.0 * KMH_PER_MPH / KMH_PER_MPS,
            },
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
    fn each_law_says_who_keeps_to_the_slow_side_and_how_fast_trucks_drive() {
        let germany = Law::Germany.rules();
        assert_eq!([germany.lane_use, germany.lane_use_in_town], [LaneUse::SlowSide, LaneUse::Free]);
        assert!((germany.limit_of_long * KMH_PER_MPS - 80.0).abs() < 1e-9);
        let usa = Law::UnitedStates.rules();
        assert_eq!([usa.lane_use, usa.lane_use_in_town], [LaneUse::SlowSideIfSlower; 2]);
        assert!((usa.limit_of_long * KMH_PER_MPS - 104.6).abs() < 0.01);
    }

    #[test]
    fn american_defaults_are_in_miles() {
        let mph = |subtype, location| (limit(Law::UnitedStates, subtype, location) / 1.609344).round();
        assert_eq!([mph("road", "urban"), mph("road", "nonurban")], [30.0, 55.0]);
        assert_eq!([mph("highway", "urban"), mph("highway", "nonurban")], [65.0, 70.0]);
        assert_eq!(mph("play_street", "urban"), 15.0);
    }
}
