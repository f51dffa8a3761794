//! Tables as people have them: other separators, decimal commas, quotes, grouped digits, no header, texts as ids.

use std::fs;

use laneweave_recordings::datasets::Dataset;
use laneweave_recordings::table::{Known, Layout, read};
use laneweave_recordings::{Recording, interaction, join, open};
use laneweave_test_data::data;

use crate::datasets::folder;

const HEADER: &str = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width";

/// Two cars, a second long.
fn table(id: impl Fn(i64) -> String) -> String {
    let row = |car: i64, frame: i64| {
        let (time, x) = (100 * frame, 1000.125 + 2.0 * frame as f64);
        format!("{},{frame},{time},car,{x},{}.5,20.25,0,0.5,4.5,1.8\n", id(car), 3 * car)
    };
    let rows = (0..2).flat_map(|car| (0..11).map(move |frame| row(car, frame)));
    format!("{HEADER}\n{}", rows.collect::<String>())
}

fn plain() -> String {
    table(|it| (26 + it).to_string())
}

#[track_caller]
fn sound(text: &str) -> Recording {
    let (recording, problems) = interaction::read(text.as_bytes()).expect("it is sound");
    assert_eq!(problems, []);
    recording
}

#[test]
fn separators_decimal_commas_and_quotes_change_nothing() {
    let expected = sound(&plain());
    let quoted = |it: &str| it.lines().map(|it| format!("\"{}\"\r\n", it.replace(',', "\",\""))).collect();
    let variants: [String; 6] = [
        plain().replace(',', ";"),
        plain().replace(',', "\t"),
        plain().replace(',', ";").replace('.', ","),
        plain().replace(',', "\t").replace('.', ","),
        plain().replace(',', "  "),
        quoted(&plain()),
    ];
    for text in variants {
        assert_eq!(sound(&text), expected, "{}", &text[..200]);
    }
    let noted =
        plain().lines().map(|it| format!("\"lane 1, \"\"wet\"\"\nor not\",{it}\n")).collect::<String>();
    assert_eq!(sound(&noted.replacen("\"lane 1, \"\"wet\"\"\nor not\"", "note", 1)), expected);
    // Decimal commas in quotes between commas.
    let both = plain().replace(',', "\",\"").replace('\n', "\"\n\"");
    let both = format!("\"{}", both.trim_end_matches('"')).replace('.', ",");
    assert_eq!(sound(&both), expected);
    // A row of an export without any value.
    assert_eq!(sound(&plain().replace("\n26,5,", "\n,,,,,\n26,5,")), expected);
}

#[test]
fn a_quote_that_is_never_closed_costs_its_rows_and_no_more_memory() {
    let rows: String = (0..5000).map(|it| format!("1,{it},{}00,car,{it},0,10,0,0,4,2\n", it)).collect();
    let text = format!("{HEADER}\n{}", rows.replacen("\n1,100,", "\n\"1,100,", 1));
    let (recording, problems) = interaction::read(text.as_bytes()).expect("most of it is sound");
    let frames: Vec<i64> = recording.tracks[0].states.iter().map(|it| it.frame).collect();
    assert!(frames.contains(&99) && !frames.contains(&100) && frames.contains(&4999));
    assert!(frames.len() > 2000, "{}", frames.len());
    let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "row (line 102): it has more than 65536 bytes, so it is left out; end each row with a line feed, and close \
          every quote"
        ]
    );
}

#[test]
fn ids_with_a_decimal_are_numbers_and_texts_are_kept() {
    let expected = sound(&plain());
    assert_eq!(sound(&table(|it| format!("{}.0", 26 + it))), expected);
    let uuid = |it: i64| format!("0a1c2f9e-7d1b-4c8a-9c57-2f0d5f4a7e{it:02}");
    let named = sound(&table(uuid));
    assert_eq!(named.tracks[0].states, expected.tracks[0].states);
    let names: Vec<String> = named.tracks.iter().map(|it| named.name(it.id)).collect();
    assert_eq!(names, [uuid(0), uuid(1)]);
    let mut written = Vec::new();
    interaction::write(&named, &mut written).expect("it can be written");
    let again = sound(str::from_utf8(&written).expect("it is text"));
    assert_eq!(again.names, named.names);
    // Numbers and texts in one table stay apart, whatever the numbers are.
    let mixed =
        sound(&table(|it| if it == 0 { "one, two".into() } else { i64::MAX.to_string() }.replace(", ", " ")));
    assert_eq!(mixed.tracks[1].id, i64::MAX);
    assert_eq!(mixed.name(mixed.tracks[0].id), "one two");
}

#[test]
fn windows_are_joined_by_texts_as_ids() {
    // The second window has its vehicles in another order, and one more.
    let window = |frames: std::ops::Range<i64>, cars: &[i64]| {
        let row = |car: i64, frame: i64| {
            format!("veh_{car},{frame},{},car,{},{car},20,0,0,4,2\n", 100 * frame, 2 * frame)
        };
        let rows = cars.iter().flat_map(|car| frames.clone().map(|frame| row(*car, frame)));
        sound(&format!("{HEADER}\n{}", rows.collect::<String>()))
    };
    let joined = join(vec![window(0..20, &[0, 5]), window(20..40, &[9, 5, 0])]).expect("they go on");
    assert_eq!((joined.continued, joined.renamed), (2, 0));
    let recording = joined.recording;
    let tracks = recording.tracks.iter().map(|it| (recording.name(it.id), it.states.len()));
    assert_eq!(
        tracks.collect::<Vec<_>>(),
        [("veh_0".into(), 40), ("veh_5".into(), 40), ("veh_9".into(), 20)]
    );
}

