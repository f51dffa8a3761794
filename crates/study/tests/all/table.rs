//! Tables that are written and read again.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use laneweave_study::{Cell, Cells, Column, Format, TableError, TableWriter, TextTable};
use parquet::basic::Encoding;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};

const ROWS_OF_A_GROUP: usize = 16_384;

struct Trajectory<'a> {
    time_s: f64,
    vehicle: u32,
    class: &'a str,
    style: &'a str,
    lanelet: i64,
    position_m: f64,
    offset_m: f64,
    x_m: f64,
    y_m: f64,
    z_m: Option<f64>,
    heading_rad: f64,
    speed_mps: f64,
    acceleration_mps2: f64,
    length_m: f64,
    width_m: f64,
    state: Option<&'a str>,
}

impl Trajectory<'_> {
    const COLUMNS: [Column; 16] = [
        Column::real("time_s"),
        Column::integer("vehicle"),
        Column::text("class"),
        Column::text("style"),
        Column::integer("lanelet"),
        Column::real("position_m"),
        Column::real("offset_m"),
        Column::real("x_m"),
        Column::real("y_m"),
        Column::real("z_m"),
        Column::real("heading_rad"),
        Column::real("speed_mps"),
        Column::real("acceleration_mps2"),
        Column::real("length_m"),
        Column::real("width_m"),
        Column::text("state"),
    ];

    fn cells(&self) -> [Cell<'_>; 16] {
        [
            self.time_s.into(),
            self.vehicle.into(),
            self.class.into(),
            self.style.into(),
            self.lanelet.into(),
            self.position_m.into(),
            self.offset_m.into(),
            self.x_m.into(),
            self.y_m.into(),
            self.z_m.into(),
            self.heading_rad.into(),
            self.speed_mps.into(),
            self.acceleration_mps2.into(),
            self.length_m.into(),
            self.width_m.into(),
            self.state.into(),
        ]
    }
}

/// The row of one of a hundred vehicles; every third has no height, every fifth no state.
fn trajectory(index: usize) -> Trajectory<'static> {
    let (second, vehicle) = (index / 100, index % 100);
    let along = second as f64 * 23.7 + vehicle as f64 / 3.0;
    Trajectory {
        time_s: second as f64,
        vehicle: vehicle as u32,
        class: ["car", "truck"][vehicle % 2],
        style: ["aggressive", "conservative, \"old\"", ""][vehicle % 3],
        lanelet: -((vehicle as i64) << 40),
        position_m: along,
        offset_m: -0.1,
        x_m: 458_900.0 + along.cos(),
        y_m: 5_428_000.0 + along.sin(),
        z_m: (!index.is_multiple_of(3)).then_some(112.5),
        heading_rad: along.sin(),
        speed_mps: 1e-9 * along,
        acceleration_mps2: if index == 7 { f64::NAN } else { -along.cos() },
        length_m: 4.5,
        width_m: if index == 8 { f64::INFINITY } else { 1.8 },
        state: (!index.is_multiple_of(5)).then_some("keep"),
    }
}

/// An empty folder for this test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the test's folder");
    entries.flatten().map(|it| it.file_name().to_string_lossy().into_owned()).collect()
}

fn write(path: &Path, format: Format, rows: usize) -> Result<(), TableError> {
    let mut table = TableWriter::create(path, format, &Trajectory::COLUMNS)?;
    for index in 0..rows {
        table.row(&trajectory(index).cells())?;
    }
    table.finish()
}

fn assert_reads_back(row: &Row, index: usize) {
    for ((name, field), (column, cell)) in
        row.get_column_iter().zip(Trajectory::COLUMNS.iter().zip(trajectory(index).cells()))
    {
        assert_eq!(name, &column.name);
        let is_same = match (field, cell) {
            (Field::Null, Cell::F64(value)) => value.is_nan(),
            (Field::Null, Cell::Missing) => true,
            (Field::Double(read), Cell::F64(value)) => *read == value,
            (Field::Long(read), Cell::I64(value)) => *read == value,
            (Field::Str(read), Cell::Text(value)) => read == value,
            _ => false,
        };
        assert!(is_same, "row {index}, {name}: {field} instead of {cell:?}");
    }
}

