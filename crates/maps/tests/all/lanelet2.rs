//! Reading Lanelet2 maps: which elements are left out, and which files are refused.

use std::fs;
use std::path::Path;

use laneweave_maps::{Map, MapError, ReadOptions, lanelet2, load};
use laneweave_network::{DrivingSide, Id};
use laneweave_test_data::data;

/// Two lanes of 10 m, of which each test breaks something.
const TWO_LANES: &str = "<osm>
<node id='1' lat='0' lon='0' x='0' y='0'/>
<node id='2' lat='0' lon='0' x='10' y='0'/>
<node id='3' lat='0' lon='0' x='0' y='4'/>
<node id='4' lat='0' lon='0' x='10' y='4'/>
<node id='5' lat='0' lon='0' x='0' y='8'/>
<node id='6' lat='0' lon='0' x='10' y='8'/>
<way id='11'><nd ref='1'/><nd ref='2'/></way>
<way id='12'><nd ref='3'/><nd ref='4'/><tag k='type' v='line_thin'/><tag k='subtype' v='dashed_solid'/></way>
<way id='13'><nd ref='5'/><nd ref='6'/></way>
<relation id='21'><member type='way' ref='12' role='left'/><member type='way' ref='11' role='right'/>
<tag k='type' v='lanelet'/></relation>
<relation id='22'><member type='way' ref='13' role='left'/><member type='way' ref='12' role='right'/>
<tag k='type' v='lanelet'/><tag k='speed_limit' v='36'/></relation>
</osm>";

fn read(text: &str) -> Result<Map, MapError> {
    lanelet2::read(text.as_bytes(), &ReadOptions::default())
}

/// The problems after the replacement of `from` by `to`, and the ids of the remaining lanelets.
fn broken(from: &str, to: &str) -> (Vec<String>, Vec<Id>) {
    assert!(TWO_LANES.contains(from), "{from}");
    let map = read(&TWO_LANES.replacen(from, to, 1)).expect("one lanelet is left");
    let ids = map.network.lanelets.iter().map(|it| it.id).collect();
    (map.problems.iter().map(ToString::to_string).collect(), ids)
}

fn one(from: &str, to: &str) -> String {
    let (mut problems, ids) = broken(from, to);
    assert_eq!((problems.len(), ids.len()), (1, 1), "{problems:?}");
    problems.remove(0)
}

#[test]
fn a_one_sided_line_may_be_crossed_from_one_side() {
    let network = read(TWO_LANES).unwrap().network;
    let [right, left] = &network.lanelets[..] else { panic!("two lanelets") };
    assert_eq!((right.left, right.adjacent_left.map(|it| it.0)), (None, Some(1)));
    assert_eq!((left.right.map(|it| it.0), left.adjacent_right), (Some(0), None));
    assert_eq!((right.speed_limit, left.speed_limit), (50.0 / 3.6, 10.0));
    assert_eq!(right.centre.points()[0].y, 2.0);
}

#[test]
fn a_border_may_be_listed_backwards() {
    let turned = TWO_LANES
        .replace("<nd ref='3'/><nd ref='4'/>", "<nd ref='4'/><nd ref='3'/>")
        .replace("dashed_solid", "solid_dashed");
    assert_eq!(
        format!("{:?}", read(&turned).unwrap().network),
        format!("{:?}", read(TWO_LANES).unwrap().network)
    );
}

#[test]
fn lanes_with_broken_borders_are_left_out_and_listed() {
    assert_eq!(
        one("<member type='way' ref='13' role='left'/>", ""),
        "lanelet 22 (line 13): left border is missing, so it is left out; add a way in the role of that side"
    );
    assert!(one("ref='11' role", "ref='99' role").contains("right border is way 99, which is missing"));
    assert!(
        one("ref='11' role", "ref='1' role").starts_with("lanelet 21 (line 11): its right border is way 1,")
    );
    assert!(one("role='right'/>\n", "role='left'/>\n").contains("several left borders"));
    assert!(one("<nd ref='5'/><nd ref='6'/>", "").contains("way 13, has no nodes"));
    assert!(one("<nd ref='5'/>", "<nd ref='77'/>").contains("runs through node 77, which is missing"));
    assert!(
        one("x='0' y='8'", "x='nan' y='8'")
            .contains("node 5 (line 6) of its border has no geographic position")
    );
    assert!(one("x='10' y='8'", "x='21000' y='8'").contains("longer than 20 km"));
}

#[test]
fn a_border_at_one_place_is_driven_around_and_listed() {
    for (from, to) in [("<nd ref='5'/>", ""), ("x='10' y='8'", "x='0' y='8'")] {
        let (problems, ids) = broken(from, to);
        assert_eq!(ids, [21, 22]);
        assert_eq!(
            problems,
            [
                "lanelet 22 (line 13): one of its borders is a single point, so vehicles turn around it; draw it through at least two \
              different points if it has a length"
            ]
        );
    }
}

