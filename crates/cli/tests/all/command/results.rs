//! The folder of results.

use crate::command::program::Folder;

#[test]
fn a_folder_takes_the_results_of_one_run_at_a_time() {
    let folder = Folder::new();
    folder.summary("MAPS/ramps.osm --duration 20 --record 0");
    let held = std::fs::File::open(folder.path().join("out")).unwrap();
    held.try_lock().unwrap();
    for line in ["run MAPS/ramps.osm --duration 20", "run out --resume"] {
        let refused = folder.laneweave(line);
        assert_eq!(refused.code(), 2, "{line}");
        let told = refused.errors();
        assert!(
            told.contains("out: another laneweave process is writing its results into this folder"),
            "{told}"
        );
    }
    assert!(folder.holds("out/summary.json"));
    drop(held);
    folder.summary("MAPS/ramps.osm --duration 20 --record 0");
}

#[test]
fn results_of_a_former_run_go_and_what_no_run_has_left_stays() {
    let folder = Folder::new();
    let with_everything =
        "MAPS/ramps.osm --duration 30 --flows 10 --sumo fcd,tripinfo,lanechange --checkpoint 10";
    folder.summary(&format!("{with_everything} --format csv"));
    let names = |folder: &Folder| -> Vec<String> {
        let entries = std::fs::read_dir(folder.path().join("out")).unwrap();
        let mut names: Vec<String> =
            entries.map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    let left = names(&folder);
    let is_known = |it: &String| laneweave::folder::RESULTS.contains(&it.as_str()) || it == "scenario.toml";
    assert!(left.iter().all(is_known), "{left:?}");
    let expected = ["fcd.xml", "flows.csv", "report.html", "scenario.toml", "trips.csv", "summary.json"];
    assert!(expected.iter().all(|it| left.iter().any(|left| left == it)), "{left:?}");
    assert_eq!(folder.laneweave("branch out --at 10 --set style.speed.weight=2").code(), 0);
    assert!(folder.holds("out/branch/differences.csv"));

    let folder = folder.with("out/notes.txt", "mine").with("out/fcd.xml.partial", "<begun");
    folder.summary("MAPS/ramps.osm --duration 30 --record 0");
    let expected = [
        "commands.parquet",
        "incidents.parquet",
        "lane_change_rate.svg",
        "lane_changes.parquet",
        "lanelets.parquet",
        "notes.txt",
        "report.html",
        "scenario.toml",
        "summary.json",
        "time_space.svg",
        "trips.parquet",
    ];
    assert_eq!(names(&folder), expected);
}

#[test]
fn a_scenario_and_styles_that_somebody_wrote_are_not_replaced() {
    let folder = Folder::new();
    let map = crate::command::program::maps().join("ramps.osm");
    let scenario = format!("# laneweave for ramps\n\nmap = \"{}\"\n[run]\nduration_s = 10\n", map.display());
    std::fs::create_dir_all(folder.path().join("own/styles")).unwrap();
    let folder = folder.with("own/scenario.toml", &scenario).with("own/styles/mine.toml", "something else");
    let refused = folder.laneweave("run own/scenario.toml --out own");
    assert_eq!(refused.code(), 2);
    assert!(
        refused.errors().contains("own/scenario.toml: this scenario was not written by a run"),
        "{}",
        refused.errors()
    );
    assert_eq!(folder.read("own/scenario.toml"), scenario);

    std::fs::rename(folder.path().join("own/scenario.toml"), folder.path().join("own/ramps.toml")).unwrap();
    folder.laneweave("styles new mine --from aggressive");
    for _ in 0..2 {
        folder.summary("own/ramps.toml --out own --record 0 --style mine.toml=1");
        assert_eq!(folder.read("own/styles/mine.toml"), "something else");
        assert_eq!(folder.read("own/styles/mine-2.toml"), folder.read("mine.toml"));
        assert!(!folder.holds("own/styles/mine-3.toml"), "what is kept already is not kept again");
        assert!(folder.read("own/scenario.toml").contains("\"styles/mine-2.toml\" = 1"));
    }
    // A folder with the results of a run can be used for another run.
    folder.summary("own/scenario.toml --out own --record 0");
}

#[test]
fn times_in_tables_are_those_of_whole_steps_without_dust() {
    let folder = Folder::new();
    let line = "run MAPS/ramps.osm --demand 4000 --duration 150 --record 0.1 --flows 0.3 --format csv";
    assert_eq!(folder.laneweave(line).code(), 0);
    for table in ["trajectories", "commands", "lane_changes", "incidents", "trips", "flows", "lanelets"] {
        let text = folder.read(&format!("out/{table}.csv"));
        let mut lines = text.lines();
        let of_steps =
            ["time_s", "started_s", "duration_s", "entered_s", "completed_s", "from_s", "to_s", "standing_s"];
        let columns: Vec<usize> = (0..)
            .zip(lines.next().unwrap().split(','))
            .filter(|(_, name)| of_steps.contains(name))
            .map(|(place, _)| place)
            .collect();
        assert!(!columns.is_empty(), "{table}");
        for line in lines {
            let cells: Vec<&str> = line.split(',').collect();
            for column in &columns {
                let decimals = cells[*column].split_once('.').map_or(0, |(_, it)| it.len());
                assert!(decimals <= 6, "{table}: {line}");
            }
        }
    }
    let times = folder.read("out/trajectories.csv");
    assert!(times.contains("\n123.6,") && !times.contains("123.60000000000001"));
}
