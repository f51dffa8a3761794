//! `check` and `routes`.

use std::fs;
use std::io::Write;
use std::iter;

use flate2::Compression;
use flate2::write::GzEncoder;
use laneweave_test_data::data;
use serde_json::{Value, json};

use crate::command::program::{Folder, maps};

fn answer(folder: &Folder, line: &str) -> Value {
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{line}");
    serde_json::from_str(&run.text()).unwrap()
}

fn refusal(folder: &Folder, line: &str) -> String {
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.text().as_str()), (2, ""), "{line}: {}", run.errors());
    run.errors().trim_end().to_owned()
}

#[test]
fn check_tells_what_a_map_holds() {
    let folder = Folder::new();
    let report = answer(&folder, "check MAPS/ramps.osm --json");
    assert_eq!(
        (&report["lanelets"], &report["two_way"], &report["origin"]),
        (&96.into(), &0.into(), &Value::Null)
    );
    assert_eq!(report["entrances"].as_array().unwrap().len(), 2);
    assert_eq!(report["exits"].as_array().unwrap().len(), 3);
    assert_eq!((report["lane_drops"].as_array().unwrap().len(), &report["conflicts"]), (1, &0.into()));
    assert_eq!(report["elements"]["lanelet highway"], 96);
    assert!(report["problems"].as_array().unwrap().is_empty());
    let text = folder.laneweave("check MAPS/ramps.osm").text();
    assert!(text.contains("lanelets for vehicles  96, ") && text.ends_with("\nNo problems.\n"), "{text}");
}

#[test]
fn check_writes_the_graph_and_a_picture() {
    let folder = Folder::new();
    answer(&folder, "check MAPS/lane_drop.osm --json --graph g.json --svg m.svg");
    let graph: Value = serde_json::from_str(&folder.read("g.json")).unwrap();
    assert_eq!(graph["2"]["left"], "3");
    assert_eq!(graph["2"]["right"], "1");
    assert_eq!((&graph["1"]["right"], &graph["1"]["adjacent_right"]), (&Value::Null, &Value::Null));
    assert_eq!((&graph["1"]["following"], &graph["4"]["previous"]), (&json!(["4"]), &json!(["1"])));
    assert!((graph["1"]["speed_limit_mps"].as_f64().unwrap() - 120.0 / 3.6).abs() < 1e-9);
    assert!(graph["1"].get("backward").is_none());
    let picture = folder.read("m.svg");
    assert!(picture.starts_with("<svg") && picture.contains(">lane_drop.osm</text>"));
}

#[test]
fn a_page_of_a_map_finds_lanelets_by_their_ids() {
    let folder = Folder::new();
    let karlsruhe = data("lanelet2/karlsruhe.osm").map(|it| it.display().to_string());
    for map in iter::once("MAPS/town.osm".to_owned()).chain(karlsruhe) {
        let report = answer(&folder, &format!("check {map} --json --html m.html"));
        let page = folder.read("m.html");
        assert!(!page.contains("{{") && !page.replace("http://www.w3.org", "").contains("://"), "{map}");
        let (_, facts) = page.split_once("id=\"facts\">").expect("the facts");
        let facts: Value =
            serde_json::from_str(facts.split_once("</script>").expect("their end").0).expect("JSON");
        let list = |it: &Value| it.as_array().expect("a list").clone();
        let lanelets = list(&facts["lanelets"]);
        assert_eq!(lanelets.len() as u64, report["lanelets"].as_u64().expect("a number"), "{map}");
        for lanelet in &lanelets {
            let id = lanelet["id"].as_str().expect("digits");
            assert_eq!(page.matches(&format!("data-lanelet=\"{id}\"")).count(), 1, "{map}: {id}");
            for next in list(&lanelet["next"]) {
                let back = lanelets.iter().find(|it| it["id"] == next).expect("it is on the map");
                assert!(list(&back["before"]).contains(&lanelet["id"]), "{map}: {id} {next}");
            }
        }
        for (gates, own) in [("entrances", "entrance"), ("exits", "exit")] {
            let named: Vec<String> =
                list(&report[gates]).iter().map(|it| it["id"].as_str().expect("an id").to_owned()).collect();
            assert_eq!(facts[gates], json!(named), "{map}");
            assert!(named.iter().all(|it| lanelets.iter().any(|lanelet| lanelet[own] == json!(it))), "{map}");
        }
        assert_eq!(list(&facts["problems"]).len(), list(&report["problems"]).len(), "{map}");
    }
    let refused = refusal(&folder, "check MAPS/town.osm --html m.svg --svg m.svg");
    assert!(refused.contains("m.svg is already used for another file of this command"), "{refused}");
}