#[test]
fn borders_that_were_drawn_badly_are_read_as_the_reference_library_reads_them() {
    let lengths = |name: &str| -> Option<(Vec<f64>, Vec<String>)> {
        let map = load(&data(&format!("cases/{name}.osm"))?, &ReadOptions::default()).unwrap();
        let problems = map.problems.iter().map(ToString::to_string).collect();
        // All are one row of lanelets.
        assert_eq!(map.network.chains.len(), 1, "{name}");
        Some((map.network.lanelets.iter().map(|it| it.length().round()).collect(), problems))
    };
    for (name, expected, what) in [
        ("04_inner_border_one_point", vec![100.0, 3.0, 100.0], "is a single point"),
        ("04b_inner_border_two_equal", vec![100.0, 3.0, 100.0], "is a single point"),
        ("05_repeated_node", vec![201.0], "one place twice in a row"),
        ("05b_two_nodes_one_place", vec![201.0], "one place twice in a row"),
        ("06b_spike", vec![201.0], "its borders cross"),
    ] {
        let Some((lengths, problems)) = lengths(name) else { continue };
        assert_eq!(lengths, expected, "{name}");
        assert!(problems.len() == 1 && problems[0].contains(what), "{name}: {problems:?}");
    }
}

#[test]
fn elements_that_share_an_id_are_listed() {
    assert!(
        one("relation id='22'", "relation id='21'").starts_with("relation 21 (line 13): another relation")
    );
    let (problems, ids) = broken("<node id='6'", "<node id='1' x='3' y='3'/>\n<node id='6'");
    assert_eq!((problems.len(), ids), (1, vec![21.into(), 22.into()]));
    assert!(problems[0].starts_with("node 1 (line 7): another node above"), "{problems:?}");
}

#[test]
fn limits_and_directions_that_cannot_be_used_are_listed_but_the_lane_stays() {
    let (problems, ids) = broken("v='36'", "v='-36'");
    assert_eq!((problems.len(), ids.len()), (1, 2));
    assert!(problems[0].starts_with("lanelet 22 (line 13): its speed_limit \"-36\" is not a speed"));
    let tag = "<tag k='speed_limit' v='36'/>";
    let (problems, ids) = broken(tag, "<tag k='one_way' v='no'/>");
    assert_eq!((problems.len(), ids.len()), (1, 2));
    assert!(
        problems[0].contains("both directions; simulated traffic uses the forward one only; draw a lanelet")
    );
}

#[test]
fn lanelets_that_are_not_for_vehicles_are_left_out_and_named() {
    let (problems, ids) = broken("<tag k='speed_limit' v='36'/>", "<tag k='subtype' v='walkway'/>");
    assert_eq!((problems.len(), ids), (1, vec![21.into()]));
    assert!(problems[0].starts_with("lanelet 22 (line 13): lanelets of the subtype walkway, 1 in all: no"));
}

#[test]
fn no_more_than_32_lanelets_share_a_border() {
    let copy = |id: usize| {
        format!(
            "<relation id='{id}'><member type='way' ref='12' role='left'/>\
             <member type='way' ref='11' role='right'/><tag k='type' v='lanelet'/></relation>"
        )
    };
    let copies: String = (100..140).map(copy).collect();
    let (problems, ids) = broken("</osm>", &format!("{copies}</osm>"));
    assert_eq!((problems.len(), ids.len()), (10, 32));
    assert!(problems[9].contains("32 others share its start"), "{problems:?}");
}

#[test]
fn a_map_without_lanes_for_cars_is_refused() {
    assert_eq!(
        read("<osm/>").unwrap_err().to_string(),
        "none of its 0 lanelets can be used by vehicles; \
         give roads the tags type=lanelet and subtype=road, or participant:vehicle=yes"
    );
    let error = read(&TWO_LANES.replace("<node", "<other")).unwrap_err();
    let MapError::NotDrivable { lanelets: 2, problems, .. } = &error else { panic!("{error}") };
    assert_eq!(problems.len(), 2);
    assert!(
        error.to_string().contains("(the first problem is lanelet 21 (line 11): its border, way 12, runs")
    );
}

#[test]
fn the_driving_side_is_the_option_then_what_the_map_says_then_right() {
    let side = |text: &str, driving_side| {
        let options = ReadOptions { driving_side, ..ReadOptions::default() };
        lanelet2::read(text.as_bytes(), &options).unwrap().network.driving_side
    };
    let left = TWO_LANES.replace("<osm>", "<osm><MetaInfo driving_side='left'/>");
    assert_eq!(side(TWO_LANES, None), DrivingSide::Right);
    assert_eq!(side(&left, None), DrivingSide::Left);
    assert_eq!(side(&left, Some(DrivingSide::Right)), DrivingSide::Right);
}

