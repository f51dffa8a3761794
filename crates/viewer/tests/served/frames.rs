//! Frames and texts, as a page gets them.

use crate::client::{Page, live, server};

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
