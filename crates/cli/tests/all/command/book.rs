//! The README and the book: their commands work, their shown output is the real one, and their figures are those of
//! the program.

use std::fs;
use std::path::{Path, PathBuf};

use crate::command::golden::assert_golden;
use laneweave_test_data::{data, size};

use crate::command::program::{Folder, at_home, maps, without_first_duration};

/// What a fit would leave.
const STYLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../styles/conservative.toml");

/// Files of the reader, each with a replacement of the real data.
const THE_READERS: [(&str, &str); 4] = [
    ("my-map.osm", "lanelet2/town10.osm"),
    ("map.osm", "recordings/mona_east/map.osm"),
    ("tracks.csv", "recordings/mona_east/vehicle_tracks_000.csv"),
    ("USA_US101-1_1_T-1.xml", "recordings/ngsim_commonroad/USA_US101-1_1_T-1.xml"),
];

fn home() -> PathBuf {
    maps().join("..")
}

/// The README and all pages of the book.
fn pages() -> Vec<PathBuf> {
    let book = home().join("docs/src");
    let mut pages = vec![home().join("README.md")];
    for folder in [book.clone(), book.join("how-to"), book.join("reference")] {
        let files = fs::read_dir(folder).unwrap().map(|it| it.unwrap().path());
        // This one has a test of its own, which runs its fit.
        let is_page = |it: &PathBuf| {
            it.extension().is_some_and(|it| it == "md") && !it.ends_with("from-a-recording.md")
        };
        pages.extend(files.filter(is_page));
    }
    pages.sort();
    assert!(pages.len() > 15, "{pages:?}");
    pages
}

/// Commands of one block, and the text that follows them: what they print.
struct Example {
    commands: Vec<String>,
    shown: Option<String>,
}

/// The examples of a page, without the name of the program.
fn examples(page: &Path) -> Vec<Example> {
    let text = fs::read_to_string(page).unwrap().replace("\\\n", " ");
    let mut parts = text.split("```");
    let mut examples: Vec<Example> = Vec::new();
    // Prose and blocks alternate.
    while let (Some(_), Some(block)) = (parts.next(), parts.next()) {
        let (kind, body) = block.split_once('\n').unwrap_or_default();
        if kind == "sh" {
            let lines = body.lines().filter_map(|it| it.trim_start().strip_prefix("laneweave "));
            let commands = lines.map(|it| it.split("  #").next().unwrap().trim().to_owned()).collect();
            examples.push(Example { commands, shown: None });
        } else if kind.is_empty()
            && let Some(last) = examples.last_mut()
        {
            last.shown.get_or_insert_with(|| body.to_owned());
        }
    }
    examples.retain(|it| !it.commands.is_empty());
    examples
}

/// The command in the form that the test runs: without the shell, and with a short duration if nothing depends on its
/// results.
fn shortened(command: &str, is_asked_about: bool) -> String {
    let line = command.split(" > ").next().unwrap().replace("~/", "home/").replace("$seed", "1");
    let is_short = is_asked_about || line.contains("--resume");
    match line.split_whitespace().next() {
        Some("run") if is_short => line,
        Some("run") => {
            without_first_duration(&format!("{line} --duration 2")).replace("--warmup 240", "--warmup 0")
        }
        Some("compare") => {
            let line = ["5", "10"]
                .iter()
                .fold(line, |it, seeds| it.replace(&format!("--seeds {seeds}"), "--seeds 2"));
            without_first_duration(&format!("{line} --duration 2"))
        }
        // What is done with ten minutes of a recording takes minutes.
        Some("observe") if !line.contains("--until") => format!("{line}{}", size().pick(" --until 120", "")),
        // Experiments take minutes: the arguments are read, and nothing runs.
        Some("reproduce") => format!("{line} --help"),
        // It ends when the user says so, and has tests of its own.
        Some("view") => format!("{line} --help"),
        // Fits take a minute, and have tests of their own: only what a recording can tell is asked.
        Some("fit") if !line.contains("--plan") => format!("{line} --plan"),
        _ => line,
    }
}

