//! What is shown: pictures, and what the viewer refuses.

use std::fs;

use crate::command::program::at_home;

#[test]
fn pictures_are_numbered_and_png_files() {
    let folder = at_home();
    assert_eq!(folder.laneweave("run maps/ramps.osm --duration 20 --quiet").code(), 0);
    let run = folder.laneweave("render out --every 5 --from 5 --until 15 --size 320x180 --out film");
    assert_eq!((run.code(), run.text().as_str()), (0, "3 pictures in film\n"), "{}", run.errors());
    for number in 0..3 {
        let picture =
            fs::read(folder.path().join(format!("film/frame_0000{number}.png"))).expect("a picture");
        assert!(picture.starts_with(b"\x89PNG"));
    }
}

#[test]
fn what_cannot_be_shown_is_refused_with_a_remedy() {
    let folder = at_home().with("tracks.csv", "a,b\n1,2\n");
    for (line, part) in [
        ("view maps/nowhere.osm", "nowhere.osm"),
        ("view maps", "give the folder that laneweave run has written"),
        ("view tracks.csv", "add --map MAP"),
        ("view maps/ramps.osm maps/town.osm", "one thing is shown at a time"),
        ("render maps/ramps.osm", "--until"),
        ("render maps/ramps.osm --camera here", "write map, X,Y,WIDTH"),
        ("render maps/ramps.osm --camera 0,0,0", "write map, X,Y,WIDTH"),
        ("render maps/ramps.osm --size 0x100", "write WIDTHxHEIGHT"),
        ("render maps/ramps.osm --every 0 --until 5", "choose more than 0 s"),
        ("render maps/ramps.osm --from 5 --until 1", "choose an earlier --from"),
    ] {
        let run = folder.laneweave(line);
        let errors = run.errors();
        assert!(run.code() == 2 && errors.contains(part), "{line}: {} {errors}", run.code());
    }
    assert!(!folder.holds("frames"));
}

#[test]
fn a_simulation_that_runs_now_cannot_be_exported() {
    let folder = at_home();
    let run = folder.laneweave("view maps/ramps.osm --export replay.html");
    let errors = run.errors();
    assert!(run.code() == 2 && errors.contains("has no end"), "{errors}");
    assert!(!folder.holds("replay.html"));
}