#[test]
fn a_parquet_table_of_several_row_groups_reads_back_cell_by_cell() {
    let path = folder("parquet").join("trajectories.parquet");
    let rows = 2 * ROWS_OF_A_GROUP + 1000;
    write(&path, Format::Parquet, rows).unwrap();
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let sizes: Vec<i64> = reader.metadata().row_groups().iter().map(|it| it.num_rows()).collect();
    assert_eq!(sizes, [16_384, 16_384, 1000]);
    let mut count = 0;
    for (index, row) in reader.get_row_iter(None).unwrap().enumerate() {
        let row = row.unwrap();
        assert_eq!(row.len(), 16);
        assert_reads_back(&row, index);
        count += 1;
    }
    assert_eq!(count, rows);
}

#[test]
fn parquet_keeps_repeated_texts_in_a_dictionary() {
    let path = folder("dictionary").join("trajectories.parquet");
    write(&path, Format::Parquet, 10_000).unwrap();
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let class = reader.metadata().row_group(0).column(2);
    assert!(class.encodings().any(|it| it == Encoding::RLE_DICTIONARY));
    assert!(class.uncompressed_size() < 2000, "{} bytes", class.uncompressed_size());
}

#[test]
fn rows_that_are_given_by_columns_are_the_same_as_one_by_one() {
    let columns = [Column::real("x_m"), Column::integer("vehicle"), Column::text("class")];
    let folder = folder("columns");
    let x: Vec<f64> = (0..20_000).map(|it| if it % 700 == 3 { f64::NAN } else { f64::from(it) }).collect();
    let vehicles: Vec<i64> = (0..20_000).map(|it| it % 90).collect();
    const CLASSES: [&str; 3] = ["car", "", "truck"];
    let classes: Vec<u32> = (0..20_000).map(|it| it % 3).collect();
    for (format, name) in [(Format::Csv, "csv"), (Format::Parquet, "parquet")] {
        let [one, many] = ["one", "many"].map(|it| folder.join(format!("{it}.{name}")));
        let mut table = TableWriter::create(&one, format, &columns).unwrap();
        for row in 0..x.len() {
            table.row(&[x[row].into(), vehicles[row].into(), CLASSES[row % 3].into()]).unwrap();
        }
        table.finish().unwrap();
        let mut table = TableWriter::create(&many, format, &columns).unwrap();
        table.row(&[x[0].into(), vehicles[0].into(), CLASSES[0].into()]).unwrap();
        for part in [1..2, 2..2, 2..16_000, 16_000..20_000] {
            let columns = [
                Cells::F64(&x[part.clone()]),
                Cells::I64(&vehicles[part.clone()]),
                Cells::Text(&classes[part], &CLASSES),
            ];
            table.rows(&columns).unwrap();
        }
        let wrong =
            table.rows(&[Cells::F64(&x), Cells::I64(&vehicles[1..]), Cells::Text(&classes, &CLASSES)]);
        assert!(matches!(wrong, Err(TableError::Width { cells: 2, columns: 3, .. })));
        table.finish().unwrap();
        if format == Format::Csv {
            assert_eq!(fs::read(&one).unwrap(), fs::read(&many).unwrap());
            continue;
        }
        let [one, many] = [one, many].map(|it| {
            let reader = SerializedFileReader::new(File::open(it).unwrap()).unwrap();
            let rows: Vec<String> =
                reader.get_row_iter(None).unwrap().map(|it| it.unwrap().to_string()).collect();
            rows
        });
        assert_eq!((one.len(), one), (20_000, many));
    }
}

