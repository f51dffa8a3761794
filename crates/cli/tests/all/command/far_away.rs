//! One time far from all others ends every command at once, and what is left out is named.

use std::path::Path;
use std::time::{Duration, Instant};

use laneweave_test_data::data;

use crate::command::program::{Folder, Run};

/// Far more than a command needs for some seconds of traffic, also on a busy machine.
const SOON: Duration = Duration::from_secs(20);

#[track_caller]
fn soon(folder: &Folder, line: &str) -> Run {
    let begin = Instant::now();
    let run = folder.laneweave(line);
    assert!(begin.elapsed() < SOON, "{line}: {:?}", begin.elapsed());
    run
}

/// Whether every command that visits a recording ends, and says what it left out.
#[track_caller]
fn assert_cut(folder: &Folder, file: &Path) {
    let file = file.display();
    let of = |command: &str| format!("{command} {file} --map MAPS/ramps.osm");
    let check = soon(folder, &of("check"));
    assert_eq!(check.code(), 0, "{}", check.errors());
    assert!(check.text().contains("are left out: frame"), "{}", check.text());
    let replay = soon(folder, &format!("{} --reactive 0.5 --out replayed", of("replay")));
    assert!(replay.errors().contains("are left out: frame"), "{}", replay.errors());
    let fit = soon(folder, &format!("{} --plan", of("fit")));
    assert!(
        fit.text().contains("are left out: frame") || fit.errors().contains("are left out: frame"),
        "{}",
        fit.text()
    );
}

#[test]
fn a_row_of_another_day_is_cut() {
    let folder = Folder::new();
    let line = "run MAPS/ramps.osm --duration 20 --demand 3000 --record 0 --quiet --seed 4";
    assert_eq!(folder.laneweave(line).code(), 0);
    assert_eq!(folder.laneweave("observe out --to whole.csv").code(), 0);
    let table = folder.read("whole.csv");
    let last = table.lines().last().expect("it has rows");
    let rest = last.splitn(4, ',').nth(3).expect("it has columns");
    let folder = folder.with("far.csv", &format!("{table}1,2000000000,80000000000,{rest}\n"));
    assert_cut(&folder, Path::new("far.csv"));
}

#[test]
fn small_cases_with_one_time_far_away_are_cut() {
    for name in
        ["ngsim_one_time_off.csv", "interaction_last_row_far_in_time.csv", "far_frame_highd/01_tracks.csv"]
    {
        let Some(path) = data(&format!("cases/{name}")) else { return };
        assert_cut(&Folder::new(), &path);
    }
}
