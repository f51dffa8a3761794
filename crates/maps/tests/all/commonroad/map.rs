//! The contents of a map, and its problems.

use laneweave_maps::{Map, MapError, ReadOptions, commonroad};
use laneweave_network::{DrivingSide, Id, Lanelet, LaneletIndex};

use crate::commonroad::{problems, read, short, two_lanes};

/// The problems of the map with `from` replaced, which must be there, and the remaining lanelets.
fn broken(from: &str, to: &str) -> (Vec<String>, Vec<Lanelet>) {
    let whole = two_lanes();
    assert!(whole.contains(from), "{from}");
    let map = read(&whole.replace(from, to)).expect("some lanelets are left");
    (problems(&map), map.network.lanelets)
}

fn at(index: u32) -> Option<LaneletIndex> {
    Some(LaneletIndex(index))
}

#[test]
fn lanelets_are_linked_as_the_file_says() {
    let map = read(&two_lanes()).unwrap();
    assert_eq!(problems(&map), [""; 0]);
    assert_eq!(map.problems.len(), 1);
    let lanelets = &map.network.lanelets;
    // The sidewalk is left out.
    assert_eq!(lanelets.iter().map(|it| it.id).collect::<Vec<_>>(), [11, 12, 21, 22, 31]);
    let following: Vec<_> = lanelets.iter().map(|it| it.following.first().map(|it| it.0)).collect();
    assert_eq!(following, [Some(1), None, Some(3), None, None]);
    let beside = |it: &Lanelet| [it.left, it.right, it.adjacent_left, it.adjacent_right];
    assert_eq!(beside(&lanelets[0]), [None, at(2), None, None]);
    assert_eq!(beside(&lanelets[2]), [at(0), None, None, None]);
    // The marking of 12's right bound counts for 22, whose left bound has none.
    assert_eq!(beside(&lanelets[1]), [None, None, None, at(3)]);
    assert_eq!(beside(&lanelets[3]), [None, None, at(1), None]);
    assert_eq!(beside(&lanelets[4]), [None; 4]);
    assert!(lanelets.iter().all(|it| it.length() == 100.0 && it.width(50.0) == 3.5));
    assert_eq!(lanelets[4].centre.at(0.0).x, 100.0);
}

#[test]
fn speed_limits_come_from_signs_elements_and_types() {
    let map = read(&two_lanes()).unwrap();
    let limits: Vec<f64> = map.network.lanelets.iter().map(|it| (it.speed_limit * 3.6).round()).collect();
    assert_eq!(limits, [50.0, 130.0, 72.0, 36.0, 50.0]);
}

#[test]
fn the_driving_side_is_the_options() {
    let side = |driving_side| {
        let options = ReadOptions { driving_side, ..ReadOptions::default() };
        commonroad::read(two_lanes().as_bytes(), &options).unwrap().network.driving_side
    };
    assert_eq!(side(None), DrivingSide::Right);
    assert_eq!(side(Some(DrivingSide::Left)), DrivingSide::Left);
}

#[test]
fn references_to_nothing_are_problems() {
    let (problems, lanelets) = broken("<successor ref='12'/>", "<successor ref='5'/><predecessor ref='6'/>");
    assert_eq!(
        problems,
        [
            "lanelet 11 (line 2): it refers to lanelet 6 (and 1 more), which is missing; add the lanelet, or remove the reference",
            "lanelet 12 (line 3): its predecessor 11 does not name it as a successor, so they are not connected; add the successor \
             there, or remove the predecessor here",
        ]
    );
    assert!(lanelets[0].following.is_empty());
    let (problems, lanelets) = broken("trafficSignRef ref='9'", "trafficSignRef ref='8'");
    assert!(problems[0].starts_with("lanelet 21 (line 4): it refers to traffic sign 8, which is missing"));
    assert!(
        problems[1].starts_with("traffic sign 9 (line 8): traffic signs with a speed limit, 1 in all: no")
    );
    assert_eq!((problems.len(), (lanelets[2].speed_limit * 3.6).round()), (2, 50.0));
}