#[test]
fn maps_of_other_formats_say_what_to_do() {
    let streets = "<osm>\n<way id='7'><tag k='highway' v='residential'/></way></osm>";
    let folder = Folder::new()
        .with("town.xodr", "<OpenDRIVE/>")
        .with("town.net.xml", "<net/>")
        .with("town.osm.pbf", "\0\0\0\u{e}\n\tOSMHeader")
        .with("streets.osm", streets)
        .with("commas.osm", "<osm>\n<node id='1' lat='49,5' lon='8'/></osm>");
    for (file, place, what, remedy) in [
        ("town.xodr", "town.xodr: ", "an OpenDRIVE road network", "; make a net of SUMO of it"),
        (
            "town.net.xml",
            "town.net.xml: ",
            "none of its 0 lanelets can be used",
            "; give edges lanes that passenger cars may use",
        ),
        ("town.osm.pbf", "town.osm.pbf: ", "binary OpenStreetMap data", "; a Lanelet2 map becomes .osm by"),
        ("streets.osm", "streets.osm:2: ", "a street map of OpenStreetMap", "; make a net of SUMO of it"),
        ("commas.osm", "commas.osm:2: ", "lat is \"49,5\", with a decimal comma", "; write a point"),
    ] {
        for command in ["run", "view --no-browser"] {
            let run = folder.laneweave(&format!("{command} {file}"));
            assert_eq!((run.code(), run.text().as_str()), (2, ""), "{command} {file}: {}", run.errors());
            let told = run.errors();
            assert!(told.starts_with(&format!("error: {place}")), "{told}");
            assert!(told.contains(what) && told.contains(remedy), "{told}");
        }
    }
}

/// One lane of 100 m near Tokyo, and a crosswalk.
const IN_JAPAN: &str = "<osm><node id='1' lat='35.68' lon='139.76' x='0' y='0'/><node id='2' lat='35.68' lon='139.76' x='300' y='0'/>
<node id='3' lat='35.68' lon='139.76' x='0' y='4'/><node id='4' lat='35.68' lon='139.76' x='300' y='4'/>
<way id='11'><nd ref='1'/><nd ref='2'/></way><way id='12'><nd ref='3'/><nd ref='4'/></way>
<relation id='21'><member type='way' ref='12' role='left'/><member type='way' ref='11' role='right'/><tag k='type' v='lanelet'/>
<tag k='speed_limit' v='50'/></relation>
<relation id='31'><member type='way' ref='12' role='left'/><member type='way' ref='11' role='right'/><tag k='type' v='lanelet'/>
<tag k='subtype' v='walkway'/></relation>
<relation id='32'><member type='way' ref='12' role='left'/><member type='way' ref='11' role='right'/><tag k='type' v='lanelet'/>
<tag k='subtype' v='walkway'/></relation>
</osm>";

#[test]
fn check_and_run_name_what_traffic_does_not_use_and_the_driving_side() {
    let folder = Folder::new().with("m.osm", IN_JAPAN);
    let unused = "lanelet 31 (line 6): lanelets of the subtype walkway, 2 in all: no vehicle may drive there, and there are no \
                  pedestrians, bicycles or trains; add participant:vehicle=yes if vehicles drive there\n";
    let side = "driving side: the map seems to lie in Japan (an estimate), where traffic drives on the left";
    let text = folder.laneweave("check m.osm").text();
    assert!(text.contains(&format!("\n  {unused}")) && text.contains(&format!("\n  {side}")), "{text}");
    let told = folder.laneweave("run m.osm --duration 1 --record 0 --demand 100").errors();
    for problem in [unused, side] {
        assert_eq!(told.matches(&format!("warning: map: {problem}")).count(), 1, "{told}");
    }
    let chosen = folder.laneweave("run m.osm --duration 1 --record 0 --demand 100 --driving-side left");
    assert_eq!((chosen.code(), chosen.errors().contains("driving side")), (0, false), "{}", chosen.errors());
    for side in ["left", "right"] {
        let report = answer(&folder, &format!("check m.osm --json --driving-side {side}"));
        assert_eq!((&report["driving_side"], list_of(&report["problems"])), (&json!(side), 1));
    }
    assert!(refusal(&folder, "check m.osm --driving-side middle").contains("[possible values: left, right]"));
}

