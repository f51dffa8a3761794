//! Signal programs from the scenario.

use crate::command::program::Folder;

/// A folder with one junction and a scenario with `signals`. The junction has four arms of two lanes, with the lights
/// 65 to 72, two for each arm.
fn folder(signals: &str) -> Folder {
    let scenario = format!(
        "map = \"one.osm\"\n[demand]\nvehicles_per_hour = 2000\n[run]\nduration_s = 600\n[output]\nrecord_s = 0\n{signals}\n"
    );
    let folder = Folder::new().with("own.toml", &scenario);
    assert_eq!(folder.laneweave("generate grid --rows 1 --columns 1 one.osm").code(), 0);
    folder
}

const EAST_AND_WEST: &str = "[65, 66, 69, 70]";
const NORTH_AND_SOUTH: &str = "[67, 68, 71, 72]";

#[test]
fn lights_follow_the_program_of_the_scenario() {
    let delay = |signals: &str| {
        let summary = folder(signals).summary("own.toml");
        assert_eq!((&summary["collisions"], &summary["stuck"]), (&0.into(), &0.into()));
        summary["mean_delay_s"].as_f64().unwrap()
    };
    let two_phases = |east_and_west: f64, north_and_south: f64| {
        format!(
            "[[signals]]\noffset_s = 5\nphases = [\n  {{ green = {EAST_AND_WEST}, green_s = {east_and_west} }},\n  \
             {{ green = {NORTH_AND_SOUTH}, green_s = {north_and_south}, yellow_s = 4 }},\n]"
        )
    };
    let [made, own, long] = [delay(""), delay(&two_phases(25.0, 24.0)), delay(&two_phases(80.0, 80.0))];
    // The made program is as good as one that was drawn by hand, and better than one with long cycles.
    assert!(made < 1.1 * own, "{made} s against {own} s");
    assert!(made < 0.7 * long, "{made} s against {long} s");
}

#[test]
fn greens_that_traffic_extends_shorten_delays_where_one_road_is_quiet() {
    let quiet = "map = \"one.osm\"\n[demand.entrances]\n1 = 400\n23 = 400\n25 = 40\n47 = 40\n\
                 [run]\nduration_s = 900\n[output]\nrecord_s = 0\n";
    let delay = |signals: &str| {
        let folder = Folder::new().with("own.toml", &format!("{signals}\n{quiet}"));
        assert_eq!(folder.laneweave("generate grid --rows 1 --columns 1 one.osm").code(), 0);
        let summary = folder.summary("own.toml");
        assert_eq!((&summary["collisions"], &summary["stuck"]), (&0.into(), &0.into()));
        summary["mean_delay_s"].as_f64().unwrap()
    };
    let program = |length: &str| {
        format!(
            "signals = [{{ phases = [{{ green = {EAST_AND_WEST}, {length} }}, \
             {{ green = {NORTH_AND_SOUTH}, {length} }}] }}]"
        )
    };
    let fixed = delay(&program("green_s = 25"));
    let extended = delay(&program("max_green_s = 25, min_green_s = 4, gap_s = 1.5"));
    let [made, made_actuated] = ["fixed", "actuated"].map(|it| delay(&format!("made_signals = \"{it}\"")));
    assert!(extended < 0.7 * fixed, "{extended} s against {fixed} s");
    // A made program with fixed greens gives the quiet road little.
    assert!(made < 0.8 * fixed && made_actuated < 0.95 * made, "{made_actuated} s, {made} s, {fixed} s");
}