#[test]
fn one_sided_links_are_problems() {
    let (problems, lanelets) = broken("<predecessor ref='11'/>", "");
    assert!(
        problems[0].starts_with("lanelet 11 (line 2): its successor 12 does not name it"),
        "{problems:?}"
    );
    assert_eq!((problems.len(), lanelets[0].following.len()), (1, 1));
    let (problems, lanelets) = broken("<adjacentLeft ref='11' drivingDir='same'/>", "");
    assert!(problems[0].starts_with("lanelet 11 (line 2): its neighbour 21 does not name it in return"));
    assert_eq!((problems.len(), lanelets[0].right, lanelets[2].left), (1, None, None));
    // Neighbours that do not agree on their direction are none either; both are reported.
    let (problems, lanelets) = broken("ref='11' drivingDir='same'", "ref='11' drivingDir='opposite'");
    assert_eq!((problems.len(), lanelets[0].right, lanelets[2].left), (2, None, None));
}

#[test]
fn lanelets_without_two_bounds_are_left_out() {
    let points = "<point><x>100</x><y>7</y></point><point><x>200</x><y>7</y></point>";
    let (problems, lanelets) = broken(points, "");
    assert_eq!(problems.len(), 1);
    assert!(problems[0].starts_with("lanelet 12 (line 3): its left border has no points with finite"));
    assert_eq!((lanelets.len(), lanelets[0].following.len()), (4, 0));
    let (problems, lanelets) = broken("<point><x>200</x><y>7</y></point>", "");
    assert!(problems[0].starts_with("lanelet 12 (line 3): one of its borders is a single point"));
    assert_eq!((problems.len(), lanelets.len()), (1, 5));
    for absurd in ["1e9", "NaN", "inf", "", "two", "-1e300"] {
        let point = format!("<point><x>{absurd}</x><y>7</y></point>");
        let (problems, lanelets) = broken("<point><x>200</x><y>7</y></point>", &point);
        assert_eq!((problems.len(), lanelets.len()), (1, 4), "{absurd}");
    }
}

#[test]
fn bounds_may_have_unequal_numbers_of_points() {
    let end = "<point><x>200</x><y>7</y></point>";
    let (problems, lanelets) = broken(end, &format!("<point><x>150</x><y>7</y></point>{end}"));
    assert_eq!((problems.len(), lanelets[1].length()), (0, 100.0));
}

#[test]
fn lanelets_that_lie_elsewhere_are_not_linked() {
    let beside = "<adjacentLeft ref='1' drivingDir='same'/>";
    let follows = "<predecessor ref='1'/>";
    let pair = |x: f64| {
        let first = "<successor ref='2'/><adjacentRight ref='3' drivingDir='same'/>";
        let (next, other) = (short(2, 10.0 + x, follows), short(3, x, beside));
        let map = read(&format!(
            "<commonRoad commonRoadVersion='2020a'>{}{next}{other}</commonRoad>",
            short(1, 0.0, first)
        ));
        let map = map.unwrap();
        let lanelets = map.network.lanelets;
        (map.problems.len(), lanelets[0].following.len(), lanelets[0].right, lanelets[2].left)
    };
    assert_eq!(pair(15.0), (0, 1, at(2), at(0)));
    assert_eq!(pair(25.0), (3, 0, None, None));
}

#[test]
fn a_second_lanelet_with_the_same_id_is_left_out() {
    let (problems, lanelets) = broken("<lanelet id='31'>", "<lanelet id='22'>");
    assert!(
        problems.iter().any(|it| it.starts_with("lanelet 22 (line 6): another lanelet above has the same"))
    );
    assert_eq!(lanelets.len(), 4);
}

#[test]
fn lanelets_for_both_directions_are_used_forwards() {
    let (problems, lanelets) = broken(
        "<laneletType>sidewalk</laneletType>",
        "<laneletType>sidewalk</laneletType><userBidirectional>vehicle</userBidirectional>",
    );
    assert!(
        problems[0].starts_with("lanelet 41 (line 7): it may be used in both directions"),
        "{problems:?}"
    );
    // 41 names 21, which names it, so that 21 has a neighbour now.
    assert_eq!((lanelets.len(), lanelets[2].right), (6, at(5)));
}

#[test]
fn other_xml_is_refused_with_what_was_expected() {
    assert_eq!(
        read("<?xml version='1.0'?>\n<OpenDRIVE/>").unwrap_err().to_string(),
        "line 2: the outermost element is <OpenDRIVE>, not <commonRoad>; is this a file of another format?"
    );
    assert_eq!(
        read("<commonRoad commonRoadVersion='2020a'/>").unwrap_err().to_string(),
        "none of its 0 lanelets can be used by vehicles; \
         give lanelets two bounds and a laneletType for cars, such as urban"
    );
    let error = read(&two_lanes().replace("leftBound", "leftBorder")).unwrap_err();
    let MapError::NotDrivable { lanelets: 6, problems, .. } = &error else { panic!("{error}") };
    assert_eq!(problems.len(), 6);
    assert!(error.to_string().contains("(the first problem is lanelet 11 (line 2): its left border"));
}

