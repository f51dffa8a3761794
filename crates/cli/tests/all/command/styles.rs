//! Style files.

use crate::command::program::Folder;

/// The message with which a run with the style file `edit`ed from a new one fails.
fn refusal(edit: impl Fn(String) -> String) -> String {
    let folder = Folder::new();
    assert_eq!(folder.laneweave("styles new mine").code(), 0);
    let folder_text = edit(folder.read("mine.toml"));
    let folder = folder.with("mine.toml", &folder_text);
    let run = folder.laneweave("run MAPS/ramps.osm --style mine.toml=1");
    assert_eq!(run.code(), 2);
    assert!(!folder.holds("out"));
    run.errors().trim_end().to_owned()
}

#[test]
fn a_new_style_can_be_driven_as_it_is() {
    let folder = Folder::new();
    assert_eq!(folder.laneweave("styles new hasty --from aggressive").code(), 0);
    assert!(folder.read("hasty.toml").contains("name = \"hasty\""));
    folder.summary(
        "MAPS/motorway_2_lanes.osm --duration 60 --style hasty.toml=1 --style conservative=1 --format csv",
    );
    let trajectories = folder.read("out/trajectories.csv");
    assert!(trajectories.contains(",hasty,") && trajectories.contains(",conservative,"));
}

#[test]
fn a_new_style_replaces_no_file_and_no_built_in_one() {
    let folder = Folder::new().with("mine.toml", "precious");
    let run = folder.laneweave("styles new mine");
    assert_eq!(run.code(), 2);
    assert!(run.errors().contains("mine.toml: cannot be written"), "{}", run.errors());
    assert_eq!(folder.read("mine.toml"), "precious");
    assert_eq!(folder.laneweave("styles new aggressive").code(), 2);
    assert_eq!(folder.laneweave("styles new mine --file other.toml").code(), 0);
    assert!(folder.holds("other.toml"));
}

#[test]
fn every_built_in_style_is_listed_shown_and_driven() {
    let folder = Folder::new();
    let list = folder.laneweave("styles list").text();
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(
        names,
        [
            "aggressive",
            "conservative",
            "cautious",
            "inattentive",
            "altruistic",
            "egoistic",
            "paper-aggressive",
            "paper-conservative",
            "mobil",
            "mobil-european",
            "lmrs",
            "constant-hazard"
        ]
    );
    for name in names {
        assert!(
            folder.laneweave(&format!("styles show {name}")).text().contains(&format!("name = \"{name}\""))
        );
        let summary =
            folder.summary(&format!("MAPS/motorway_2_lanes.osm --duration 60 --style {name}=1 --record 0"));
        assert!(summary["entered"].as_u64().unwrap() > 10, "{name}");
    }
    let run = folder.laneweave("styles show agressive");
    assert_eq!(run.code(), 2);
    assert!(run.errors().contains("did you mean \"aggressive\"?"), "{}", run.errors());
}

#[test]
fn a_mistake_in_a_style_file_is_told_with_its_place() {
    let line = |key: &str| {
        let folder = Folder::new();
        let text = folder.laneweave("styles show conservative").text();
        text.lines().position(|it| it.starts_with(key)).unwrap() + 1
    };
    let (gap, reading) = (line("time_gap"), line("reading"));
    assert_eq!(
        refusal(|text| text.replace("time_gap =", "time_gp =")),
        format!("error: mine.toml:{gap}:1: unknown key \"time_gp\"; did you mean \"time_gap\"?")
    );
    assert_eq!(
        refusal(|text| text.replace("time_gap = 1.2", "time_gap = -1")),
        format!("error: mine.toml:{gap}:1: follow.time_gap is -1; choose 0.1 to 10 s")
    );
    assert_eq!(
        refusal(|text| text.replace("time_gap = 1.2", "time_gap = nan")),
        format!("error: mine.toml:{gap}:1: follow.time_gap is NaN; choose 0.1 to 10 s")
    );
    assert_eq!(
        refusal(|text| text.replacen("reading = \"repaired\"", "reading = \"litera\"", 1)),
        format!("error: mine.toml:{reading}:11: unknown value \"litera\"; did you mean \"literal\"?")
    );
    assert_eq!(
        refusal(|text| text
            .replace("time_gap = 1.2", "time_gap = { distribution = \"normal\", mean = 1, sd = 1 }")),
        format!(
            "error: mine.toml:{gap}:1: follow.time_gap ranges from -inf to inf; \
             set its min and max: choose 0.1 to 10 s"
        )
    );
    assert!(
        refusal(|text| text
            .replace("time_gap = 1.2", "time_gap = { distribution = \"norma\", mean = 1, sd = 1 }"))
        .ends_with("unknown value \"norma\"; did you mean \"normal\"?")
    );
    assert!(
        refusal(|text| text.replace("sigma = 0.000875", "sigma = 0"))
            .contains("a logit rule without choice noise")
    );
    assert!(refusal(|text| text.replace("model = \"idm+\"", "")).contains("the key follow.model is missing"));
}

#[test]
fn a_new_style_names_its_lateral_model_and_an_unknown_one_is_refused() {
    assert_eq!(
        refusal(|text| text.replace("lateral = \"quintic\"", "lateral = \"linaer\"")).split(": ").nth(2),
        Some("unknown value \"linaer\"; known are quintic")
    );
    let wrong_type = refusal(|text| text.replace("lateral = \"quintic\"", "lateral = 3"));
    assert!(wrong_type.ends_with("manner.lateral is an integer; give a string"), "{wrong_type}");
}
