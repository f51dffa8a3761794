//! Whatever a map holds and traffic does not use is named once for its kind, with its number.

use laneweave_maps::{Problem, ReadOptions, commonroad, lanelet2, load};
use laneweave_test_data::data;

/// A road of two lanes of 100 m, 21 and 22, with points beside it for more.
fn road(more: &str) -> String {
    let node = |(id, x, y): (i64, i64, i64)| format!("<node id='{id}' x='{x}' y='{y}'/>\n");
    let at = [(1, 0), (2, 100), (3, 40), (4, 44)];
    let nodes = at.iter().flat_map(|(id, x)| [(*id, *x, 0), (10 + id, *x, 4), (20 + id, *x, 8)]);
    let beside = [(51, 30, -40), (52, 34, -40), (53, 200, 0), (54, 200, 8), (55, 200, 4)];
    let nodes: String = nodes.chain(beside).map(node).collect();
    let way = |id: i64, through: [i64; 4]| {
        let nodes: String = through.iter().map(|it| format!("<nd ref='{it}'/>")).collect();
        format!("<way id='{id}'>{nodes}<tag k='type' v='line_thin'/><tag k='subtype' v='dashed'/></way>")
    };
    let ways = way(31, [1, 3, 4, 2]) + &way(32, [11, 13, 14, 12]) + &way(33, [21, 23, 24, 22]);
    let lanes = lane(21, 32, 31, "") + &lane(22, 33, 32, "");
    format!("<osm>{nodes}{ways}\n{lanes}{more}</osm>")
}

fn lane(id: i64, left: i64, right: i64, more: &str) -> String {
    format!(
        "<relation id='{id}'><member type='way' ref='{left}' role='left'/><member type='way' ref='{right}' role='right'/>{more}\
         <tag k='type' v='lanelet'/></relation>\n"
    )
}

fn way(id: i64, from: i64, to: i64) -> String {
    format!("<way id='{id}'><nd ref='{from}'/><nd ref='{to}'/></way>")
}

fn tag(key: &str, value: &str) -> String {
    format!("<tag k='{key}' v='{value}'/>")
}

fn rule(id: i64, subtype: &str) -> String {
    format!("<relation id='{id}'>{}{}</relation>", tag("type", "regulatory_element"), tag("subtype", subtype))
}

/// Lanes beside the road, each with these tags.
fn beside(tags: &str) -> String {
    let borders = way(61, 51, 53) + &way(62, 52, 54);
    borders + &lane(71, 62, 61, tags) + &lane(72, 62, 61, tags)
}

/// The problems of a map, one of each kind.
fn told(problems: &[Problem]) -> Vec<String> {
    Problem::kinds(problems).into_iter().map(|(it, _)| it.to_string()).collect()
}

