//! How fast maps are read, and how much memory this takes.
//!
//! `cargo run --release -p laneweave-bench --bin maps -- MAP.osm [MB]` reads the map unchanged, and then tiled to
//! this size: copies of it, side by side, with ids of their own.

use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

use laneweave::maps::{ReadOptions, lanelet2, load};
use laneweave_bench::say;

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Distance between copies [°], and between those of metric coordinates [m].
const SPACING: (f64, f64) = (0.05, 5000.0);
/// Repetitions of reading a small map.
const TIMES: u32 = 20;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("name a map: … --bin maps -- MAP.osm [MB]")?;
    let text = std::fs::read_to_string(path)?;
    measure("as it is", &text, TIMES)?;
    if let Some(megabytes) = arguments.next() {
        let text = tiled(&text, (megabytes.parse::<f64>()? * 1e6) as usize);
        measure("tiled", &text, 1)?;
        measure_file(text)?;
    }
    Ok(())
}

fn measure(name: &str, text: &str, times: u32) -> Result<(), Box<dyn Error>> {
    let before = resident_mb("VmRSS:");
    let (mut elements, mut network) = (f64::INFINITY, f64::INFINITY);
    let mut found = String::new();
    for _ in 0..times {
        let start = Instant::now();
        let (document, problems) = lanelet2::Document::parse(text.as_bytes())?;
        let parsed = start.elapsed().as_secs_f64();
        let map = document.map(problems, &ReadOptions::default())?;
        let all = start.elapsed().as_secs_f64();
        (elements, network) = (elements.min(parsed), network.min(all - parsed));
        let conflicts: usize = map.graph.conflicting.iter().map(Vec::len).sum();
        found = format!("{} lanelets, {} conflicts", map.network.lanelets.len(), conflicts / 2);
    }
    let megabytes = text.len() as f64 / 1e6;
    let memory = resident_mb("VmHWM:") - before;
    say(&format!(
        "{name}: {megabytes:.1} MB, {found}: elements {elements:.4} s, graph {network:.4} s: {:.0} MB/s, {memory:.0} MB more \
         memory at most",
        megabytes / (elements + network)
    ));
    Ok(())
}

/// Reads the text from a file, as the command does.
fn measure_file(text: String) -> Result<(), Box<dyn Error>> {
    let file = std::env::temp_dir().join(format!("laneweave-bench-{}.osm", std::process::id()));
    std::fs::write(&file, &text)?;
    let megabytes = text.len() as f64 / 1e6;
    drop(text);
    let start = Instant::now();
    let map = load(&file, &ReadOptions::default());
    let seconds = start.elapsed().as_secs_f64();
    std::fs::remove_file(&file)?;
    let lanelets = map?.network.lanelets.len();
    say(&format!("from a file: {lanelets} lanelets in {seconds:.2} s: {:.0} MB/s", megabytes / seconds));
    Ok(())
}

/// A map of about `size` bytes made of copies of this one.
fn tiled(text: &str, size: usize) -> String {
    let from = ["<MetaInfo", "<node"].iter().filter_map(|it| text.find(it)).min().unwrap_or(0);
    let to = text.rfind("</osm>").unwrap_or(text.len());
    let body = &text[from..to];
    let copies = size.div_ceil(body.len().max(1));
    let across = (copies as f64).sqrt().ceil() as usize;
    let mut out = String::with_capacity(size + 2 * body.len());
    out.push_str(&text[..from]);
    for copy in 0..copies {
        // Ids of copies are longer than those of the original.
        if out.len() + body.len() / 2 > size {
            break;
        }
        write_copy(&mut out, body, copy as i64, [(copy / across) as f64, (copy % across) as f64]);
    }
    out.push_str("</osm>\n");
    out
}

/// Writes `body` with other ids, moved by `tile` tiles to the north and to the east.
fn write_copy(out: &mut String, body: &str, number: i64, tile: [f64; 2]) {
    let mut rest = body;
    let mut name = "";
    // Every second part is the value of an attribute, in quotes of one kind or the other.
    while let Some(begin) = rest.find(['"', '\'']) {
        let quote = &rest[begin..=begin];
        let Some(length) = rest[begin + 1..].find(quote) else { break };
        let (before, value) = (&rest[..=begin], &rest[begin + 1..begin + 1 + length]);
        let key = before.trim_end_matches(['=', '"', '\'']).rsplit([' ', '\n']).next().unwrap_or_default();
        out.push_str(before);
        let moved = match (key, name) {
            ("lat", _) => Some((0, SPACING.0)),
            ("lon", _) => Some((1, SPACING.0)),
            ("v", "local_x") => Some((1, SPACING.1)),
            ("v", "local_y") => Some((0, SPACING.1)),
            _ => None,
        };
        // Writing to a string never fails.
        let _ = match (moved, value.parse::<f64>(), value.parse::<i64>()) {
            (Some((axis, spacing)), Ok(place), _) => write!(out, "{:.11}", place + spacing * tile[axis]),
            (_, _, Ok(id)) if matches!(key, "id" | "ref") => write!(out, "{}", id ^ (number << 40)),
            _ => write!(out, "{value}"),
        };
        out.push_str(quote);
        name = if key == "k" { value } else { "" };
        rest = &rest[begin + 2 + length..];
    }
    out.push_str(rest);
}

/// Memory of the process that the system reports under `key` [MB]; 0 where it does not.
fn resident_mb(key: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(key));
    let kilobytes = line.and_then(|it| it.trim().trim_end_matches(" kB").parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}
