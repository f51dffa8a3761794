//! Wrong input: an error with place and remedy, exit code 2, and nothing written.

use crate::command::program::{Folder, maps};

/// Runs a command line that must fail; returns the message.
pub(super) fn refusal(folder: &Folder, line: &str) -> String {
    let run = folder.laneweave(&format!("{line} --out results"));
    assert_eq!((run.code(), run.text().as_str()), (2, ""), "{line}: {}", run.errors());
    assert!(run.errors().starts_with("error: "), "{}", run.errors());
    assert!(!folder.holds("results"), "{line}: something was written");
    run.errors()["error: ".len()..].trim_end().to_owned()
}

/// Runs a scenario that must fail, with `rest` after its map in line 1.
pub(super) fn scenario(rest: &str) -> String {
    let text = format!("map = \"{}/ramps.osm\"\n{rest}", maps().display());
    refusal(&Folder::new().with("s.toml", &text), "run s.toml")
}

#[test]
fn files_that_are_missing() {
    let folder = Folder::new().with("s.toml", "# mine\nmap = \"none.osm\"\n");
    assert_eq!(refusal(&folder, "run none.osm"), "none.osm: there is no such file; check the path");
    assert!(refusal(&folder, "run none.toml").starts_with("none.toml: cannot be read: "));
    assert_eq!(
        refusal(&folder, "run s.toml"),
        "s.toml:2:1: map none.osm: there is no such file; check the path"
    );
}

#[test]
fn maps_that_are_none() {
    let folder = Folder::new()
        .with("broken.osm", "<osm>\n<node id=\"1\"")
        .with("empty.osm", "<osm></osm>")
        .with("other.osm", "<gml></gml>")
        .with("map.xodr", "");
    assert!(refusal(&folder, "run broken.osm").starts_with("broken.osm:2: not well-formed XML"));
    assert!(refusal(&folder, "run empty.osm").contains("can be used by vehicles; give roads the tags"));
    assert!(refusal(&folder, "run other.osm").starts_with("other.osm:1: the outermost element is <gml>"));
    assert!(refusal(&folder, "run map.xodr").ends_with(
        "known are Lanelet2 (.osm, .osm_xy), CommonRoad (.xml), SUMO (.net.xml, .xml), scenario (.toml)"
    ));
}

#[test]
fn options_out_of_range() {
    let folder = Folder::new();
    for (option, message) in [
        ("--demand NaN", "--demand: a demand of NaN veh/h; choose 0 to 40000 veh/h for the 4 lanes there"),
        ("--demand -5", "--demand: a demand of -5 veh/h; choose 0 to 40000 veh/h for the 4 lanes there"),
        (
            "--demand 1e6",
            "--demand: a demand of 1000000 veh/h; choose 0 to 40000 veh/h for the 4 lanes there",
        ),
        ("--duration -1", "--duration: a duration of -1 s; choose 0.1 to 10000000 s"),
        ("--duration inf", "--duration: a duration of inf s; choose 0.1 to 10000000 s"),
        ("--step 0", "--step: a step of 0 s; choose 0.01 to 1 s"),
        ("--step NaN", "--step: a step of NaN s; choose 0.01 to 1 s"),
        ("--warmup -1", "--warmup: a warm-up of -1 s; choose 0 to 10000000 s"),
        ("--trucks 1.5", "--trucks: a share of trucks of 1.5; choose 0 to 1"),
        ("--threads 1000", "--threads: 1000 threads; choose 1 to 256"),
        ("--record -1", "--record: a recording interval of -1 s; choose 0 to 10000000 s"),
        (
            "--record 0.25",
            "--record: a recording interval of 0.25 s is not a multiple of the step of 0.1 s; choose a multiple of it, such as 0.3 \
             s",
        ),
        ("--flows -1", "--flows: an interval of flows of -1 s; choose 0 to 10000000 s"),
        (
            "--flows 60.05",
            "--flows: an interval of flows of 60.05 s is not a multiple of the step of 0.1 s; choose a multiple of it, such as 60.1 \
             s",
        ),
        (
            "--record 0 --sumo tripinfo,fcd",
            "--sumo: fcd.xml is sampled at output.record_s, which is 0; remove fcd, or set record_s = 1",
        ),
        (
            "--style aggressive=-1",
            "--style: the style \"aggressive\" has the weight -1; give it a finite weight of 0 or more",
        ),
        (
            "--style aggressive=0",
            "--style: the weights of the styles add up to 0; give at least one of them a weight above 0",
        ),
    ] {
        assert_eq!(refusal(&folder, &format!("run MAPS/ramps.osm {option}")), message);
    }
}