#[test]
fn the_summary_names_the_estimated_capacity_and_the_light_that_is_its_bottleneck() {
    let signals = |north_and_south: f64| {
        format!(
            "[[signals]]\nphases = [{{ green = {EAST_AND_WEST}, green_s = 25 }}, \
             {{ green = {NORTH_AND_SOUTH}, green_s = {north_and_south} }}]"
        )
    };
    let summary = |green: f64| folder(&signals(green)).summary("own.toml --duration 1");
    let [short, long] =
        [15.0, 25.0].map(|green| summary(green)["estimated_capacity_veh_h"].as_f64().unwrap());
    assert!(short < 0.9 * long, "{short} and {long} veh/h");
    let first = summary(15.0)["bottleneck"].as_str().unwrap().to_owned();
    let lights: Vec<String> =
        NORTH_AND_SOUTH.split(|it: char| !it.is_ascii_digit()).map(str::to_owned).collect();
    assert!(
        lights.iter().any(|it| !it.is_empty() && first.starts_with(&format!("light {it} at lanelet "))),
        "{first}"
    );
}

#[test]
fn a_program_that_cannot_be_is_refused_with_its_place_and_a_remedy() {
    let green = |lights: &str| format!("{{ green = {lights}, green_s = 25 }}");
    let two = format!("{}, {}", green(EAST_AND_WEST), green(NORTH_AND_SOUTH));
    for (signals, message) in [
        (
            format!("[[signals]]\nphases = [{}]", green("[1]")),
            "own.toml:9:13: the map has no traffic light 1; its traffic lights are 65, 66, 67, 68, 69, 70, 71, 72",
        ),
        (
            format!("[[signals]]\nphases = [{}]", green("[65, 67]")),
            "own.toml:9:13: the traffic lights 65 and 67 are green together, but lanelets 49 and 53 conflict, and neither has \
             priority; put them into different phases",
        ),
        (
            format!("[[signals]]\nphases = [{}]", green(EAST_AND_WEST)),
            "own.toml:9:13: the traffic light 67 has no phase, but conflicts with 65: lanelets 49 and 53 conflict; add it to a \
             phase of this program",
        ),
        (
            "[[signals]]\nphases = [{ green = [65], green_s = 0 }]".into(),
            "own.toml:9:27: a green time of 0 s; choose more than 0 to 3600 s",
        ),
        (
            "[[signals]]\nphases = [{ green = [65] }]".into(),
            "own.toml:9:13: a phase without a green time; give green_s, or max_green_s if traffic extends it",
        ),
        (
            "[[signals]]\nphases = [{ green = [65], green_s = 9, gap_s = 2 }]".into(),
            "own.toml:9:27: both a fixed and an actuated green; remove green_s, or remove min_green_s, max_green_s and gap_s",
        ),
        (
            "[[signals]]\nphases = [{ green = [65], max_green_s = 9, min_green_s = 10 }]".into(),
            "own.toml:9:44: a minimum green of 10 s; choose more than 0 to 9 s",
        ),
        (
            "[[signals]]\nphases = [{ green = [65], max_green_s = 9, gap_s = -1 }]".into(),
            "own.toml:9:44: a gap time of -1 s; choose 0 to 3600 s",
        ),
        (
            "[[signals]]\noffset_s = 5\nphases = [{ green = [65], max_green_s = 9 }]".into(),
            "own.toml:9:1: an offset of an actuated program; leave it out",
        ),
        (
            "[[signals]]\nphases = [{ green = [65], green_s = 9, yellow_s = -1 }]".into(),
            "own.toml:9:40: a yellow time of -1 s; choose more than 0 to 3600 s",
        ),
        (
            format!("[[signals]]\ncycle_s = 61\nphases = [{two}]"),
            "own.toml:9:1: a cycle of 61 s, but its phases last 60 s; remove it, or change a phase",
        ),
        ("[[signals]]\nphases = []".into(), "own.toml:9:1: a program without phases; give it one or more"),
        (
            format!("[[signals]]\nphases = [{two}]\n[[signals]]\nphases = [{}]", green("[65]")),
            "own.toml:11:1: the traffic light 65 already has a program; use it in one program only",
        ),
    ] {
        let folder = folder(&signals);
        let run = folder.laneweave("run own.toml");
        assert_eq!((run.code(), run.errors().trim()), (2, format!("error: {message}").as_str()), "{signals}");
        assert!(!folder.holds("out"));
    }
}
