//! The report of a run: one file that is well-formed, needs no other file, and agrees with the other results.

use quick_xml::Reader;
use quick_xml::events::Event;

use crate::command::program::Folder;

const SECTIONS: [&str; 11] = [
    "what",
    "numbers",
    "map",
    "changes",
    "flow",
    "roads",
    "following",
    "trips",
    "problems",
    "method",
    "scenario",
];

/// An element's name, and all text in it.
pub(crate) type Element = (String, String);

/// The names of all elements of a page, each with all text in it; fails if the page is not well-formed.
pub(crate) fn texts(page: &str) -> Vec<Element> {
    let mut reader = Reader::from_str(page);
    let (mut open, mut closed): (Vec<Element>, Vec<Element>) = (Vec::new(), Vec::new());
    loop {
        match reader.read_event().unwrap() {
            Event::Start(element) => {
                element.attributes().for_each(|it| drop(it.unwrap()));
                open.push((element.name().as_ref().to_string(), String::new()));
            }
            Event::Empty(element) => element.attributes().for_each(|it| drop(it.unwrap())),
            Event::End(_) => {
                let element = open.pop().unwrap();
                if let Some((_, around)) = open.last_mut() {
                    *around += &element.1;
                }
                closed.push(element);
            }
            Event::Text(text) => {
                if let Some((_, around)) = open.last_mut() {
                    *around += &text;
                }
            }
            Event::Eof => break,
            _ => {}
        }
    }
    assert!(open.is_empty(), "{open:?} are left open");
    closed
}

pub(crate) fn assert_needs_nothing(page: &str) {
    for reference in ["http", "src=", "@import", "url(", "<script ", "<link"] {
        assert!(!page.contains(reference), "{reference}");
    }
    assert!(page.matches("<script>").count() <= 1);
}

/// Each `<svg>` of a page.
pub(crate) fn figures(page: &str) -> Vec<&str> {
    page.split("<svg").skip(1).map(|it| it.split("</svg>").next().unwrap()).collect()
}

/// Both axes of a figure have a label: with a unit, except for counts and names, which have none. A map has no axes,
/// but a scale.
pub(crate) fn has_units(figure: &str) -> bool {
    if figure.contains("<g class=\"scale\">") {
        return figure.contains(" m</text>");
    }
    const WITHOUT: [&str; 9] = [
        "Vehicles",
        "Lane changes",
        "Style",
        "Model",
        "Leading incentive",
        "Stuck vehicles",
        "Completed trips",
        "Vehicles waiting to enter at the end",
        "Desire when held up ÷ on a free road",
    ];
    let is_plain = |it: &str| WITHOUT.iter().any(|label| it.contains(&format!(">{label}</text>")));
    let has_label = |it: &&str| (it.contains(" [") && it.contains("]</text>")) || is_plain(it);
    figure.split("<text").filter(has_label).count() >= 2
}

/// The data of each figure of a page, as they are downloaded.
pub(crate) fn data(page: &str) -> Vec<String> {
    let decoded = |encoded: &str| {
        let mut bytes = Vec::new();
        let mut rest = encoded.bytes();
        while let Some(byte) = rest.next() {
            let digits: Vec<u8> = if byte == b'%' { rest.by_ref().take(2).collect() } else { Vec::new() };
            let escaped = || u8::from_str_radix(std::str::from_utf8(&digits).unwrap(), 16).unwrap();
            bytes.push(if byte == b'%' { escaped() } else { byte });
        }
        String::from_utf8(bytes).unwrap()
    };
    let links = page.split(".csv\" href=\"data:text/csv;charset=utf-8,").skip(1);
    links.map(|it| decoded(it.split('"').next().unwrap())).collect()
}

/// Every figure of a page can be downloaded, and its data have a row for each value.
pub(crate) fn assert_downloads(page: &str) {
    let figures = figures(page).len();
    let files: Vec<&str> =
        page.split("data-file=\"").skip(1).map(|it| it.split('"').next().unwrap()).collect();
    assert_eq!(files.len(), figures, "{files:?}");
    assert!(files.iter().all(|it| it.starts_with("figure_") && it.ends_with(".svg")), "{files:?}");
    let data = data(page);
    assert_eq!(data.len(), figures);
    for (file, csv) in files.iter().zip(&data) {
        assert!(csv.lines().count() > 1, "{file} has no data");
        let commas = |it: &str| it.split('"').step_by(2).map(|it| it.matches(',').count()).sum::<usize>();
        let mut widths = csv.lines().map(commas);
        let first = widths.next().unwrap();
        assert!(widths.all(|it| it == first), "{file}: {csv}");
        assert!(page.contains(&format!("download=\"{}.csv\"", file.trim_end_matches(".svg"))), "{file}");
    }
}