#[test]
fn styles_that_are_unknown() {
    let message = refusal(&Folder::new(), "run MAPS/ramps.osm --style agressive=1");
    assert!(
        message.starts_with("--style: unknown style \"agressive\"; did you mean \"aggressive\"?"),
        "{message}"
    );
    let message = scenario("[styles]\nconservativ = 1\n");
    assert!(
        message.starts_with("s.toml:3:1: unknown style \"conservativ\"; did you mean \"conservative\"?"),
        "{message}"
    );
    let message = refusal(&Folder::new(), "run MAPS/ramps.osm --style none.toml=1");
    assert!(message.starts_with("--style: style file none.toml: cannot be read"), "{message}");
}

#[test]
fn keys_of_a_scenario_that_are_unknown() {
    let expected = "s.toml:3:1: unknown key \"duraton_s\"; did you mean \"duration_s\"?";
    assert_eq!(scenario("[run]\nduraton_s = 5\n"), expected);
    assert_eq!(scenario("[dmand]\n"), "s.toml:2:2: unknown key \"dmand\"; did you mean \"demand\"?");
    assert_eq!(
        scenario("[output]\nformat = \"parket\"\n"),
        "s.toml:3:10: unknown value \"parket\"; did you mean \"parquet\"?"
    );
    assert_eq!(
        scenario("[output]\nsumo = [\"fcd\", \"tripinfos\"]\n"),
        "s.toml:3:16: unknown value \"tripinfos\"; did you mean \"tripinfo\"?"
    );
}

#[test]
fn values_of_a_scenario_that_make_no_sense() {
    for (rest, message) in [
        (
            "[guidance]\ninterval_s = 0.5\n",
            "s.toml:3:1: an interval of guidance of 0.5 s; choose 1 to 10000000 s",
        ),
        ("[run]\nduration_s = nan\n", "s.toml:3:1: a duration of NaN s; choose 0.1 to 10000000 s"),
        (
            "[run]\nduration_s = \"long\"\n",
            "s.toml:3:14: this is the text \"long\", but a number is expected; correct the value",
        ),
        (
            "[demand]\ntrucks = 0.5\nbuses = 0.25\nmotorcycles = 0.5\n",
            "s.toml:5:1: a share of motorcycles of 0.5; choose 0 to 0.25",
        ),
        ("[demand]\ntrucks = -0.1\n", "s.toml:3:1: a share of trucks of -0.1; choose 0 to 1"),
        (
            "[demand.entrances]\n1 = 1e9\n",
            "s.toml:3:1: a demand at the entrance 1 of 1000000000 veh/h; choose 0 to 30000 veh/h for the 3 lanes there",
        ),
        ("[demand.entrances]\n7 = 1\n", "s.toml:3:1: the map has no entrance \"7\"; known are 1, 95"),
        ("[demand.exits]\n88 = -1\n", "s.toml:3:1: the map has no exit \"88\"; known are "),
        (
            "[demand.entrances]\n1 = \"many\"\n",
            "s.toml:3:5: invalid value: expected a number or a list [[time_s, vehicles_per_hour], …]; correct the value",
        ),
        (
            "[demand.entrances]\n1 = [[0, -5]]\n",
            "s.toml:3:1: a demand at the entrance 1 of -5 veh/h; choose 0 to 30000 veh/h",
        ),
        (
            "[demand]\nprofile = [[9, 1], [3, 1]]\n",
            "s.toml:3:1: the times do not increase; write [[time_s, value], …]",
        ),
        ("[demand]\nprofile = [[0, -1]]\n", "s.toml:3:1: a factor of -1; choose 0 or more"),
        (
            "[[demand.od]]\nfrom = \"1\"\nto = \"94\"\nvehicles_per_hour = 1\n[[demand.od]]\nfrom = \"2\"\n\
             to = \"94\"\nvehicles_per_hour = 1\n",
            "s.toml:7:1: the map has no entrance \"2\"; ",
        ),
        (
            "[[demand.od]]\nfrom = \"95\"\nto = \"94\"\nvehicles_per_hour = 1\n",
            "s.toml:4:1: no trip from 95 to 94 is possible: there is no route, or it is too short; remove the row",
        ),
        (
            "[[demand.od]]\nfrom = \"1\"\nto = \"94\"\nvehicles_per_hour = -1\n",
            "s.toml:5:1: a demand from 1 to 94 of -1 veh/h; choose 0 to 30000 veh/h",
        ),
        (
            "[[demand.od]]\nfrom = \"1\"\nto = \"94\"\nvehicles_per_hour = 1\n[demand.entrances]\n1 = 5\n",
            "s.toml:3:1: the entrance 1 also has a demand in demand.entrances; remove it there, or remove this row",
        ),
        (
            "[demand.headways]\nlaw = \"cowan-m3\"\nminimum_s = 6\n",
            "s.toml:4:1: the shortest headway is 6 s, where the mean is 4.78 s: it must be shorter; choose less, or reduce the \
             demand at the entrance 1",
        ),
        (
            "[demand.headways]\nlaw = \"erlang\"\nstages = 0\n",
            "s.toml:4:1: the stages of the headways is 0: it must lie between 1 and 400; choose 1 to 400",
        ),
        (
            "[run\n",
            "s.toml:2:5: unclosed table, expected `]`; correct this line; the format is TOML, https://toml.io",
        ),
    ] {
        assert!(scenario(rest).starts_with(message), "{}", scenario(rest));
    }
}

