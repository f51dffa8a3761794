//! Where traffic drives on the left: a guess from the place of a map, for a warning only.

use laneweave_network::DrivingSide;

use crate::options::ReadOptions;
use crate::problem::Problem;

/// Boxes of latitudes and longitudes [°]: south, north, west, east. They are approximate, leave out what lies near a
/// border with countries that drive on the right, and do not cover all countries that drive on the left. All from
/// memory.
const BOXES: [(&str, [f64; 4]); 22] = [
    ("Great Britain or Ireland", [51.1, 60.9, -10.7, 1.8]),
    ("Great Britain", [49.9, 51.1, -6.5, 1.0]),
    ("Japan", [30.9, 34.8, 129.5, 132.0]),
    ("Japan", [32.7, 41.6, 132.0, 142.2]),
    ("Japan", [41.3, 45.5, 139.7, 145.5]),
    ("Japan", [24.0, 28.6, 123.0, 130.0]),
    ("Australia", [-43.8, -10.6, 112.9, 153.7]),
    ("New Zealand", [-47.4, -34.3, 166.4, 178.6]),
    ("India", [5.9, 30.0, 69.5, 80.0]),
    ("India", [5.9, 26.4, 80.0, 91.5]),
    ("India or Pakistan", [30.0, 33.5, 71.5, 77.5]),
    ("southern Africa", [-35.0, -18.1, 14.0, 41.0]),
    ("Kenya", [-4.5, 3.3, 34.5, 40.5]),
    ("Tanzania", [-11.0, -1.5, 31.5, 40.5]),
    ("Thailand", [12.6, 17.3, 99.5, 102.2]),
    ("Malaysia or Singapore", [1.1, 6.4, 100.2, 104.5]),
    ("Indonesia", [-8.9, -5.8, 105.0, 116.5]),
    ("Hong Kong", [22.15, 22.48, 113.95, 114.4]),
    ("Cyprus", [34.5, 35.7, 32.2, 34.6]),
    ("Malta", [35.7, 36.1, 14.1, 14.6]),
    ("Jamaica", [17.6, 18.6, -78.5, -76.1]),
    ("Sri Lanka", [5.9, 9.9, 79.5, 82.0]),
];

/// The warning of a map whose place [°] lies where traffic drives on the left, if neither the map nor the options
/// give a side.
pub(crate) fn warning(
    place: Option<(f64, f64)>,
    of_map: Option<DrivingSide>,
    options: &ReadOptions,
) -> Option<Problem> {
    let country = country(place.filter(|_| of_map.or(options.driving_side).is_none())?)?;
    Some(Problem {
        element: "driving side".into(),
        line: None,
        what: format!(
            "the map seems to lie in {country} (an estimate), where traffic drives on the left, but does not say so, so traffic drives \
             on the right"
        ),
        remedy:
            "choose --driving-side left, or right if that is meant (map_options.driving_side in a scenario)"
                .into(),
    })
}

/// The country at this place [°], if traffic drives on the left there.
fn country((latitude, longitude): (f64, f64)) -> Option<&'static str> {
    let is_inside = |[south, north, west, east]: [f64; 4]| {
        (south..=north).contains(&latitude) && (west..=east).contains(&longitude)
    };
    BOXES.iter().find(|it| is_inside(it.1)).map(|it| it.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn towns_lie_where_their_traffic_drives_on_the_left() {
        for (town, place) in [
            ("London", (51.5, -0.12)),
            ("Plymouth", (50.37, -4.14)),
            ("Edinburgh", (55.95, -3.19)),
            ("Dublin", (53.35, -6.26)),
            ("Tokyo", (35.68, 139.76)),
            ("Fukuoka", (33.59, 130.4)),
            ("Sapporo", (43.06, 141.35)),
            ("Sydney", (-33.87, 151.21)),
            ("Perth", (-31.95, 115.86)),
            ("Auckland", (-36.85, 174.76)),
            ("Delhi", (28.61, 77.21)),
            ("Kolkata", (22.57, 88.36)),
            ("Cape Town", (-33.92, 18.42)),
            ("Johannesburg", (-26.2, 28.04)),
            ("Nairobi", (-1.29, 36.82)),
            ("Singapore", (1.35, 103.82)),
            ("Hong Kong", (22.28, 114.16)),
        ] {
            assert!(country(place).is_some(), "{town}");
        }
    }

    #[test]
    fn towns_of_their_neighbours_do_not() {
        for (town, place) in [
            ("Calais", (50.95, 1.86)),
            ("Boulogne", (50.73, 1.6)),
            ("Dieppe", (49.92, 1.08)),
            ("Cherbourg", (49.64, -1.62)),
            ("Busan", (35.18, 129.08)),
            ("Seoul", (37.57, 126.98)),
            ("Vladivostok", (43.12, 131.89)),
            ("Taipei", (25.03, 121.57)),
            ("Shenzhen", (22.54, 114.06)),
            ("Kabul", (34.53, 69.17)),
            ("Yangon", (16.87, 96.2)),
            ("Phnom Penh", (11.56, 104.92)),
            ("Luanda", (-8.84, 13.23)),
            ("Kigali", (-1.94, 30.06)),
            ("Addis Ababa", (9.03, 38.74)),
            ("Karlsruhe", (49.0, 8.4)),
            ("nowhere", (0.0, 0.0)),
        ] {
            assert_eq!(country(place), None, "{town}");
        }
    }

    #[test]
    fn nobody_is_warned_who_has_chosen() {
        let tokyo = Some((35.68, 139.76));
        let chosen = ReadOptions { driving_side: Some(DrivingSide::Right), ..ReadOptions::default() };
        assert!(warning(tokyo, None, &ReadOptions::default()).is_some_and(|it| it.what.contains("in Japan")));
        assert_eq!(warning(tokyo, None, &chosen), None);
        assert_eq!(warning(tokyo, Some(DrivingSide::Left), &ReadOptions::default()), None);
        assert_eq!(warning(None, None, &ReadOptions::default()), None);
    }
}
