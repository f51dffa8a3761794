//! A replay as one file: the page with the roads and all frames in it, which needs no server and no network.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use laneweave::Fault;
use serde::Serialize;

use crate::PAGE;
use crate::frame::{Slots, View};
use crate::scene::Scene;
use crate::snapshot::{Colour, Snapshot};
use crate::source::{Hello, Mark, Marks, Source, Wants};

/// What a browser lets the file do: use what is in it, and nothing else.
const POLICY: &str =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:";

/// What the page finds in itself.
#[derive(Serialize)]
struct Replay {
    scene: Scene,
    hello: Hello,
    frames: Frames,
    /// What the lights show from a time on [s], a letter for each: at every change.
    lights: Vec<(f64, String)>,
    marks: Marks,
    events: Vec<Mark>,
}

#[derive(Serialize)]
struct Frames {
    encoding: &'static str,
    data: String,
}

/// The page that plays `source` from now to its end, with a frame every `every_s` [s]. `look` is told the time of each
/// frame [s].
///
/// # Errors
/// If the source has no end, or nothing is left of it.
pub fn export(source: &mut dyn Source, every_s: f64, mut look: impl FnMut(f64)) -> Result<String, Fault> {
    let scene = source.scene();
    let hello = source.hello();
    if hello.end_s.is_none() {
        let remedy = "run it, and export the folder of its results";
        return Err(Fault::new("export", "a simulation that runs now has no end", remedy));
    }
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::best());
    let (mut slots, mut marks, mut lights) = (Slots::default(), Marks::default(), Vec::new());
    let every = (every_s / source.step_s()).round().max(1.0) as u32;
    let mut number = 0;
    loop {
        let mut snapshot = Snapshot { number, ..Snapshot::default() };
        source.see(&Wants::default(), &mut snapshot);
        look(snapshot.time_s);
        let shown = snapshot.lights_in_letters();
        if lights.last().is_none_or(|(_, before)| *before != shown) {
            lights.push((snapshot.time_s, shown));
        }
        let frame = slots.frame(&snapshot, scene.origin, View::ALL, Colour::Style);
        // Writing to memory never fails.
        let _ = packed.write_all(&(frame.len() as u32).to_le_bytes());
        let _ = packed.write_all(&frame);
        number += 1;
        if source.has_ended() {
            break;
        }
        for _ in 0..every {
            source.step(&mut marks.marks)?;
        }
    }
    marks.until_s = source.time_s();
    let packed = packed.finish().map_err(|error| Fault::bug("export", error))?;
    let frames = Frames { encoding: "deflate-base64", data: STANDARD.encode(packed) };
    let replay = Replay { scene, hello, frames, lights, marks, events: Vec::new() };
    let json = serde_json::to_string(&replay).map_err(|error| Fault::bug("export", error))?;
    Ok(with_replay(PAGE, &json))
}

/// The page with the replay in it.
fn with_replay(page: &str, replay: &str) -> String {
    // In JSON "\u003c" is "<", which could end the element early.
    let replay = replay.replace('<', "\\u003c");
    let head = format!("<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">");
    let (page, end) = page.split_at(page.rfind("</body>").unwrap_or(page.len()));
    let page = page.replacen("<head>", &head, 1);
    format!("{page}<script id=\"replay\" type=\"application/json\">{replay}</script>\n{end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_replay_goes_into_the_page_and_can_neither_end_its_element_nor_ask_for_other_files() {
        let page =
            "<html>\n<head>\n<script>say('<head></body>')</script>\n</head>\n<body>\n</body>\n</html>\n";
        let file = with_replay(page, "{\"title\":\"</SCRIPT><!--<script>\"}");
        assert_eq!(
            file.replace(POLICY, "…"),
            "<html>\n<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"…\">\n\
             <script>say('<head></body>')</script>\n</head>\n<body>\n\
             <script id=\"replay\" type=\"application/json\">\
             {\"title\":\"\\u003c/SCRIPT>\\u003c!--\\u003cscript>\"}</script>\n</body>\n</html>\n"
        );
    }
}