#[test]
fn a_folder_that_cannot_be_made() {
    let folder = Folder::new().with("taken", "");
    let run = folder.laneweave("run MAPS/ramps.osm --out taken/results");
    assert_eq!(run.code(), 2);
    assert!(run.errors().starts_with("error: taken/results: cannot be created as the results folder"));
}

/// Runs a command that must fail; returns the message.
pub(super) fn answer(folder: &Folder, line: &str) -> String {
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.text().as_str()), (2, ""), "{line}: {}", run.errors());
    run.errors()["error: ".len()..].trim_end().to_owned()
}

#[test]
fn folders_where_files_are_wanted() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("s.toml")).unwrap();
    assert_eq!(
        refusal(&folder, "run s.toml"),
        "s.toml: cannot be read: is a directory; give a file, not a folder"
    );
    assert!(answer(&folder, "styles show s.toml").ends_with("is a directory; give a file, not a folder"));
}

#[test]
fn files_that_are_empty_or_no_text() {
    let folder = Folder::new().with("e.osm", "").with("e.xml", "").with("e.csv", "").with("e.toml", "");
    let empty = "the file is empty; download the map again, or choose another file";
    assert_eq!(refusal(&folder, "run e.osm"), format!("e.osm: {empty}"));
    assert_eq!(answer(&folder, "check e.xml"), format!("e.xml: {empty}"));
    assert_eq!(
        answer(&folder, "check e.csv --map MAPS/ramps.osm"),
        "e.csv: the file is empty; download the recording again, or choose another file"
    );
    assert_eq!(
        refusal(&folder, "run e.toml"),
        "e.toml:1:1: the key \"map\" is missing; add it, such as map = \"road.osm\""
    );
    for name in ["b.toml", "b.csv"] {
        std::fs::write(folder.path().join(name), b"\x7fELF\x00\xff\xfe\n\x01").unwrap();
    }
    assert_eq!(
        refusal(&folder, "run b.toml"),
        "b.toml: cannot be read: stream did not contain valid utf-8; give a text file in UTF-8"
    );
    assert_eq!(
        answer(&folder, "check b.csv --map MAPS/ramps.osm"),
        "b.csv: this is not a text file, so it cannot be a recording; choose another file, or decompress it first"
    );
}