fn list_of(it: &Value) -> usize {
    it.as_array().map_or(0, Vec::len)
}

#[test]
fn compressed_maps_are_maps() {
    let text = fs::read(maps().join("on_ramp.osm")).unwrap();
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(&text).unwrap();
    let packed = packed.finish().unwrap();
    let folder = Folder::new();
    fs::write(folder.path().join("m.osm.gz"), &packed).unwrap();
    fs::write(folder.path().join("half.osm.gz"), &packed[..packed.len() / 2]).unwrap();
    assert_eq!(answer(&folder, "check m.osm.gz --json"), answer(&folder, "check MAPS/on_ramp.osm --json"));
    assert!(
        refusal(&folder, "check half.osm.gz").starts_with("error: half.osm.gz: the file cannot be unpacked")
    );
}

#[test]
fn a_map_whose_lanelets_lack_borders_says_that_first() {
    let whole = fs::read_to_string(maps().join("motorway_2_lanes.osm")).unwrap();
    let parts: Vec<&str> = whole.split("role=\"left\"").collect();
    let lanelets = parts.len() - 1;
    // Every second way with the role left gets another role.
    let roles = parts.iter().enumerate().skip(1).map(|(number, part)| {
        let role = if number % 2 == 0 { "centerline" } else { "left" };
        format!("role=\"{role}\"{part}")
    });
    let half = parts[0].to_owned() + &roles.collect::<String>();
    let folder = Folder::new().with("half.osm", &half);
    let lacking = lanelets / 2;
    let first = format!(
        "{} of {lanelets} lanelets have no left or right border, so they are left out; export the map again, with a way in the role \
         left and one in the role right of each lanelet",
        lacking
    );
    let text = folder.laneweave("check half.osm").text();
    assert!(text.starts_with(&format!("{first}.\n")), "{text}");
    assert!(
        text.contains(&format!("\nProblems ({}; --json lists all):\n  borders: {first}\n", 2 + lacking)),
        "{text}"
    );
    let unused = format!(
        "lanelets with a member in the role centerline, {lacking} in all: the centre line is computed"
    );
    assert!(text.contains(&unused), "{text}");
    let told = folder.laneweave("run half.osm --duration 1").errors();
    assert!(told.starts_with(&format!("warning: map: borders: {first}\n")), "{told}");

    let folder = Folder::new().with("none.osm", &whole.replace("role=\"left\"", "role=\"centerline\""));
    let told = refusal(&folder, "run none.osm");
    assert!(
        told.contains(&format!(
            "(the first problem is borders: {lanelets} of {lanelets} lanelets have no left"
        )),
        "{told}"
    );
    assert!(told.ends_with("); add borders to them, or choose another map"), "{told}");
}

#[test]
fn a_map_larger_than_its_limit_is_refused_before_it_is_in_memory() {
    // A hundred megabytes of spaces, compressed to a thousandth.
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    let blank = vec![b' '; 1 << 20];
    (0..100).for_each(|_| packed.write_all(&blank).unwrap());
    let packed = packed.finish().unwrap();
    assert!(packed.len() < 1_000_000);
    let folder = Folder::new().with("s.toml", "map = \"bomb.osm.gz\"\nmap_options.max_size_mb = 20");
    fs::write(folder.path().join("bomb.osm.gz"), packed).unwrap();
    let expected = |limit| {
        format!(
            "error: bomb.osm.gz: the map is larger than the limit of {limit}; split the map into smaller ones, or increase \
             --max-map-size, at most 2GiB"
        )
    };
    for command in ["check", "run", "compare", "scenario new"] {
        let line = format!("{command} bomb.osm.gz --max-map-size 99MB");
        assert_eq!(refusal(&folder, &line), expected("99 MB"), "{command}");
    }
    assert_eq!(refusal(&folder, "routes bomb.osm.gz 1 2 --max-map-size 64kib"), expected("64 KiB"));
    assert_eq!(refusal(&folder, "run s.toml"), expected("20 MB"));
    assert!(refusal(&folder, "check bomb.osm.gz --max-map-size 105MB").contains("bomb.osm.gz:1: "));
    assert!(
        refusal(&folder, "check MAPS/town.osm --max-map-size 10kB")
            .contains("larger than the limit of 10 kB")
    );
    assert!(
        refusal(&folder, "check MAPS/town.osm --max-map-size 3GiB")
            .contains("write a size such as 500MB, at most 2GiB")
    );
}