/// The number of rows of a table in CSV that have these values in these columns.
fn rows(table: &str, wanted: &[(&str, &str)]) -> usize {
    let mut lines = table.lines().map(|it| it.split(',').collect::<Vec<&str>>());
    let columns = lines.next().unwrap();
    let place = |name: &str| columns.iter().position(|it| *it == name).unwrap();
    lines.filter(|row| wanted.iter().all(|(column, value)| row[place(column)] == *value)).count()
}

#[test]
fn the_report_is_one_well_formed_file_with_every_section_and_labelled_axes() {
    let folder = Folder::new();
    let run = folder.laneweave("run MAPS/ramps.osm --demand 4200 --duration 300 --record 0");
    assert!(run.code() == 0 && run.text().contains("report.html"), "{}", run.errors());
    let page = folder.read("out/report.html");
    assert_needs_nothing(&page);
    let texts = texts(&page);
    for id in SECTIONS {
        assert!(page.contains(&format!("<section id=\"{id}\">")), "{id}");
        assert!(page.contains(&format!("<a href=\"#{id}\">")), "{id}");
    }
    let figures = figures(&page);
    assert!(figures.len() >= 12, "{}", figures.len());
    assert!(figures.iter().all(|it| has_units(it)), "{figures:?}");
    let captions: Vec<&str> =
        texts.iter().filter(|(name, _)| name == "figcaption").map(|it| it.1.as_str()).collect();
    assert!(captions.iter().all(|it| it.contains("n = ")), "{captions:?}");
    assert!(page.len() < 1_000_000, "{}", page.len());
    assert_downloads(&page);
}

/// The values of a quantity in the data of a figure, by lanelet.
fn by_lanelet(csv: &str, quantity: &str) -> Vec<(String, Option<f64>)> {
    let rows = csv.lines().map(|it| it.split(',').collect::<Vec<&str>>());
    let wanted = rows.filter(|it| it[0] == "lanelet" && it[4] == quantity);
    wanted.map(|it| (it[1].to_owned(), it[5].parse().ok())).collect()
}

#[test]
fn the_maps_show_the_numbers_of_the_tables_and_their_data_hold_them() {
    let folder = Folder::new();
    folder.summary("MAPS/ramps.osm --demand 6000 --duration 300 --record 0 --format csv --seed 7");
    let page = folder.read("out/report.html");
    let data = data(&page);
    let table = folder.read("out/lanelets.csv");
    let mut lines = table.lines().map(|it| it.split(',').collect::<Vec<&str>>());
    let columns = lines.next().unwrap();
    let number = |row: &[&str], name: &str| -> Option<f64> {
        row[columns.iter().position(|it| *it == name).unwrap()].parse().ok()
    };
    let rows: Vec<Vec<&str>> = lines.collect();
    let speeds = by_lanelet(&data[0], "Mean speed [km/h]");
    let densities = by_lanelet(&data[1], "Density [veh/km]");
    let standing = by_lanelet(&data[3], "Standing vehicles [veh/km]");
    assert!(rows.len() > 50 && [&speeds, &densities, &standing].iter().all(|it| it.len() == rows.len()));
    let mut shown = 0;
    for row in &rows {
        let of = |all: &[(String, Option<f64>)]| all.iter().find(|it| it.0 == row[0]).unwrap().1;
        let near = |shown: Option<f64>, expected: f64| {
            let shown = shown.unwrap_or(0.0);
            assert!(
                (shown - expected).abs() <= 1e-5 * expected.abs() + 1e-9,
                "{shown}, not {expected}: {row:?}"
            );
        };
        near(of(&speeds), 3.6 * number(row, "speed_mps").unwrap_or(0.0));
        near(of(&densities), number(row, "density_veh_km").unwrap());
        let (stood, length) = (number(row, "standing_s").unwrap(), number(row, "length_m").unwrap());
        near(of(&standing), stood / (length * 300.0) * 1000.0);
        if let Some(speed) = number(row, "speed_mps") {
            let title = format!("<title>lanelet {}: {} km/h</title>", row[0], (36.0 * speed).round() / 10.0);
            shown += usize::from(page.contains(&title));
        }
    }
    assert!(shown > 50, "{shown}");
    let changes = folder.read("out/lane_changes.csv");
    for (kind, name) in
        [("discretionary", "discretionary"), ("route", "route-driven"), ("keeping", "keeping")]
    {
        let all = rows_of(&changes, kind);
        assert!(page.contains(&format!(">{name} ({all})</text>")), "{name}: {all}");
        let marks = data[2].lines().filter(|it| it.starts_with(&format!("{name},"))).count();
        // Of more than 800, every second one is kept.
        assert!(all > 20 && (marks == all || all > 800 && marks.abs_diff(all / 2) <= 1), "{marks} of {all}");
    }
    let queued = data[3].lines().filter(|it| it.starts_with("waiting to enter,")).count();
    assert!(queued > 0 && page.contains("waiting to enter (largest queue: "), "{queued}");
}

