//! Only pages of the server get something, and only the page, the scene and the traffic.

use crate::served::client::{Page, live, raw, server};

fn status(answer: &str) -> &str {
    answer.split(' ').nth(1).unwrap_or("none")
}

#[test]
fn strangers_get_nothing() {
    let (server, token) = server(live("ramps.osm"));
    let port = server.address().port();
    let own = format!("127.0.0.1:{port}");
    let ask = |line: &str, host: &str, more: &str| {
        let request = format!("{line} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n");
        raw(&server, request.as_bytes())
    };
    let scene = format!("GET /scene.json?token={token}");
    let good = ask(&scene, &own, "");
    assert_eq!(status(&good), "200", "{good}");
    assert!(good.contains("\"lanelets\":[{") && good.contains("content-security-policy: default-src 'none'"));
    // A name that somebody else has made to lead here, and pages of others.
    assert_eq!(status(&ask(&scene, &format!("evil.example:{port}"), "")), "403");
    assert_eq!(status(&ask(&scene, "127.0.0.1:1", "")), "403");
    assert_eq!(status(&ask(&scene, &own, "Origin: http://evil.example\r\n")), "403");
    assert_eq!(status(&ask(&scene, &own, "Origin: null\r\n")), "403");
    // Without the token, or with another one.
    for token in ["", "?token=", "?token=0123456789abcdef0123456789abcdef"] {
        assert_eq!(status(&ask(&format!("GET /scene.json{token}"), &own, "")), "403");
        let upgrade = format!(
            "GET /live{token} HTTP/1.1\r\nHost: {own}\r\nUpgrade: websocket\r\nConnection: Upgrade, close\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        );
        assert_eq!(status(&raw(&server, upgrade.as_bytes())), "403");
    }
    // Nothing else is there, and nothing can be put there.
    for line in [
        "GET /../Cargo.toml",
        "GET /%2e%2e/Cargo.toml",
        "GET //etc/passwd",
        "GET /scene.json/../../x",
        "GET /scene",
    ] {
        assert_eq!(status(&ask(line, &own, "")), "404", "{line}");
    }
    assert_eq!(status(&ask(&scene.replace("GET", "HEAD"), &own, "")), "200");
    assert_eq!(status(&ask("HEAD /scene.json?token=wrong", &own, "")), "403");
    assert_eq!(status(&ask(&scene.replace("GET", "POST"), &own, "Content-Length: 0\r\n")), "403");
    assert!(Page::try_of(&server, "wrong").is_none());
}

#[test]
fn the_page_is_served_whole_with_its_script_and_asks_for_no_other_file() {
    let page = include_str!("../../../page/index.html");
    let (server, _) = server(live("ramps.osm"));
    let request = format!("GET / HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", server.address());
    let answer = raw(&server, request.as_bytes());
    let (head, body) = answer.split_once("\r\n\r\n").expect("a body");
    assert_eq!(status(head), "200", "{head}");
    assert!(head.contains("content-type: text/html; charset=utf-8"), "{head}");
    assert!(body == page, "{} bytes instead of {}", body.len(), page.len());
    let (before, script) = page.split_once("<script type=\"module\">").expect("a script");
    assert!(before.contains("content=\"script-src 'sha256-") && script.contains("/scene.json?token="));
    assert_eq!(page.matches("<script").count(), 1);
    let references = ["src=\"", "href=\"/", "href=\"http", "@import", "url("];
    assert_eq!(references.into_iter().find(|it| page.contains(it)), None);
}
