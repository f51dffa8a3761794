//! Files of commands: written by hand, and wrong ones.

use std::fs;
use std::path::PathBuf;

use super::runs::{folder, refused, run, scenario, simulation, tables};

const INSERT: &str =
    r#"{""lanelet"":5,""position_m"":60,""speed_mps"":20,""class"":""car"",""style"":""aggressive""}"#;

fn file(name: &str, text: &str) -> PathBuf {
    let path = folder(name).join("commands.csv");
    fs::write(&path, text).expect("it is written");
    path
}

#[test]
fn commands_can_be_written_by_hand_in_any_order() {
    let mut own = scenario("motorway_2_lanes.osm", 500.0, 30.0);
    let text = format!(
        "act,time_s,values,id\nremove,20,4000000,\nset_style,9.96,\"[4000000,\"\"conservative\"\"]\",\ninsert,5,\"{INSERT}\",4000000\n"
    );
    own.commands = Some(file("by-hand", &text));
    let dir = folder("by-hand-out");
    let summary = run(&own, &dir);
    assert_eq!((summary.inserted, summary.removed, summary.commands_refused), (1, 1, 0));
    assert_eq!(summary.entered, summary.completed + summary.on_road + summary.removed);
    let (_, table) = tables(&dir).into_iter().find(|(name, _)| name == "commands.csv").expect("it is there");
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|it| it.splitn(5, ',').collect()).collect();
    let id = rows[0][2];
    let of = |row: usize| [rows[row][0], rows[row][1], rows[row][2], rows[row][3]];
    assert_eq!(of(0), ["5.0", "vehicle", id, "insert"]);
    // The first step from this time on.
    assert_eq!(of(1), ["10.0", "vehicle", id, "set_style"]);
    assert_eq!((of(2), rows[2][4]), (["20.0", "vehicle", id, "remove"], id));
}

#[test]
fn an_offset_concerns_its_light() {
    let mut own = scenario("town.osm", 500.0, 10.0);
    let light = simulation(&own).lights().first().expect("a light").id;
    let row =
        format!("2.0,light,{light},set_offset,\"{{\"\"light\"\":\"\"{light}\"\",\"\"offset_s\"\":12.5}}\"\n");
    own.commands = Some(file("offset", &format!("time_s,target,id,act,values\n{row}")));
    let dir = folder("offset-out");
    assert_eq!(run(&own, &dir).commands_refused, 0);
    let table = fs::read_to_string(dir.join("commands.csv")).expect("it is there");
    assert_eq!(table.lines().nth(1), Some(row.trim_end()));
}

#[test]
fn what_is_no_longer_possible_is_counted_and_the_run_goes_on() {
    let mut own = scenario("motorway_2_lanes.osm", 500.0, 30.0);
    let text = format!(
        "time_s,act,values,id\n0,remove,77,\n1,remove,99,\n2,insert,\"{INSERT}\",99\n2,insert,\"{INSERT}\",98\n\
         3,remove,98,\n4,remove,99,\n"
    );
    own.commands = Some(file("refused", &text));
    own.output.dir = folder("refused-out");
    let begun = laneweave::run::Run::begin(&own, &laneweave::scenario::Origin::default(), "a test");
    let ended = begun.and_then(|it| it.complete(|_| true)).expect("it ends");
    assert_eq!((ended.summary.inserted, ended.summary.removed, ended.summary.commands_refused), (1, 1, 4));
    let ends = [
        "row 1 (at 0 s): vehicle 77 is not on the road: it has left, was removed, or has not entered yet; ask which vehicles \
         there are",
        "row 2 (at 1 s): vehicle 99 was not inserted before",
    ];
    for (line, end) in ended.warnings.iter().zip(ends) {
        assert!(line.ends_with(end), "{line}");
    }
    assert!(
        ended.warnings[2].contains("row 4 (at 2 s): nothing can be put at 60.0 m of lanelet 5: vehicle ")
    );
    assert_eq!(ended.warnings[3], "1 more commands were refused");
}