/// The number of completed lane changes of a kind.
fn rows_of(table: &str, kind: &str) -> usize {
    rows(table, &[("outcome", "completed"), ("kind", kind)])
}

#[test]
fn a_run_without_collisions_says_so_in_place_of_their_map() {
    let folder = Folder::new();
    folder.summary("MAPS/motorway_2_lanes.osm --demand 1000 --duration 60 --record 0");
    let page = folder.read("out/report.html");
    assert!(page.contains("No vehicles touched each other, so there is no map of collisions."));
    assert!(!page.contains("Collisions and overlaps on the map"));
}

#[test]
fn the_numbers_of_the_report_are_those_of_the_summary_and_the_table() {
    let folder = Folder::new();
    let summary =
        folder.summary("MAPS/ramps.osm --demand 4200 --duration 300 --record 0 --format csv --seed 7");
    let page = folder.read("out/report.html");
    for (field, name) in [
        ("lane_changes_discretionary", "discretionary lane changes"),
        ("lane_changes_route_driven", "route-driven lane changes"),
        ("lane_changes_keeping", "lane changes to keep to the slow side"),
        ("entered", "vehicles entered"),
        ("waiting_to_enter", "vehicles waiting to enter"),
        ("collisions", "collisions"),
        ("overlaps", "overlaps"),
        ("lost", "lost"),
        ("emergency_brakings", "emergency brakings"),
        ("stuck", "vehicles stuck"),
        ("missed_turns", "missed turns"),
    ] {
        let tile = format!("<b>{}</b><span>{name}</span>", summary[field]);
        assert!(page.contains(&tile), "{tile}");
    }
    let speed = 3.6 * summary["mean_speed_mps"].as_f64().unwrap();
    assert!(page.contains(&format!("<b>{speed:.1} km/h</b>")), "{speed}");
    assert!(page.contains(&format!("<dt>Final state</dt><dd>{}", summary["state_hash"].as_str().unwrap())));
    assert!(page.contains("<dt>Seed</dt><dd>7</dd>") && page.contains("--seed 7"));

    let table = folder.read("out/lane_changes.csv");
    let of = |style: Option<&str>, kind: &str| {
        let style = style.map(|it| ("style", it));
        let wanted: Vec<(&str, &str)> =
            [("outcome", "completed"), ("kind", kind)].into_iter().chain(style).collect();
        rows(&table, &wanted)
    };
    for style in [Some("aggressive"), Some("conservative"), None] {
        let [discretionary, route, keeping] = ["discretionary", "route", "keeping"].map(|it| of(style, it));
        let row = format!(
            "<th scope=\"row\" data-name=\"style\">{}</th><td data-name=\"discretionary\" class=\"number\">{discretionary}</td><td \
             data-name=\"route-driven\" class=\"number\">{route}</td><td data-name=\"keeping\" class=\"number\">{keeping}</td>",
            style.unwrap_or("all")
        );
        assert!(page.contains(&row), "{row}");
    }
    assert!(["discretionary", "route", "keeping"].iter().all(|it| of(None, it) > 20));
}

#[test]
fn a_run_without_anybody_has_a_report_that_says_so() {
    let folder = Folder::new();
    folder.summary("MAPS/lane_drop.osm --demand 0 --duration 90");
    let page = folder.read("out/report.html");
    assert_needs_nothing(&page);
    texts(&page);
    assert!(SECTIONS.iter().all(|id| page.contains(&format!("<section id=\"{id}\">"))));
    assert!(figures(&page).is_empty() && !page.contains("NaN") && !page.contains("inf"));
    for text in
        ["No lane change was completed", "No vehicle drove", "No trip was completed", "No vehicle entered"]
    {
        assert!(page.contains(text), "{text}");
    }
}

#[test]
fn the_same_run_has_the_same_report_on_any_number_of_threads() {
    let folder = Folder::new();
    let report = |threads: u32| {
        folder.summary(&format!("MAPS/ramps.osm --demand 4200 --duration 90 --threads {threads}"));
        let page = folder.read("out/report.html");
        // The command, and its settings.
        page.replace(&format!("--threads {threads}"), "").replace(&format!("threads = {threads}\n"), "")
    };
    assert!(report(1) == report(2), "the reports differ");
}

#[test]
fn a_long_jam_has_a_small_report() {
    let folder = Folder::new();
    folder.summary("MAPS/lane_drop.osm --demand 9000 --duration 900 --record 0");
    let page = folder.read("out/report.html");
    assert!(page.len() < 700_000, "{}", page.len());
    assert_downloads(&page);
    assert!(page.contains("is drawn)") && page.contains("Demand above what the map bears"));
}
