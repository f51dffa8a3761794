//! Watching changes nothing.

use laneweave_viewer::{Asked, Server};

use crate::served::client::{Page, live, server};

/// Steps that are simulated.
const STEPS: u32 = 300;

/// Lets the server simulate all steps while `between` does something; returns the time and the hash at the end.
fn driven(server: &Server, mut between: impl FnMut(u32)) -> (f64, u64) {
    for number in 0..STEPS / 10 {
        server.ask(Asked::Step(10));
        between(number);
    }
    server.state().expect("a state")
}

#[test]
fn pages_that_watch_stall_and_reload_change_no_bit() {
    let (alone, _) = server(live("ramps.osm"));
    let unseen = driven(&alone, |_| {});
    assert!((unseen.0 - f64::from(STEPS) * 0.1).abs() < 1e-6);

    let (one, token) = server(live("ramps.osm"));
    let mut page = Page::of(&one, &token);
    assert_eq!(driven(&one, |_| drop(page.frame())), unseen);

    let (three, token) = server(live("ramps.osm"));
    let mut watching = Page::of(&three, &token);
    // One says that it is ready, and never reads; one comes again and again.
    let mut stalled = Page::of(&three, &token);
    stalled.say("{\"ready\":0}");
    let seen = driven(&three, |_| {
        watching.frame();
        let mut reloading = Page::of(&three, &token);
        reloading.say("{\"select\":[\"1\",\"2\"]}");
        reloading.frame();
    });
    assert_eq!(seen, unseen);
}

#[test]
fn no_camera_and_no_colour_changes_a_bit() {
    let (alone, _) = server(live("town.osm"));
    let unseen = driven(&alone, |_| {});
    let (watched, token) = server(live("town.osm"));
    let mut pages: Vec<Page> = (0..3).map(|_| Page::of(&watched, &token)).collect();
    let mut number = 0_u32;
    // Twenty ways to look, of other places, sizes, colours and vehicles.
    let seen = driven(&watched, |turn| {
        for page in &mut pages {
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let (x, size) = (f64::from(number % 1000) - 500.0, f64::from(1 + turn % 20) * 40.0);
            page.say(&format!("{{\"view\":[{x},{x},{},{}]}}", x + size, x + size));
            let colour = ["style", "desire", "delay", "since_change"][number as usize % 4];
            page.say(&format!("{{\"colour\":\"{colour}\"}}"));
            page.say(&format!("{{\"select\":[\"{}\"]}}", number % 200));
            page.say(&format!("{{\"lanes\":{}}}", number.is_multiple_of(2)));
            page.frame();
        }
    });
    assert_eq!(seen, unseen);
}