#[test]
fn ngsim_has_grouped_digits_and_text_files_without_a_header() {
    let header = "Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_Length,v_Width,\
                  v_Class,v_Vel,v_Acc,Lane_ID,Preceding,Following,Space_Hdwy,Time_Hdwy";
    let rows = |comma: &str, class: &str| {
        let row = |it: i64| {
            let (time, place) = (846_980_200 + 100 * it, 123 + 4 * it);
            let time = format!(
                "1{comma}118{comma}{:03}{comma}{:03}{comma}{:03}",
                time / 1_000_000,
                time / 1000 % 1000,
                time % 1000
            );
            let place = format!("\"2{comma}{place}.5\"");
            format!(
                "27,{it},40,\"{time}\",17.5,{place},6454415.049,1873017.19,14.8,5.9,{class},40.5,0,1,0,0,0,0\n"
            )
        };
        (0..40).map(row).collect::<String>()
    };
    let layout = Dataset::Ngsim.layout();
    let read = |text: &str| read(text.as_bytes(), &layout, &Known::default()).expect("it is sound");
    let (expected, problems) = read(&format!("{header}\n{}", rows("", "2")));
    assert_eq!((expected.tracks.len(), expected.tracks[0].states.len(), problems), (1, 40, vec![]));
    assert_eq!(expected.step, 0.1);
    assert_eq!(read(&format!("{header}\n{}", rows(",", "2.0"))).0, expected);
    let aligned = rows("", "2").replace('"', "").replace(',', "   ").replace("27 ", "   27 ");
    assert_eq!(Dataset::of_start(aligned.as_bytes()), Some(Dataset::Ngsim));
    assert_eq!(read(&aligned).0, expected);
}

#[test]
fn columns_and_files_that_are_not_used_and_would_change_what_is_read_are_named_once() {
    let folder = folder("unused");
    let path = folder.join("01_tracks.csv");
    let text = "who,n,x,y,Speed,yaw,note,recordingId\n1,0,0,0,9,0,a,1\n1,1,1,0,9,0,b,1\n";
    fs::write(&path, text).expect("it can be written");
    fs::write(folder.join("01_tracksMeta.csv"), "id,class\n1,Car\n").expect("it can be written");
    let layout = "frames_per_second = 10\n[columns]\ntrack = \"who\"\nframe = \"n\"\nx = \"x\"\ny = \"y\"\n";
    let says = |layout: &str| {
        let (_, problems) =
            open(&path, Some(&Layout::parse(layout).expect("it is one"))).expect("it is read");
        problems.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let said = says(layout);
    assert_eq!(
        said[..2],
        [
            "the dataset: 01_tracksMeta.csv lies beside the table and is not read; leave out --columns if the table is \
             one of a dataset that is known",
            "the header (line 1): its columns Speed, yaw, recordingId are not used; name them in the file for \
             --columns, or leave them out of the table",
        ]
    );
    let said = says(&format!("same = \"recordingId\"\n{layout}speed = \"Speed\"\nheading = \"yaw\"\n"));
    assert!(!said.iter().any(|it| it.contains("are not used")), "{said:?}");
    let (vehicles, walkers) = ("vehicle_tracks_000.csv", "pedestrian_tracks_000.csv");
    for name in [vehicles, walkers] {
        fs::write(folder.join(name), plain()).expect("it can be written");
    }
    let (_, problems) = open(&folder.join(vehicles), None).expect("it is sound");
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(problems[0].what.starts_with(walkers), "{problems:?}");
}

#[test]
fn a_table_of_several_cases_is_refused() {
    let rows = plain().replace("\n26,", "\n1.0,26,").replace("\n27,", "\n2.0,27,");
    let text = format!("case_id,{rows}");
    let said = interaction::read(text.as_bytes()).expect_err("it holds two").to_string();
    assert!(said.starts_with("line 13: case_id is \"2.0\", and \"1.0\" above"), "{said}");
}

#[test]
fn small_cases_of_other_peoples_tables_are_read() {
    let case = |name: &str| {
        let path = data(&format!("cases/{name}"))?;
        let (recording, problems) = open(&path, None).expect("it is read");
        assert_eq!(problems, [], "{name}");
        Some(recording)
    };
    let Some(first) = case("10_float_ids.csv") else { return };
    assert_eq!(first.tracks.iter().map(|it| it.states.len()).sum::<usize>(), 399);
    for name in ["09_quoted_comma.csv", "12_semicolon_decimal_comma.csv"] {
        assert_eq!(case(name).as_ref(), Some(&first), "{name}");
    }
    let texts = case("11_string_ids.csv").expect("it is there");
    assert_eq!(texts.name(texts.tracks[0].id), "veh_26");
    assert!(texts.tracks.iter().zip(&first.tracks).all(|(a, b)| a.states == b.states));
    let ngsim = case("14_ngsim_thousands.csv").expect("it is there");
    assert_eq!(ngsim.tracks.iter().map(|it| it.states.len()).sum::<usize>(), 199);
}