#[test]
fn notes_stand_in_the_parquet_file_and_nowhere_in_the_csv() {
    let folder = folder("notes");
    let notes = [("laneweave.seed", "7"), ("laneweave.scenario", "map = \"a.osm\"\n")];
    for (format, name) in [(Format::Csv, "t.csv"), (Format::Parquet, "t.parquet")] {
        let columns = [Column::real("time_s")];
        TableWriter::create_with(&folder.join(name), format, &columns, &notes).unwrap().finish().unwrap();
    }
    assert_eq!(fs::read_to_string(folder.join("t.csv")).unwrap(), "time_s\n");
    let reader = SerializedFileReader::new(File::open(folder.join("t.parquet")).unwrap()).unwrap();
    let noted = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let noted: Vec<(&str, Option<&str>)> =
        noted.iter().map(|it| (it.key.as_str(), it.value.as_deref())).collect();
    assert_eq!(noted, notes.map(|(key, value)| (key, Some(value))));
}

#[test]
fn numbers_that_come_once_are_written_plainly_and_those_that_repeat_in_a_dictionary() {
    let path = folder("plain").join("t.parquet");
    let columns = [Column::real("x_m"), Column::real("length_m").repeating()];
    let mut table = TableWriter::create(&path, Format::Parquet, &columns).unwrap();
    (0..1000).for_each(|it| table.row(&[Cell::F64(f64::from(it)), Cell::F64(4.5)]).unwrap());
    table.finish().unwrap();
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let has_dictionary = |column: usize| {
        reader.metadata().row_group(0).column(column).encodings().any(|it| it == Encoding::RLE_DICTIONARY)
    };
    assert_eq!([0, 1].map(has_dictionary), [false, true]);
}

#[test]
fn a_csv_row_is_the_shortest_text_that_reads_back() {
    let path = folder("csv").join("trajectories.csv");
    write(&path, Format::Csv, 9).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let names: Vec<String> = Trajectory::COLUMNS.iter().map(|it| it.name.to_string()).collect();
    assert_eq!((lines.len(), lines[0]), (10, names.join(",").as_str()));
    assert_eq!(
        lines[1], "0.0,0,car,aggressive,0,0.0,-0.1,458901.0,5428000.0,,0.0,0.0,-1.0,4.5,1.8,",
        "a row with two missing values"
    );
    assert!(
        lines[2].starts_with("0.0,1,truck,\"conservative, \"\"old\"\"\",-1099511627776,0.3333333333333333,")
    );
    assert!(lines[3].starts_with("0.0,2,car,\"\",-2199023255552,0.6666666666666666,"));
    assert!(lines[8].ends_with(",,4.5,1.8,keep"), "{}", lines[8]);
    assert!(lines[9].ends_with(",4.5,inf,keep"), "{}", lines[9]);
}

#[test]
fn every_number_of_a_long_csv_reads_back_exactly() {
    let path = folder("exact").join("trajectories.csv");
    write(&path, Format::Csv, 5000).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text.lines().count(), 5001);
    for (index, line) in text.lines().skip(1).enumerate() {
        let from_the_end: Vec<&str> = line.rsplit(',').collect();
        let expected = trajectory(index);
        assert_eq!(from_the_end[8].parse(), Ok(expected.x_m), "{line}");
        assert_eq!(from_the_end[4].parse(), Ok(expected.speed_mps), "{line}");
    }
}

#[test]
fn a_table_has_its_name_only_when_it_is_finished() {
    for (format, name) in [(Format::Csv, "t.csv"), (Format::Parquet, "t.parquet")] {
        let folder = folder(&format!("partial-{name}"));
        let table = TableWriter::create(&folder.join(name), format, &[Column::real("time_s")]).unwrap();
        assert_eq!(files(&folder), [format!("{name}.partial")]);
        table.finish().unwrap();
        assert_eq!(files(&folder), [name]);
    }
}

#[test]
fn an_unfinished_table_leaves_nothing_and_the_old_one_as_it_was() {
    let folder = folder("dropped");
    let path = folder.join("t.csv");
    fs::write(&path, "old").unwrap();
    let mut table = TableWriter::create(&path, Format::Csv, &[Column::integer("vehicle")]).unwrap();
    table.row(&[Cell::I64(1)]).unwrap();
    drop(table);
    assert_eq!(files(&folder), ["t.csv"]);
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
}

