//! Frames and texts, as a page gets them.

use laneweave::Simulation;
use laneweave::scenario::Origin;
use laneweave_test_data::map;
use laneweave_viewer::Live;

use crate::served::client::{Page, live, server};

fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

#[test]
fn a_page_sees_the_vehicles_and_is_told_of_the_one_that_it_selects() {
    let (server, token) = server(live("ramps.osm"));
    let mut page = Page::of(&server, &token);
    let hello = page.hear_of("hello");
    assert!(hello.contains("\"hands\":true") && hello.contains("change.courtesy.weight"), "{hello}");
    page.say("{\"step\":100}");
    page.say("{\"step\":100}");
    let mut frame = page.frame().expect("a frame");
    while word(&frame, 40) < 3 {
        frame = page.frame().expect("a frame");
    }
    let (count, entered) = (word(&frame, 40) as usize, word(&frame, 44) as usize);
    assert_eq!(frame.len(), 48 + 16 * (count + entered));
    assert_eq!(count, entered, "all of them are new");
    let record = &frame[48 + 16 * count..];
    let id = i64::from_le_bytes(record[4..12].try_into().expect("eight bytes"));
    page.say(&format!("{{\"select\":[\"{id}\"]}}"));
    page.say("{\"step\":1}");
    page.say("{\"ready\":0}");
    let told = page.hear_of("drivers");
    assert!(told.contains(&format!("\"id\":\"{id}\"")) && told.contains("\"story\":\"vehicle"), "{told}");
    page.say(&format!("{{\"find\":\"{id}\"}}"));
    assert!(page.hear_of("found").contains("\"x\":"));
    page.say("{\"find\":\"4000000000\"}");
    assert_eq!(page.hear_of("found"), "{\"found\":{\"id\":\"4000000000\"}}");
}

#[test]
fn what_is_done_by_hand_is_told_and_what_is_not_possible_refused() {
    let (server, token) = server(live("ramps.osm"));
    let mut page = Page::of(&server, &token);
    page.hear_of("hands");
    page.say(r#"{"hand":{"set_parameter":{"style":"aggressive","parameter":"change.theta","value":0.5}}}"#);
    let done = page.hear_of("hands");
    assert!(done.contains("change.theta of aggressive") && done.contains("to 0.5"), "{done}");
    page.say("{\"undo\":true}");
    assert!(page.hear_of("hands").contains("\"is_undone\":true"));
    page.say("{\"undo\":true}");
    assert!(page.hear_of("refused").contains("nothing was done by hand"));
    page.say(r#"{"hand":{"set_demand":{"origin":"77","vehicles_per_hour":100}}}"#);
    let refused = page.hear_of("refused");
    assert!(refused.contains("77") && refused.contains("\"remedy\":"), "{refused}");
    page.say("{\"seek\":10}");
    assert!(page.hear_of("refused").contains("no other times"));
}

#[test]
fn while_time_stands_a_page_that_looks_elsewhere_sees_what_is_there() {
    let (server, token) = server(live("ramps.osm"));
    let mut page = Page::of(&server, &token);
    (0..4).for_each(|_| assert!(page.say("{\"step\":100}")));
    page.say("{\"view\":[1000000,1000000,1000001,1000001]}");
    while server.state().expect("a stage").0 < 39.9 {}
    let vehicles = |page: &mut Page| word(&page.frame().expect("a frame"), 40);
    assert_eq!(vehicles(&mut page), 0);
    page.say("{\"view\":[-100000,-100000,100000,100000]}");
    let mut seen = vehicles(&mut page);
    // The last snapshot may still have been on its way.
    while seen == 0 {
        page.say("{\"view\":[-99999,-100000,100000,100000]}");
        seen = vehicles(&mut page);
    }
    assert!(seen > 3);
}

#[test]
fn what_is_done_while_time_stands_is_saved() {
    let dir = std::env::temp_dir().join(format!("laneweave-served-{}", std::process::id()));
    let (scenario, origin) = Origin::open(&map("ramps.osm")).expect("a map");
    let (server, token) = server(Live::new(&scenario, &origin, dir.clone()).expect("a simulation"));
    let mut page = Page::of(&server, &token);
    page.hear_of("twin");
    page.say("{\"step\":100}");
    page.say(r#"{"hand":{"set_parameter":{"style":"aggressive","parameter":"speed_factor","value":0.5}}}"#);
    page.hear_of("hands");
    page.say("{\"save\":true}");
    let saved = page.hear_of("saved");
    let folder: serde_json::Value = serde_json::from_str(&saved).expect("JSON");
    let file = folder["saved"]["scenario"].as_str().expect("a file").to_owned();
    let mut again = Simulation::from_file(&file).expect("the saved scenario");
    again.run(again.end_s()).expect("a run");
    let (time_s, hash) = server.state().expect("a stage");
    assert!((again.end_s() - time_s).abs() < 1e-6 && (time_s - 10.1).abs() < 1e-6);
    assert_eq!(again.state_hash(), hash);
    assert!(std::fs::read_to_string(dir.join("1/commands.csv")).expect("commands").contains("aggressive"));
    let _ = std::fs::remove_dir_all(dir);
}
