//! Clients that are broken, greedy or slow are cut off, and nobody else notices.

use std::io::Write;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use laneweave_viewer::Asked;
use tungstenite::Message;

use crate::served::client::{PATIENCE, Page, live, raw, server};

/// A small generator of numbers (xorshift), so that a failure can be repeated.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }
}

/// Messages of a page, as a start.
const GOOD: [&str; 14] = [
    r#"{"ready":1}"#,
    r#"{"view":[0,0,100,100]}"#,
    r#"{"play":1}"#,
    r#"{"pause":true}"#,
    r#"{"step":1}"#,
    r#"{"seek":12.5}"#,
    r#"{"select":["1","2"]}"#,
    r#"{"find":"12"}"#,
    r#"{"colour":"desire"}"#,
    r#"{"lanes":true}"#,
    r#"{"hand":{"set_parameter":{"style":"aggressive","parameter":"change.theta","value":1}}}"#,
    r#"{"hand":{"put":{"x":0,"y":0,"class":"car"}}}"#,
    r#"{"hand":{"drive":{"vehicle":"1","speed_kmh":50,"side":"left"}}}"#,
    r#"{"undo":true}"#,
];

/// A message with some of its bytes changed, left out or repeated.
fn broken(numbers: &mut Numbers) -> String {
    let mut bytes = GOOD[numbers.below(GOOD.len())].as_bytes().to_vec();
    for _ in 0..numbers.below(4) {
        let at = numbers.below(bytes.len());
        match numbers.below(5) {
            0 => bytes[at] = b' ' + numbers.below(95) as u8,
            1 => drop(bytes.remove(at)),
            2 => bytes.insert(at, b"{}[]\",:0-e"[numbers.below(10)]),
            3 => bytes.truncate(at.max(1)),
            _ => bytes.extend_from_slice(b"999999999999"),
        }
        if bytes.is_empty() {
            bytes.push(b'0');
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn a_hundred_thousand_broken_messages_do_no_harm() {
    /// Messages in all, and at once.
    const ALL: usize = 100_000;
    const AT_ONCE: usize = 100;
    let (server, token) = server(live("ramps.osm"));
    let mut numbers = Numbers(2026);
    let mut sent = 0;
    while sent < ALL {
        let mut page = Page::of(&server, &token);
        for _ in 0..AT_ONCE {
            sent += 1;
            if !page.say(&broken(&mut numbers)) {
                break;
            }
        }
    }
    // It still serves a page that behaves, as soon as those that are gone have left some work to it.
    let begin = Instant::now();
    loop {
        let mut page = Page::of(&server, &token);
        if page.hears("hello").is_some_and(|it| it.contains("\"kind\":\"live\"")) && page.frame().is_some() {
            return;
        }
        assert!(begin.elapsed() < PATIENCE, "no page is welcome");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_message_that_is_wrong_ends_the_connection_with_a_reason() {
    let (server, token) = server(live("ramps.osm"));
    let end = |text: &str| {
        let mut page = Page::of(&server, &token);
        page.say(text);
        page.end()
    };
    assert!(end("{\"play\":0}").expect("a reason").contains("a factor is 0.1 to 1000"));
    assert!(end("no message").expect("a reason").contains("expected"));
    // Too long ones are not even read.
    end(&" ".repeat(4097));
    end(&" ".repeat(1 << 20));
}

#[test]
fn a_flood_ends_the_connection() {
    let (server, token) = server(live("ramps.osm"));
    let mut page = Page::of(&server, &token);
    assert!((0..10_000_000).any(|_| !page.say("{\"lanes\":false}")), "it is never too much");
    assert!(page.end().is_none_or(|it| it == "too much work at once"));
    // Another page is served all the same.
    let mut other = Page::of(&server, &token);
    assert!(other.frame().is_some());
}

#[test]
fn a_few_messages_that_ask_for_much_are_a_flood_too() {
    let (server, token) = server(live("ramps.osm"));
    let mut page = Page::of(&server, &token);
    // Some of them it cannot even say.
    let said = (0..50).filter(|_| page.say("{\"step\":100}")).count();
    assert!(said > 0 && page.end().is_none_or(|it| it == "too much work at once"));
}

#[test]
fn connections_without_the_token_take_no_room_from_those_with_it() {
    let (server, token) = server(live("ramps.osm"));
    let idle = || TcpStream::connect(server.address().to_string()).expect("a connection");
    let mut strangers: Vec<TcpStream> = (0..200).map(|_| idle()).collect();
    for stranger in &mut strangers {
        // It may be sent away already.
        let _ = stranger.write_all(b"GET / HTTP/1.1\r\nHost: ");
    }
    let mut page = Page::try_of(&server, &token).expect("room for a page");
    // It stays, however many more there come.
    strangers.extend((0..200).map(|_| idle()));
    assert!(page.frame().is_some());
}

#[test]
fn slow_and_large_requests_are_cut_off() {
    let (server, _) = server(live("ramps.osm"));
    assert_eq!(raw(&server, b"GET / HTTP/1.1\r\nHost: "), "");
    let large = format!("GET / HTTP/1.1\r\nX: {}\r\n\r\n", "x".repeat(1 << 20));
    assert!(!raw(&server, large.as_bytes()).contains("200 OK"));
}

#[test]
fn more_pages_than_there_is_room_for_are_turned_away_until_one_leaves() {
    let (server, token) = server(live("ramps.osm"));
    let mut pages: Vec<Page> = (0..16).map(|_| Page::of(&server, &token)).collect();
    assert!(Page::try_of(&server, &token).is_none());
    drop(pages.pop());
    let begin = Instant::now();
    let comes = || (begin.elapsed() < PATIENCE).then(|| Page::try_of(&server, &token));
    let found = std::iter::from_fn(comes).flatten().next();
    assert!(found.is_some());
}

#[test]
fn a_page_that_draws_nothing_is_told_nothing_and_stays() {
    let (server, token) = server(live("ramps.osm"));
    let mut page = Page::of(&server, &token);
    page.hear_of("twin");
    server.ask(Asked::Play(None));
    let wait = |time_s: f64| while server.state().expect("a stage").0 < time_s {};
    wait(300.0);
    // Nothing of these five minutes waits for it, and it is still connected.
    page.say("{\"find\":\"4000000000\"}");
    let Some(Message::Text(next)) = page.hear() else { panic!("a text") };
    assert_eq!(next.as_str(), "{\"found\":{\"id\":\"4000000000\"}}");
    // It is ready: what it is told of is a minute old at most, and it is told once.
    page.say("{\"ready\":0}");
    let times = |text: &str| -> Vec<f64> {
        let after = text.split("\"time_s\":").skip(1).filter_map(|it| it.split(',').next());
        after.map(|it| it.parse().expect("a time")).collect()
    };
    let first = times(&page.hear_of("events"));
    let (oldest, newest) = (first[0], first[first.len() - 1]);
    assert!(oldest > 60.0 && newest - oldest <= 60.0 + 1e-9, "{first:?}");
    wait(newest + 120.0);
    page.say("{\"ready\":0}");
    assert!(times(&page.hear_of("events"))[0] > newest);
}