#[test]
fn a_row_that_does_not_fit_is_refused_and_not_written() {
    let path = folder("misfit").join("t.csv");
    let columns = [Column::integer("vehicle"), Column::text("class")];
    let mut table = TableWriter::create(&path, Format::Csv, &columns).unwrap();
    let short = table.row(&[Cell::I64(1)]).unwrap_err().to_string();
    assert!(short.ends_with("t.csv: a row of 1 cells for 2 columns"), "{short}");
    let wrong = table.row(&[Cell::I64(1), Cell::F64(2.5)]).unwrap_err().to_string();
    assert!(wrong.ends_with("t.csv: column class holds Text, not F64(2.5)"), "{wrong}");
    table.row(&[Cell::I64(1), Cell::Missing]).unwrap();
    table.finish().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "vehicle,class\n1,\n");
}

#[test]
fn an_error_names_the_file() {
    let path = folder("nowhere").join("no-such-folder").join("t.csv");
    let error = TableWriter::create(&path, Format::Csv, &[]).err().unwrap();
    assert!(matches!(error, TableError::Create { .. }));
    assert!(error.to_string().starts_with(&path.display().to_string()));
}

#[test]
fn what_is_written_is_read_again_the_same_from_both_formats() {
    let folder = folder("again");
    let columns = [Column::real("time_s"), Column::integer("id"), Column::text("values")];
    let numbers = [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1e22];
    let read = [("t.csv", Format::Csv), ("t.parquet", Format::Parquet)].map(|(name, format)| {
        let path = folder.join(name);
        let mut table = TableWriter::create(&path, format, &columns).unwrap();
        for number in numbers {
            table.row(&[number.into(), i64::MIN.into(), "{\"a\":\n[1,2]}".into()]).unwrap();
        }
        table.row(&[Cell::Missing, Cell::Missing, "".into()]).unwrap();
        table.finish().unwrap();
        TextTable::read(&path).unwrap()
    });
    assert_eq!(read[0], read[1]);
    assert_eq!((read[0].columns.len(), read[0].column("id")), (3, Some(1)));
    for (row, number) in read[0].rows.iter().zip(numbers) {
        let time: f64 = row[0].as_deref().unwrap().parse().unwrap();
        assert_eq!(time.to_bits(), number.to_bits());
        assert_eq!(row[1..], [Some(i64::MIN.to_string()), Some("{\"a\":\n[1,2]}".into())]);
    }
    assert_eq!(read[0].rows[numbers.len()], [None, None, Some(String::new())]);
}

#[test]
fn what_is_no_table_is_refused() {
    let folder = folder("no-table");
    let refused = |name: &str, bytes: &[u8]| {
        fs::write(folder.join(name), bytes).unwrap();
        TextTable::read(&folder.join(name)).unwrap_err().to_string()
    };
    assert!(refused("t.parquet", b"no parquet").starts_with("it cannot be read as Parquet: "));
    assert!(refused("t.txt", b"a,b\n").contains("a file whose name ends with .csv or .parquet"));
    assert!(refused("t.csv", b"\xff\xfe").starts_with("cannot be read: "));
    assert!(TextTable::read(&folder.join("none.csv")).is_err());
}

#[test]
fn a_damaged_parquet_table_is_refused_or_read_but_breaks_nothing() {
    let path = folder("damaged").join("t.parquet");
    let columns = [Column::real("time_s"), Column::integer("id"), Column::text("values")];
    let mut table = TableWriter::create(&path, Format::Parquet, &columns).unwrap();
    for row in 0_u32..20 {
        table.row(&[f64::from(row).into(), row.into(), "{}".into()]).unwrap();
    }
    table.finish().unwrap();
    let whole = fs::read(&path).unwrap();
    let mut refused = 0;
    for place in 0..whole.len() {
        for by in [1, 0x80, 0xff] {
            let mut damaged = whole.clone();
            damaged[place] ^= by;
            fs::write(&path, damaged).unwrap();
            refused += usize::from(TextTable::read(&path).is_err());
        }
    }
    assert!(refused > 100, "{refused}");
}