#[test]
fn a_wrong_file_is_refused_with_its_row_and_a_remedy() {
    let told = |text: &str| {
        let mut own = scenario("motorway_2_lanes.osm", 500.0, 30.0);
        own.commands = Some(file("wrong", text));
        refused(&own).to_string()
    };
    let row = |cells: &str| told(&format!("time_s,target,id,act,values\n0,vehicle,5,remove,5\n{cells}\n"));
    for (cells, end) in [
        ("soon,,,remove,5", "row 2: a time_s of \"soon\"; give seconds from 0 to 10000000"),
        ("-0.5,,,remove,5", "row 2: a time_s of \"-0.5\"; give seconds from 0 to 10000000"),
        ("NaN,,,remove,5", "row 2: a time_s of \"NaN\"; give seconds from 0 to 10000000"),
        (",,,remove,5", "row 2: a time_s of \"\"; give seconds from 0 to 10000000"),
        ("1,,,remov,5", "row 2: unknown value \"remov\"; did you mean \"remove\"?"),
        ("1,,,set_demand,\"{\"\"origin\"\":1}\"", "row 2: the key \"vehicles_per_hour\" is missing; add it"),
        (
            "1,,,set_light,\"{\"\"light\"\":1,\"\"show\"\":null}\"",
            "row 2: unknown key \"show\"; did you mean \"shows\"?",
        ),
        ("1,,,remove,x", "write JSON, such as [7, \"aggressive\"] for the act set_style of vehicle 7"),
        ("1,,,remove,-5", "u32; correct the value"),
        (
            "1,vehicle,6,remove,5",
            "row 2: the id is 6, but the values concern vehicle 5; correct one of them, or leave the cell empty",
        ),
        (
            "1,light,5,remove,5",
            "row 2: the target is \"light\", but the values concern a vehicle; write vehicle, or leave the cell empty",
        ),
        (
            "1,,,set_demand,\"{\"\"origin\"\":1,\"\"vehicles_per_hour\"\":-1}\"",
            "row 2: a demand of -1; choose 0 to 100000 veh/h",
        ),
        ("1,,,remove,5,6", "row 2: 6 cells in a table of 5 columns; correct this row"),
        ("1,,,remove,\"5", "row 2: a quotation mark is not closed; correct this row"),
    ] {
        let told = row(cells);
        assert!(told.contains("commands.csv, row 2: ") && told.ends_with(end), "{cells}: {told}");
    }
    let told_twice = row(&format!("1,vehicle,7,insert,\"{INSERT}\"\n2,vehicle,7,insert,\"{INSERT}\""));
    assert!(told_twice.ends_with("row 3: vehicle 7 is inserted for the second time; choose another id"));
    let far = INSERT.replace("60", "1e9");
    assert!(row(&format!("1,,,insert,\"{far}\"")).contains("m long; choose 0 to "));
    assert!(told("time_s,act\n").ends_with(
        "there is no column values; a table of commands has the columns time_s, act and values: add it"
    ));
    assert!(told("").contains("there is no column time_s"));
}

#[test]
fn a_file_that_is_not_there_or_no_table_is_refused() {
    let mut own = scenario("motorway_2_lanes.osm", 500.0, 30.0);
    own.commands = Some("nowhere.csv".into());
    assert!(refused(&own).to_string().starts_with("nowhere.csv: cannot be read: "));
    own.commands = Some("commands.txt".into());
    assert!(refused(&own).to_string().contains("give a file whose name ends with .csv"));
    let path = folder("damaged").join("commands.parquet");
    fs::write(&path, "PAR1 and nothing else PAR1").expect("it is written");
    own.commands = Some(path);
    let told = refused(&own).to_string();
    assert!(told.contains("it cannot be read as Parquet"), "{told}");
}
