//! Wrong numbers on the command line: an error that says how to write them, or their limits.

use crate::command::mistakes::{answer, refusal, scenario};
use crate::command::program::Folder;

#[test]
fn options_that_are_no_numbers_or_unknown() {
    let folder = Folder::new();
    assert!(refusal(&folder, "run MAPS/ramps.osm --demand many").contains("'--demand <VEH_PER_H>'"));
    assert!(
        refusal(&folder, "run MAPS/ramps.osm --sumo fcd,trips")
            .contains("choose among fcd, tripinfo and lanechange")
    );
    assert!(refusal(&folder, "run MAPS/ramps.osm --style fast").contains("write NAME=WEIGHT"));
    assert!(
        refusal(&folder, "run MAPS/ramps.osm --demnd 5").contains("a similar argument exists: '--demand'")
    );
}

#[test]
fn numbers_with_units_separators_or_out_of_range() {
    let folder = Folder::new();
    for (option, message) in [
        ("--duration 10m", "write a plain number, such as 600 or 0.5, without unit, % or separators"),
        ("--demand 4,000", "write a plain number"),
        ("--trucks 10%", "write a plain number"),
        ("--step 100ms", "write a plain number"),
        ("--seed -1", "'--seed <N>': choose a whole number, 0 to 18446744073709551615"),
        ("--threads 0", "'--threads <N>': choose 1 to 256, or leave it out"),
    ] {
        let refused = refusal(&folder, &format!("run MAPS/ramps.osm {option}"));
        assert!(refused.contains(message), "{option}: {refused}");
    }
    let refused = answer(&folder, "routes MAPS/ramps.osm 1 lane");
    assert!(refused.contains("this map has no lanelet lane for vehicles; known are 1, 2,"), "{refused}");
    assert!(answer(&folder, "generate motorway --length 5km m.osm").contains("write a plain number"));
    for (line, message) in [
        ("generate motorway --lanes 2.5 m.osm", "'--lanes <N>': write a whole number, such as 3"),
        ("routes MAPS/ramps.osm 1 2 --most many", "'--most <N>': write a whole number, such as 3"),
        ("replay rec.csv --rollouts 0", "'--rollouts <N>': choose a whole number, 1 to 1000"),
        ("view out --port 70000", "'--port <PORT>': choose a whole number, 0 to 65535"),
    ] {
        let refused = answer(&folder, line);
        assert!(refused.contains(message), "{line}: {refused}");
    }
    assert!(scenario("[run]\nstep_s = 100\n").starts_with("s.toml:3:1: a step of 100 s; choose 0.01 to 1 s"));
}

#[test]
fn a_number_below_zero_is_refused_with_the_name_of_its_option() {
    let folder = Folder::new();
    for (line, option) in [
        ("explain out --vehicle -3", "--vehicle <ID>"),
        ("explain out --vehicle 3 --time -x", "--time <S>"),
        ("routes MAPS/ramps.osm 1 2 --most -1", "--most <N>"),
        ("compare MAPS/ramps.osm --seeds -0.0", "--seeds <N>"),
        ("view --port -1", "--port <PORT>"),
        ("render --size -1x2", "--size <WxH>"),
    ] {
        let refused = answer(&folder, line);
        assert!(refused.contains(option) && !refused.contains("unexpected argument"), "{line}: {refused}");
    }
    let west = "render MAPS/ramps.osm --camera -100,0,300 --size 64x64 --until 0.5 --out frames";
    assert_eq!(folder.laneweave(west).code(), 0);
    // An option is not taken for a path, nor for a value that may be left out.
    assert!(answer(&folder, "run m.osm --out --quiet").contains("a value is required for '--out <DIR>'"));
    assert!(answer(&folder, "fit t.csv --judge --typo").contains("unexpected argument '--typo'"));
}