/// A folder with the maps, the scenarios and the reader's files; and the names of missing ones.
fn readers() -> (Folder, Vec<&'static str>) {
    let folder = at_home();
    let mut missing = Vec::new();
    for (name, ours) in THE_READERS {
        match data(ours) {
            Some(ours) => drop(fs::copy(ours, folder.path().join(name)).expect("a copy")),
            None => missing.push(name),
        }
    }
    // What a fit that is not run would leave.
    let fitted = folder.path().join("fit");
    fs::create_dir(&fitted)
        .and_then(|()| fs::copy(Path::new(STYLE), fitted.join("fitted.toml")))
        .expect("a copy");
    let made = folder.laneweave("scenario new maps/ramps.osm --out my-scenario.toml");
    assert_eq!(made.code(), 0, "{}", made.errors());
    (folder, missing)
}

#[test]
fn every_command_works_and_prints_what_is_shown() {
    let (mut run, mut shown) = (0, 0);
    for page in pages() {
        let examples = examples(&page);
        let is_asked_about = |it: &Example| it.commands.iter().any(|it| it.contains(" out --"));
        let is_asked_about = examples.iter().any(is_asked_about);
        let (folder, missing) = readers();
        for example in examples {
            let mut printed = String::new();
            for command in &example.commands {
                if missing.iter().any(|it| command.split_whitespace().any(|word| word == *it)) {
                    continue;
                }
                let line = shortened(command, is_asked_about && !command.contains("36000"));
                let outcome = folder.laneweave(&line);
                let errors = outcome.errors();
                // Remarks apply to any map; the run that is resumed here was not killed.
                let is_demand =
                    |it: &str| it.contains("demand: ") && it.contains(" % of the estimated capacity of ");
                let is_expected = |it: &str| {
                    it.starts_with("warning: ")
                        || is_demand(it)
                        || it.ends_with("the run is already complete")
                };
                let is_quiet = errors.lines().all(is_expected);
                assert!(outcome.code() == 0 && is_quiet, "{}: laneweave {line}: {errors}", page.display());
                printed = outcome.text();
                run += 1;
            }
            // Shortened runs have other figures.
            let last = example.commands.last().map(String::as_str).unwrap_or_default();
            if let Some(text) =
                example.shown.filter(|_| last.starts_with("explain") || last.starts_with("branch"))
            {
                shown += 1;
                for line in text.lines().filter(|it| !it.trim().is_empty() && it.trim() != "…") {
                    assert!(
                        printed.lines().any(|it| it.trim_end() == line.trim_end()),
                        "{}: laneweave {last} does not print: {line}\nbut: {printed}",
                        page.display()
                    );
                }
            }
        }
    }
    assert!(run > 40 && shown >= 2, "{run} commands, {shown} with what they print");
}

/// Each figure of the book with its command, and the path of its output.
const FIGURES: [(&str, &str, &str); 7] = [
    ("karlsruhe", "check DATA/lanelet2/karlsruhe.osm --svg map.svg", "map.svg"),
    ("tianjin", "check DATA/lanelet2/tianjin.osm --svg map.svg", "map.svg"),
    ("town10", "check DATA/lanelet2/town10.osm --svg map.svg", "map.svg"),
    ("approach", "check maps/approach.osm --svg map.svg", "map.svg"),
    ("own_town", "check maps/town.osm --svg map.svg", "map.svg"),
    ("time_space", "run maps/ramps.osm --demand 4000 --record 0", "out/time_space.svg"),
    ("lane_change_rate", "run maps/ramps.osm --demand 4000 --record 0", "out/lane_change_rate.svg"),
];

#[test]
fn figures_are_what_their_commands_draw() {
    let images = home().join("docs/src/images");
    let mut names: Vec<String> = fs::read_dir(&images)
        .unwrap()
        .map(|it| it.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let mut known = FIGURES.map(|(name, ..)| name);
    known.sort_unstable();
    assert_eq!(names, known, "every figure has its command here");
    for (name, command, file) in FIGURES {
        let input = command.split_whitespace().nth(1).unwrap();
        let line = match input.strip_prefix("DATA/").map(data) {
            Some(None) => continue,
            Some(Some(path)) => command.replace(input, path.to_str().unwrap()),
            None => command.to_owned(),
        };
        let folder = at_home();
        let run = folder.laneweave(&line);
        assert_eq!(run.code(), 0, "{command}: {}", run.errors());
        assert_golden(&images.join(format!("{name}.svg")), &folder.read(file));
    }
}