#[test]
fn a_map_in_a_left_hand_country_is_warned_of() {
    let at = |latitude: &str, longitude: &str| {
        let place = format!(
            "<location><gpsLatitude>{latitude}</gpsLatitude><gpsLongitude>{longitude}</gpsLongitude></location>"
        );
        problems(&read(&two_lanes().replacen("'>\n", &format!("'>{place}\n"), 1)).unwrap())
    };
    let found = at("51.5", "-0.1");
    assert!(
        found.len() == 1 && found[0].starts_with("driving side: the map seems to lie in Great"),
        "{found:?}"
    );
    assert_eq!((at("49", "8"), at("999", "999")), (vec![], vec![]));
}

#[test]
fn shuffled_lines_give_the_same_roads() {
    let text = two_lanes();
    let mut lines: Vec<&str> = text.lines().collect();
    let last = lines.len() - 1;
    lines[1..last].reverse();
    let (map, shuffled) = (read(&text).unwrap(), read(&lines.join("\n")).unwrap());
    let roads = |map: &Map| {
        let id = |it: LaneletIndex| map.network.lanelets[it.at()].id;
        let mut all: Vec<_> = map
            .network
            .lanelets
            .iter()
            .map(|it| {
                let following: Vec<Id> = it.following.iter().map(|it| id(*it)).collect();
                (it.id, following, it.left.map(id), it.right.map(id), it.speed_limit.to_bits())
            })
            .collect();
        all.sort();
        all
    };
    assert_eq!(roads(&map), roads(&shuffled));
    assert_eq!(problems(&shuffled), [""; 0]);
}

#[test]
fn what_stands_there_is_a_content_of_the_map() {
    let obstacle = |name: &str, id: i64, inside: &str| {
        format!(
            "<{name} id='{id}'>{inside}<initialState><position><point><x>50</x><y>2</y></point></position>\
             <orientation><exact>0.5</exact></orientation><time><exact>0</exact></time></initialState></{name}>\n"
        )
    };
    let car = "<type>parkedVehicle</type><shape><rectangle><length>4.2</length><width>1.7</width>\
               <center><x>2</x><y>0</y></center></rectangle></shape>";
    let round = "<type>pillar</type><shape><circle><radius>0.4</radius></circle></shape>";
    let shapeless = "<type>unknown</type><shape><polygon><point><x>1</x><y>1</y></point></polygon></shape>";
    let lost = "<staticObstacle id='6'><shape><circle><radius>1</radius></circle></shape></staticObstacle>\n";
    let twice = car.replace("</shape>", "<circle><radius>1</radius></circle></shape>");
    let inside = obstacle("staticObstacle", 1, &twice)
        + &obstacle("obstacle", 2, &format!("<role>static</role>{round}"))
        + &obstacle("obstacle", 3, &format!("<role>dynamic</role>{car}"))
        + &obstacle("dynamicObstacle", 4, car)
        + &obstacle("staticObstacle", 5, shapeless)
        + lost;
    let map = read(&two_lanes().replace("<trafficSign ", &(inside + "<trafficSign "))).unwrap();
    let found = &map.contents.obstacles;
    let sizes: Vec<[f64; 2]> = found.iter().map(|it| [it.length, it.width]).collect();
    assert_eq!(sizes, [[4.2, 1.7], [0.8, 0.8]]);
    let at = found[0].pose.at;
    assert!((at.x - 50.0 - 2.0 * 0.5f64.cos()).hypot(at.y - 2.0 - 2.0 * 0.5f64.sin()) < 1e-12, "{at:?}");
    assert_eq!((found[1].pose.at.x, found[1].pose.at.y, found[1].pose.heading), (50.0, 2.0, 0.5));
    let problems = problems(&map);
    assert_eq!(problems.len(), 3, "{problems:?}");
    assert!(problems[0].starts_with("obstacle 1 (line 8): only the first of its 2 shapes is used"));
    assert!(problems[1].starts_with("obstacle 5 (line 12): its first shape is not a rectangle or circle"));
    assert!(problems[2].starts_with("obstacle 6 (line 13): it has no orientation, so it is left out"));
}