#[test]
fn a_limit_of_the_map_changes_nothing_else() {
    let folder = Folder::new();
    let usual = folder.summary("MAPS/on_ramp.osm --duration 10 --record 0");
    let limited = folder.summary("MAPS/on_ramp.osm --duration 10 --record 0 --max-map-size 2GiB");
    assert_eq!(limited["fingerprint"], usual["fingerprint"]);
}

#[test]
fn the_origin_moves_a_projected_map() {
    let mut map = String::from("<osm>");
    for (id, lat, lon) in [(1, 49.0, 8.44), (2, 49.0, 8.45), (3, 49.0001, 8.44), (4, 49.0001, 8.45)] {
        map += &format!("<node id='{id}' lat='{lat}' lon='{lon}'/>");
    }
    map += "<way id='5'><nd ref='1'/><nd ref='2'/></way><way id='6'><nd ref='3'/><nd ref='4'/></way>
        <relation id='7'><member type='way' ref='6' role='left'/><member type='way' ref='5' role='right'/>
        <tag k='type' v='lanelet'/><tag k='subtype' v='highway'/></relation></osm>";
    let folder = Folder::new().with("m.osm", &map);
    assert_eq!(answer(&folder, "check m.osm --json")["origin"], json!([49.0, 8.4]));
    let other = answer(&folder, "check m.osm --json --origin 49.5,-8 --law usa");
    assert_eq!(other["origin"], json!([49.5, -8.0]));
    assert_eq!(other["speed_limits_kmh"], json!([112.7, 112.7]));
    assert_eq!(
        refusal(&folder, "check m.osm --origin 95,8"),
        "error: --origin: the origin (95, 8) is not a latitude within ±84° and a longitude within ±180°; correct it"
    );
    assert!(refusal(&folder, "check m.osm --origin 49").contains("write LAT,LON, such as 49,8.4"));
    assert!(refusal(&folder, "check m.osm --law mars").contains("[possible values: germany, usa]"));
}

#[test]
fn a_recording_needs_its_map() {
    let rows: String =
        (1..=50).map(|i| format!("1,{i},{}00,car,{},5.2,20,0,0,4.5,1.8\n", i, 100 + 2 * i)).collect();
    let header = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n";
    let folder = Folder::new().with("t.csv", &format!("{header}{rows}")).with("u.csv", "track_id,x\n1,2\n");
    let report = answer(&folder, "check t.csv --map MAPS/motorway_2_lanes.osm --json");
    assert_eq!(
        (&report["tracks"]["car"], &report["states"], &report["unmatched"]),
        (&1.into(), &50.into(), &0.into())
    );
    assert_eq!(report["lane_changes"].as_array().unwrap().len(), 0);
    let text = folder.laneweave("check t.csv --map MAPS/motorway_2_lanes.osm").text();
    assert!(text.ends_with("\nNo lane changes.\n"), "{text}");
    assert_eq!(
        refusal(&folder, "check t.csv"),
        "error: t.csv: a recording needs the map of its location; add --map MAP"
    );
    assert!(
        refusal(&folder, "check u.csv --map MAPS/ramps.osm").starts_with("error: u.csv: line 1: the column")
    );
    assert!(
        refusal(&folder, "check none.csv --map MAPS/ramps.osm")
            .starts_with("error: none.csv: cannot be read")
    );
    assert!(refusal(&folder, "check t.csv --map t.csv").contains("known are Lanelet2"));
}

#[test]
fn routes_lead_from_lanelet_to_lanelet() {
    let folder = Folder::new();
    let found = answer(&folder, "routes MAPS/motorway_3_lanes.osm 1 75 --json");
    let way = &found["routes"][0];
    assert_eq!((found["routes"].as_array().unwrap().len(), &way["lane_changes"]), (1, &2.into()));
    assert!((way["length_m"].as_f64().unwrap() - 5000.0).abs() < 1e-6);
    assert!((way["free_travel_time_s"].as_f64().unwrap() - 150.0).abs() < 1e-6);
    assert_eq!(way["lanelets"].as_array().unwrap().len(), 27);
    let none = folder.laneweave("routes MAPS/motorway_3_lanes.osm 75 1");
    assert_eq!(none.code(), 0);
    assert!(none.text().starts_with("No route leads from lanelet 75 to lanelet 1"));
    assert_eq!(
        refusal(&folder, "routes MAPS/motorway_3_lanes.osm 1 76"),
        "error: TO: this map has no lanelet 76 for vehicles; did you mean \"75\"?"
    );
}