#[test]
fn a_road_of_which_all_is_used_has_no_problems() {
    let map = lanelet2::read(road("").as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(map.problems, []);
}

/// Checks that the map with each of these is read, and that what traffic does not use is named once.
fn are_named(cases: &[(String, &str)]) {
    for (more, expected) in cases {
        let map = lanelet2::read(road(more).as_bytes(), &ReadOptions::default()).expect("a map");
        let problems: Vec<String> =
            map.problems.iter().map(|it| Problem { line: None, ..it.clone() }.to_string()).collect();
        let matching = problems.iter().filter(|it| it.contains(expected)).count();
        assert_eq!(matching, 1, "{expected}: {problems:?}");
        assert!(map.problems.iter().all(|it| !it.remedy.is_empty() && it.line.is_some()), "{problems:?}");
    }
}

#[test]
fn rules_that_traffic_does_not_use_are_named() {
    are_named(&[
        (
            rule(81, "digital_speed_limit") + &rule(82, "digital_speed_limit"),
            "regulatory element 81: regulatory elements of the subtype digital_speed_limit, 2 in all: traffic does not know",
        ),
        (
            rule(81, "crosswalk"),
            "regulatory elements of the subtype crosswalk, 1 in all: there are no pedestrians",
        ),
        (
            rule(81, "speed_limit"),
            "regulatory elements of the subtype speed_limit, 1 in all: no lanelet refers",
        ),
        (
            rule(81, "traffic_light"),
            "regulatory element 81: traffic_light: no lanelet for vehicles refers to it",
        ),
        (
            rule(81, "right_of_way"),
            "regulatory element 81: right_of_way: no lanelet for vehicles refers to it",
        ),
    ]);
}

#[test]
fn signs_lights_and_stop_lines_of_no_rule_are_named() {
    let way = |id: i64, kind: &str| {
        format!("<way id='{id}'><nd ref='51'/><nd ref='52'/>{}</way>", tag("type", kind))
    };
    are_named(&[
        (
            way(91, "stop_line") + &way(92, "stop_line"),
            "way 91: ways of the type stop_line, 2 in all: no regulatory element refers to it",
        ),
        (way(91, "traffic_light"), "ways of the type traffic_light, 1 in all: no regulatory element"),
        (way(91, "traffic_sign"), "ways of the type traffic_sign, 1 in all: no regulatory element"),
    ]);
    let used = "<relation id='81'><member type='way' ref='91' role='ref_line'/>".to_owned()
        + &tag("type", "regulatory_element")
        + &tag("subtype", "traffic_light")
        + "</relation>";
    let map =
        lanelet2::read(road(&(way(91, "stop_line") + &used)).as_bytes(), &ReadOptions::default()).unwrap();
    assert!(told(&map.problems).iter().all(|it| !it.contains("way 91")), "{:?}", map.problems);
}

#[test]
fn lanelets_and_tags_that_traffic_does_not_use_are_named() {
    let centre = "<member type='way' ref='32' role='centerline'/>";
    are_named(&[
        (
            beside(&tag("subtype", "walkway")),
            "lanelet 71: lanelets of the subtype walkway, 2 in all: no vehicle may",
        ),
        (
            beside(&tag("subtype", "higway")),
            "lanelet 71: lanelets of the subtype higway, 2 in all: the subtype is unknown",
        ),
        (
            beside(&tag("participant:vehicle", "no")),
            "lanelets of the subtype road, 2 in all: their tags participant",
        ),
        (
            beside(&tag("participant:bicycle", "yes")),
            "lanelets of the subtype road, 2 in all: their tags participant",
        ),
        (
            beside(&(tag("participant:vehicle", "yes") + &tag("participant:vehicle:hgv", "no"))),
            "lanelet 71: lanelets with the tag participant:vehicle:hgv, 2 in all: this tag is not read",
        ),
        (
            beside(&tag("layer", "1")),
            "lanelet 71: lanelets with the tag layer, 2 in all: this tag is not read, so",
        ),
        (beside(&tag("maxspeed", "30")), "lanelets with the tag maxspeed, 2 in all: this tag is not read"),
        (
            beside(&tag("speed_limit:vehicle:truck", "30")),
            "lanelets with the tag speed_limit:vehicle:truck, 2 in all",
        ),
        (
            beside(&tag("one_way", "no")),
            "lanelet 71: it may be used in both directions; simulated traffic uses the forward one only",
        ),
        (
            beside(centre),
            "lanelets with a member in the role centerline, 2 in all: the centre line is computed",
        ),
    ]);
}

#[test]
fn elements_that_traffic_does_not_use_are_named() {
    let ramp = way(61, 51, 3) + &way(62, 52, 4) + &lane(71, 61, 62, "");
    let join = way(61, 2, 53) + &way(62, 22, 54) + &lane(71, 62, 61, "");
    are_named(&[
        (
            format!("<relation id='81'>{}</relation>", tag("type", "multipolygon")),
            "relation 81: areas (relations of the type multipolygon), 1 in all: traffic drives on lanelets only",
        ),
        (
            format!("<relation id='81'>{}</relation>", tag("type", "route")),
            "relations of the type route, 1 in all",
        ),
        (
            format!("<way id='81'><nd ref='51'/>{}</way>", tag("highway", "primary")),
            "way 81: ways with the tag highway, 1 in all: they are of OpenStreetMap",
        ),
        (
            format!("<node id='81' x='0' y='0'>{}</node>", tag("highway", "traffic_signals")),
            "node 81: nodes with the tag highway, 1 in all: they are of OpenStreetMap",
        ),
        (
            join,
            "lanelet 21: it ends at only one of the two points at which another lanelet begins, so it leads nowhere",
        ),
        (ramp, "lanelet 71: it ends in the middle of a border of another lanelet, so it leads nowhere"),
        (
            lane(71, 33, 31, "<member type='relation' ref='99' role='regulatory_element'/>"),
            "lanelet 71: its regulatory element 99 is missing, so it has no effect",
        ),
    ]);
}

#[test]
fn what_a_commonroad_map_holds_and_traffic_does_not_use_is_named() {
    let sidewalk = super::commonroad::short(7, 50.0, "<laneletType>sidewalk</laneletType>");
    let stop = super::commonroad::short(7, 50.0, "<stopLine><lineMarking>solid</lineMarking></stopLine>");
    let polygon =
        "<staticObstacle id='7'><shape><polygon><point><x>1</x></point></polygon></shape></staticObstacle>";
    let sign = |number: &str| {
        format!(
            "<trafficSign id='7'><trafficSignElement><trafficSignID>{number}</trafficSignID><additionalValue>9</additionalValue>\
             </trafficSignElement></trafficSign>"
        )
    };
    let cases: [(&str, &str); 9] = [
        (
            "<trafficLight id='7'/><trafficLight id='8'/>",
            "traffic light 7 (line 1): traffic lights, 2 in all",
        ),
        ("<intersection id='7'/>", "intersection 7 (line 1): intersections, 1 in all"),
        ("<planningProblem id='7'/>", "planning problem 7 (line 1): planning problems, 1 in all"),
        ("<phantomObstacle id='7'/>", "element 7 (line 1): elements <phantomObstacle>, 1 in all"),
        (
            &sidewalk,
            "lanelet 7 (line 1): lanelets of the type sidewalk, 1 in all: no vehicle may drive there",
        ),
        (&stop, "stop line of lanelet 7 (line 1): stop lines, 1 in all"),
        (polygon, "obstacle 7 (line 1): its first shape is not a rectangle or circle"),
        (&sign("205"), "traffic sign 7 (line 1): traffic signs 205, 1 in all: of signs, only speed limits"),
        (
            &sign("274"),
            "traffic sign 7 (line 1): traffic signs with a speed limit, 1 in all: no lanelet refers",
        ),
    ];
    for (more, expected) in cases {
        let lane = super::commonroad::short(1, 0.0, "<laneletType>urban</laneletType>");
        let text = format!("<commonRoad commonRoadVersion='2020a'>{lane}{more}</commonRoad>");
        let map = commonroad::read(text.as_bytes(), &ReadOptions::default()).unwrap();
        let problems = told(&map.problems);
        assert!(problems.len() == 1 && problems[0].starts_with(expected), "{expected}: {problems:?}");
    }
}

#[test]
fn cases_with_something_unused_are_named() {
    for (name, expected) in [
        ("15_two_into_one", "ends at only one of the two points"),
        ("16_joins_in_middle", "ends in the middle of a border"),
        ("21_unknown_rule", "of the subtype digital_speed_limit, 1 in all"),
        ("22_layer", "lanelets with the tag layer, 1 in all"),
    ] {
        let Some(path) = data(&format!("cases/{name}.osm")) else { continue };
        let map = load(&path, &ReadOptions::default()).unwrap();
        let problems = told(&map.problems);
        assert!(problems.iter().any(|it| it.contains(expected)), "{name}: {problems:?}");
    }
}