#[test]
fn scenarios_styles_and_maps_in_place_of_each_other() {
    let text = format!("map = \"{}/ramps.osm\"\n", maps().display());
    let folder = Folder::new().with("s.toml", &text);
    assert_eq!(folder.laneweave("styles new mine").code(), 0);
    assert_eq!(
        refusal(&folder, "run mine.toml"),
        "mine.toml: this is a driver style, but a scenario or a map is expected; run a map with it: laneweave run MAP --style \
         mine.toml=1"
    );
    assert_eq!(
        refusal(&folder, "run MAPS/ramps.osm --style s.toml=1"),
        "--style: s.toml is a scenario, but a style is expected; run it: laneweave run s.toml"
    );
    for line in ["styles show s.toml", "styles new other --from s.toml"] {
        assert!(answer(&folder, line).contains("s.toml is a scenario, but a style is expected"), "{line}");
    }
    assert!(answer(&folder, "styles show road.osm").ends_with(
        "road.osm is a map, but a style is expected; list the styles with: laneweave styles list"
    ));
    for line in ["check s.toml", "routes s.toml 1 2"] {
        assert_eq!(
            answer(&folder, line),
            "s.toml: by its name this is a scenario or a style, not a map; give the map itself, which a scenario names in its key map"
        );
    }
}

#[test]
fn maps_recordings_and_tables_in_place_of_each_other() {
    let table = "track_id,frame_id\n1,2\n";
    let folder = Folder::new().with("t.csv", table).with("m.osm", "<osm/>").with("m", "<osm/>");
    assert_eq!(
        refusal(&folder, "run t.csv"),
        "t.csv: by its name this is a table, such as a recording, not a map; give the map of its location, known are \
         Lanelet2 (.osm, .osm_xy), CommonRoad (.xml), SUMO (.net.xml, .xml)"
    );
    for line in ["check t.csv", "view t.csv", "replay t.csv"] {
        assert_eq!(
            answer(&folder, line),
            "t.csv: a recording needs the map of its location; add --map MAP",
            "{line}"
        );
    }
    assert_eq!(
        answer(&folder, "check m.osm --map MAPS/ramps.osm"),
        "m.osm: by its content this is a Lanelet2 map, not a recording; give it with --map, and the recording in its place"
    );
    std::fs::write(folder.path().join("t.toml"), "map = \"m.osm\"\n").unwrap();
    assert!(answer(&folder, "check t.toml --map MAPS/ramps.osm").contains("this is a scenario or a style"));
    assert_eq!(
        refusal(&folder, "run m"),
        "m: by its content this is a Lanelet2 map; rename it so that its name ends in .osm"
    );
}

#[test]
fn files_and_styles_where_a_command_is_wanted() {
    let folder = Folder::new();
    for (line, tip) in [
        ("road.osm", "run road.osm"),
        ("mine.toml --duration 5", "run mine.toml"),
        ("styles aggressive", "styles show aggressive"),
        ("scenario road.osm.gz", "scenario new road.osm.gz"),
        ("tracks.csv", "check tracks.csv --map MAP"),
        ("demo", "(without a command, it runs the demo)"),
    ] {
        let refused = answer(&folder, line);
        assert!(refused.contains(&format!("tip: did you mean: laneweave {tip}\n")), "{line}: {refused}");
    }
    assert!(
        answer(&folder, "generate moterway m.osm").contains("tip: a similar subcommand exists: 'motorway'")
    );
}

#[test]
fn intervals_below_a_step_are_refused_and_not_taken_for_none() {
    let folder = Folder::new();
    for (option, what) in [
        ("--record", "a recording interval"),
        ("--flows", "an interval of flows"),
        ("--checkpoint", "an interval of checkpoints"),
    ] {
        for interval in ["0.05", "0.000000001"] {
            let run = folder.laneweave(&format!("run MAPS/ramps.osm {option} {interval}"));
            let told = run.errors();
            let expected = format!(
                "error: {option}: {what} of {interval} s is shorter than a step of 0.1 s; choose 0.1 s or a multiple of it, 0 to \
                 switch it off, or a shorter step\n"
            );
            assert_eq!((run.code(), told), (2, expected));
        }
    }
    let run = folder.laneweave("run MAPS/ramps.osm --duration 1 --record 0 --flows 0 --checkpoint 0.1");
    assert_eq!(run.code(), 0, "{}", run.errors());
}