#[test]
fn a_map_that_lies_where_traffic_drives_on_the_left_and_does_not_say_so_is_warned_of() {
    let tokyo = TWO_LANES.replacen("lat='0' lon='0'", "lat='35.68' lon='139.76'", 1);
    let problems = |text: &str, driving_side| {
        let options = ReadOptions { driving_side, ..ReadOptions::default() };
        lanelet2::read(text.as_bytes(), &options).unwrap().problems
    };
    let found = problems(&tokyo, None);
    assert_eq!((found.len(), found[0].element.as_str()), (1, "driving side"));
    assert!(found[0].remedy.contains("--driving-side left"), "{found:?}");
    assert_eq!(problems(&tokyo, Some(DrivingSide::Right)), []);
    assert_eq!(problems(&tokyo.replace("<osm>", "<osm><MetaInfo driving_side='right'/>"), None), []);
    assert_eq!(problems(TWO_LANES, None), []);
}

#[test]
fn a_lanelet_lies_in_a_town_unless_the_map_says_otherwise() {
    let in_town = |tag: &str| {
        let text =
            TWO_LANES.replace("<tag k='type' v='lanelet'/>", &format!("<tag k='type' v='lanelet'/>{tag}"));
        assert!(tag.is_empty() || text != TWO_LANES);
        let lanelets = read(&text).unwrap().network.lanelets;
        lanelets.iter().map(|it| it.is_in_town).collect::<Vec<_>>()
    };
    assert_eq!(in_town(""), [true; 2]);
    assert_eq!(in_town("<tag k='location' v='urban'/>"), [true; 2]);
    assert_eq!(in_town("<tag k='location' v='nonurban'/>"), [false; 2]);
}

#[test]
fn files_that_cannot_be_read_say_why() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let refusal = |path: &Path| load(path, &ReadOptions::default()).unwrap_err().to_string();
    assert_eq!(refusal(&root.join("nowhere.osm")), "there is no such file; check the path");
    assert_eq!(refusal(root), "this is a folder; give a map file in it");
    assert_eq!(
        refusal(&root.join("src/lib.rs")),
        "no map format has the extension \"rs\"; known are Lanelet2 (.osm, .osm_xy), CommonRoad (.xml), SUMO (.net.xml, .xml)"
    );
    assert_eq!(
        refusal(&root.join("Cargo.toml")),
        "by its name this is a scenario or a style, not a map; give the map itself, which a scenario names in its key map"
    );
    let file = std::env::temp_dir().join(format!("laneweave-maps-{}.OSM", std::process::id()));
    fs::write(&file, "no map at all").unwrap();
    assert!(refusal(&file).starts_with("line 1: the outermost element is <>, not <osm>"));
    fs::write(&file, TWO_LANES).unwrap();
    assert_eq!(load(&file, &ReadOptions::default()).unwrap().network.lanelets.len(), 2);
    fs::remove_file(&file).unwrap();
}

#[test]
fn a_file_with_a_wrong_name_is_told_by_its_content() {
    let refusal = |name: &str, text: &str| {
        let file = std::env::temp_dir().join(format!("laneweave-maps-{}-{name}", std::process::id()));
        fs::write(&file, text).unwrap();
        let refusal = load(&file, &ReadOptions::default()).unwrap_err().to_string();
        fs::remove_file(&file).unwrap();
        refusal
    };
    const LANELET2: &str = "by its content this is a Lanelet2 map; rename it so that its name ends in .osm";
    for name in ["two.oms", "two.xml", "two"] {
        assert_eq!(refusal(name, TWO_LANES), LANELET2, "{name}");
    }
    assert_eq!(
        refusal("two.osm", "<?xml version='1.0'?><commonRoad/>"),
        "by its content this is a CommonRoad map; rename it so that its name ends in .xml"
    );
    assert_eq!(
        refusal("tracks.csv", "track_id,frame_id"),
        "by its name this is a table, such as a recording, not a map; give the map of its location, known are Lanelet2 (.osm, .osm_xy), CommonRoad (.xml), SUMO (.net.xml, .xml)"
    );
    assert_eq!(
        refusal("town.scenario", "map = \"town.osm\""),
        "by its content this is a scenario or a style, not a map; give the map itself, or let the name of a scenario end in .toml"
    );
    assert_eq!(refusal("town.osm", "# ours\nmap = \"m.osm\""), refusal("town.scenario", "map = \"m.osm\""));
    assert_eq!(refusal("tracks.xml", "track_id,frame_id"), refusal("tracks.osm", "track_id,frame_id"));
    assert!(refusal("tracks.osm", "track_id,frame_id").starts_with("by its content this is a table"));
}
