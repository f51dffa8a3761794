//! What is shown: pictures, and what the viewer refuses.

use std::fs;

use crate::command::program::at_home;

/// What opens a browser is given no secret: everybody on the machine can read its arguments.
#[test]
#[cfg(target_os = "linux")]
fn the_token_stands_in_the_arguments_of_no_process() {
    use std::io::{BufRead, BufReader};
    use std::os::unix::fs::PermissionsExt;
    use std::process::{Command, Stdio};

    let opener = "#!/bin/sh\ncp -p \"$1\" led.html\necho \"$@\" > given.partial\nmv given.partial given\n";
    let folder = at_home().with("xdg-open", opener);
    let executable = fs::Permissions::from_mode(0o755);
    fs::set_permissions(folder.path().join("xdg-open"), executable).expect("a program");
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").expect("a path"));
    let mut view = Command::new(env!("CARGO_BIN_EXE_laneweave"))
        .args(["view", "maps/ramps.osm"])
        .current_dir(folder.path())
        .env("PATH", path)
        .env("TMPDIR", folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .expect("a server");
    let mut address = String::new();
    BufReader::new(view.stdout.take().expect("its output")).read_line(&mut address).expect("an address");
    let (_, token) = address.trim().split_once("?token=").expect("a token");
    while !folder.holds("given") {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let given = folder.read("given");
    assert!(!given.contains(token), "{given}");
    assert!(folder.read("led.html").contains(&format!("url={}\"", address.trim())));
    let mode = |path: &str| fs::metadata(path).expect("a file").permissions().mode() & 0o777;
    assert_eq!(mode(given.trim()), 0o600);
    let ended = Command::new("kill").args(["-INT", &view.id().to_string()]).status();
    assert!(ended.expect("a signal").success() && view.wait().expect("an end").success());
    assert!(!fs::exists(given.trim()).expect("a folder"), "it goes with the program");
}

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
