//! Files of other formats: told by their content, and answered with what to do.

use std::fs;

use laneweave_maps::{ReadOptions, load};
use laneweave_test_data::data;

const FROM_OPENDRIVE: &str =
    "; make a net of SUMO of it, which is read: netconvert --opendrive-files IN.xodr -o OUT.net.xml";
const FROM_STREETS: &str =
    "; make a net of SUMO of it, which is read: netconvert --osm-files IN.osm -o OUT.net.xml";

fn refusal(name: &str, content: impl AsRef<[u8]>) -> String {
    let file = std::env::temp_dir().join(format!("laneweave-maps-other-{}-{name}", std::process::id()));
    fs::write(&file, content).expect("it is written");
    let refusal = load(&file, &ReadOptions::default()).expect_err("it is no map").to_string();
    fs::remove_file(&file).expect("it is removed");
    refusal
}

#[test]
fn road_networks_of_other_formats_are_told_by_their_content() {
    let opendrive = "<?xml version='1.0' standalone='yes'?>\n<OpenDRIVE><header/></OpenDRIVE>";
    for name in ["town.xodr", "town.xml", "town.osm", "town"] {
        let expected = format!(
            "by its content this is an OpenDRIVE road network, which is not read as a map{FROM_OPENDRIVE}"
        );
        assert_eq!(refusal(name, opendrive), expected, "{name}");
    }
    let sumo = "<?xml version='1.0'?>\n<!-- by netconvert -->\n<net version='1.16'></net>";
    for name in ["town.net", "town.osm"] {
        let expected = "by its content this is a SUMO map";
        assert!(refusal(name, sumo).contains(expected), "{name}: {}", refusal(name, sumo));
    }
    for (text, remedy) in [
        ("<configuration/>", "run it with `laneweave run`, or give the net"),
        ("<!-- tutorial --><sumoConfiguration/>", "run it with `laneweave run`, or give the net"),
        ("<routes><vehicle/></routes>", "name it in a configuration (.sumocfg) beside the net"),
        ("<additional/>", "name it in a configuration (.sumocfg) beside the net"),
    ] {
        for name in ["town.sumocfg", "town.rou.xml", "town"] {
            let refusal = refusal(name, text);
            assert!(
                refusal.contains("which is not read as a map; ") && refusal.contains(remedy),
                "{refusal}"
            );
        }
    }
    for name in ["town.osm.pbf", "town.pbf", "town.osm"] {
        let refusal = refusal(name, b"\0\0\0\x0e\n\tOSMHeader\x18\xb0\x01\x10");
        assert!(refusal.starts_with("by its content this is binary OpenStreetMap data (.pbf)"), "{refusal}");
        assert!(refusal.contains("; a Lanelet2 map becomes .osm by `osmium cat"), "{refusal}");
    }
}

#[test]
fn real_files_of_other_formats_are_told() {
    let files = [
        ("opendrive/soderleden.xodr", "an OpenDRIVE road network"),
        ("opendrive/e6mini.xodr", "an OpenDRIVE road network"),
    ];
    for (file, what) in files {
        let Some(path) = data(file) else { continue };
        let refusal = load(&path, &ReadOptions::default()).unwrap_err().to_string();
        assert_eq!(
            refusal,
            format!("by its content this is {what}, which is not read as a map{FROM_OPENDRIVE}"),
            "{file}"
        );
    }
}

#[test]
fn a_street_map_without_lanelets_is_called_that() {
    let streets = "<osm>\n<node id='1' lat='49' lon='8'/><node id='2' lat='49.1' lon='8'/>\n<way id='9'><nd ref='1'/>\
                   <nd ref='2'/><tag k='building' v='yes'/></way>\n<way id='10'><nd ref='1'/><nd ref='2'/><tag k='highway' \
                   v='residential'/></way><way id='11'><tag k='highway' v='primary'/></way></osm>";
    assert_eq!(
        refusal("streets.osm", streets),
        format!(
            "line 4: this is a street map of OpenStreetMap, with 2 streets (way 10 is the first) and no lanelet, so nothing is known \
             of its lanes{FROM_STREETS}; or draw lanelets"
        )
    );
}

#[test]
fn decimal_commas_are_named_with_their_place() {
    let node = |place: &str| {
        refusal("commas.osm", format!("<osm>\n<node id='1' lat='49' lon='8'/>\n{place}</node></osm>"))
    };
    let expected = |key: &str, value: &str, better: &str| {
        format!(
            "line 3: {key} is \"{value}\", with a decimal comma; write a point in all numbers, such as {better}, for example by \
             another language in the settings of the program that exported the map"
        )
    };
    assert_eq!(node("<node id='2' lat='49,25' lon='8'>"), expected("lat", "49,25", "49.25"));
    assert_eq!(node("<node id='2' lat='49' lon='-8,5'>"), expected("lon", "-8,5", "-8.5"));
    assert_eq!(node("<node id='2'><tag k='local_x' v='12,5'/>"), expected("local_x", "12,5", "12.5"));
    let text = "<commonRoad commonRoadVersion='2020a'>\n<lanelet id='7'><leftBound><point><x>0,5</x><y>1</y></point>\
                </leftBound></lanelet></commonRoad>";
    let refusal = refusal("commas.xml", text);
    assert!(
        refusal.contains("lanelet 7 (line 2): its point/x is \"0,5\", with a decimal comma"),
        "{refusal}"
    );
}
