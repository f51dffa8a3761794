//! Apache Parquet: columns that may be null, in groups of rows. Integers are stored by their differences, repeating
//! values by dictionaries; there is no other compression.

use std::fs::File;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use parquet::basic::{Encoding, LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::FileReader;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::Field;
use parquet::schema::types::{ColumnPath, Type};

use super::read::{ReadError, TextTable};
use super::{Cell, Cells, Column, Kind, sound};

/// Rows that are held in memory and written together.
const ROW_GROUP: usize = 1 << 14;
/// Values in a page. Encoded pages grow to their size; small ones reuse the memory of the previous ones.
const PAGE: usize = 1 << 12;
/// A column with more distinct values in a group than fit into this continues without a dictionary [bytes].
const DICTIONARY_SIZE: usize = 1 << 16;
/// Definition levels of an optional column: for a present value, and for null.
const PRESENT: i16 = 1;
const NULL: i16 = 0;

/// Writes rows of cells that fit the columns.
pub(super) struct ParquetSink {
    writer: SerializedFileWriter<File>,
    columns: Vec<Buffer>,
    rows: usize,
    /// The levels of columns without missing values.
    all_present: Vec<i16>,
}

/// The values of one column that are not yet written.
struct Buffer {
    /// One for each row; empty as long as no value is missing.
    levels: Vec<i16>,
    rows: usize,
    /// The present values.
    values: Values,
}

enum Values {
    F64(Vec<f64>),
    I64(Vec<i64>),
    Text(Vec<ByteArray>, Texts),
}

/// Texts so far, so that a repeated text takes no memory of its own.
#[derive(Default)]
struct Texts(Vec<ByteArray>);

impl Texts {
    /// Maximum of remembered texts: the search would take too long.
    const MOST: usize = 32;

    fn get(&mut self, text: &str) -> ByteArray {
        if let Some(known) = self.0.iter().find(|it| it.data() == text.as_bytes()) {
            return known.clone();
        }
        let new = ByteArray::from(text);
        if self.0.len() < Texts::MOST {
            self.0.push(new.clone());
        }
        new
    }
}

impl ParquetSink {
    pub(super) fn new(file: File, columns: &[Column], notes: &[(&str, &str)]) -> io::Result<ParquetSink> {
        let fields = columns.iter().map(field).collect::<Result<_, _>>().map_err(io::Error::other)?;
        let schema =
            Type::group_type_builder("table").with_fields(fields).build().map_err(io::Error::other)?;
        let properties = Arc::new(properties(columns, notes));
        let writer =
            SerializedFileWriter::new(file, Arc::new(schema), properties).map_err(io::Error::other)?;
        let columns = columns.iter().map(|it| Buffer::new(it.kind)).collect();
        Ok(ParquetSink { writer, columns, rows: 0, all_present: Vec::new() })
    }

    pub(super) fn row(&mut self, cells: &[Cell<'_>]) -> io::Result<()> {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.push(cell);
        }
        self.go_on(1)
    }

    /// Writes `count` rows at once; a group may exceed its size by as many.
    pub(super) fn rows(&mut self, count: usize, columns: &[Cells<'_>]) -> io::Result<()> {
        for (column, cells) in self.columns.iter_mut().zip(columns) {
            column.extend(*cells);
        }
        self.go_on(count)
    }

    fn go_on(&mut self, rows: usize) -> io::Result<()> {
        self.rows += rows;
        if self.rows >= ROW_GROUP { self.flush().map_err(io::Error::other) } else { Ok(()) }
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.flush().map_err(io::Error::other)?;
        self.writer.close().map_err(io::Error::other)?;
        Ok(())
    }

    fn flush(&mut self) -> Result<(), ParquetError> {
        if self.rows == 0 {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        self.all_present.resize(self.rows, PRESENT);
        for column in &mut self.columns {
            column.write(&mut group, &self.all_present)?;
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }
}

/// The encoding of the columns, and its metadata.
fn properties(columns: &[Column], notes: &[(&str, &str)]) -> WriterProperties {
    let notes = notes.iter().map(|(key, value)| KeyValue::new((*key).to_owned(), (*value).to_owned()));
    let properties = WriterProperties::builder()
        .set_dictionary_page_size_limit(DICTIONARY_SIZE)
        .set_statistics_enabled(EnabledStatistics::None)
        .set_data_page_row_count_limit(PAGE)
        .set_key_value_metadata(Some(notes.collect()));
    let properties = columns.iter().fold(properties, |it, column| {
        let name = || ColumnPath::from(&*column.name);
        match (column.kind, column.repeats) {
            // Mainly times: by their minimum and maximum a reader finds the groups with the rows that it needs.
            (Kind::F64, true) => it.set_column_statistics_enabled(name(), EnabledStatistics::Chunk),
            (Kind::F64, false) => it.set_column_dictionary_enabled(name(), false),
            // The number of a vehicle or lanelet changes little from row to row.
            (Kind::I64, _) => it
                .set_column_dictionary_enabled(name(), false)
                .set_column_encoding(name(), Encoding::DELTA_BINARY_PACKED),
            (Kind::Text, _) => it,
        }
    });
    properties.build()
}

/// The schema of a column.
fn field(column: &Column) -> Result<Arc<Type>, ParquetError> {
    let (physical, logical) = match column.kind {
        Kind::F64 => (PhysicalType::DOUBLE, None),
        Kind::I64 => (PhysicalType::INT64, None),
        Kind::Text => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()
        .map(Arc::new)
}

impl Values {
    /// Reserves memory for a group and a further batch at once: growing step by step would fragment memory.
    fn reserve(&mut self, more: usize) {
        fn make_room<T>(values: &mut Vec<T>, more: usize) {
            if values.capacity() < values.len() + more {
                values.reserve_exact(ROW_GROUP + more);
            }
        }
        match self {
            Values::F64(values) => make_room(values, more),
            Values::I64(values) => make_room(values, more),
            Values::Text(values, _) => make_room(values, more),
        }
    }
}

impl Buffer {
    fn new(kind: Kind) -> Buffer {
        let values = match kind {
            Kind::F64 => Values::F64(Vec::new()),
            Kind::I64 => Values::I64(Vec::new()),
            Kind::Text => Values::Text(Vec::new(), Texts::default()),
        };
        Buffer { levels: Vec::new(), rows: 0, values }
    }

    fn push(&mut self, cell: &Cell<'_>) {
        let is_present = match (&mut self.values, cell) {
            (Values::F64(values), Cell::F64(value)) if !value.is_nan() => {
                values.push(*value);
                true
            }
            (Values::I64(values), Cell::I64(value)) => {
                values.push(*value);
                true
            }
            (Values::Text(values, texts), Cell::Text(value)) => {
                values.push(texts.get(value));
                true
            }
            _ => false,
        };
        if !is_present && self.levels.is_empty() {
            self.levels.resize(self.rows, PRESENT);
        }
        if !is_present || !self.levels.is_empty() {
            self.levels.push(if is_present { PRESENT } else { NULL });
        }
        self.rows += 1;
    }

    fn extend(&mut self, cells: Cells<'_>) {
        self.values.reserve(cells.len());
        let misses_nothing = |values: &[f64]| values.iter().all(|it| !it.is_nan());
        match (&mut self.values, cells) {
            (Values::F64(all), Cells::F64(values)) if misses_nothing(values) => all.extend_from_slice(values),
            (Values::I64(all), Cells::I64(values)) => all.extend_from_slice(values),
            (Values::Text(values, known), Cells::Text(places, texts)) => {
                let texts: Vec<ByteArray> = texts.iter().map(|it| known.get(it)).collect();
                values.extend(places.iter().map(|it| texts[*it as usize].clone()));
            }
            _ => return (0..cells.len()).for_each(|it| self.push(&cells.get(it))),
        }
        self.rows += cells.len();
        if !self.levels.is_empty() {
            self.levels.resize(self.rows, PRESENT);
        }
    }

    /// Writes the next column of `group` and empties itself.
    fn write(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, File>,
        all_present: &[i16],
    ) -> Result<(), ParquetError> {
        let levels = if self.levels.is_empty() { &all_present[..self.rows] } else { &self.levels };
        match &mut self.values {
            Values::F64(values) => {
                write_column::<DoubleType>(group, values, levels)?;
                values.clear();
            }
            Values::I64(values) => {
                write_column::<Int64Type>(group, values, levels)?;
                values.clear();
            }
            Values::Text(values, _) => {
                write_column::<ByteArrayType>(group, values, levels)?;
                values.clear();
            }
        }
        self.levels.clear();
        self.rows = 0;
        Ok(())
    }
}

fn write_column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, File>,
    values: &[T::T],
    levels: &[i16],
) -> Result<(), ParquetError> {
    // There is one writer for each column of the schema, in its order.
    let Some(mut column) = group.next_column()? else {
        return Ok(());
    };
    column.typed::<T>().write_batch(values, Some(levels), None)?;
    column.close()
}

/// The table in `file`.
pub(super) fn read(file: File) -> Result<TextTable, ReadError> {
    // The reader of the crate panics on some damaged files.
    let read = catch_unwind(AssertUnwindSafe(|| read_rows(file)));
    let read = read.unwrap_or_else(|_| Err(sound::damaged()));
    read.map_err(|error| ReadError::Content(format!("it cannot be read as Parquet: {error}")))
}

fn read_rows(file: File) -> Result<TextTable, ParquetError> {
    let reader = sound::open(file)?;
    let schema = reader.metadata().file_metadata().schema_descr();
    let columns = schema.columns().iter().map(|it| it.name().to_owned()).collect();
    let mut table = TextTable { columns, rows: Vec::new() };
    for row in reader.get_row_iter(None)? {
        let row = row?;
        let cells = row.get_column_iter().map(|(_, field)| match field {
            Field::Null => None,
            Field::Str(text) => Some(text.clone()),
            Field::Double(value) => Some(zmij::Buffer::new().format(*value).to_owned()),
            other => Some(other.to_string()),
        });
        table.rows.push(cells.collect());
    }
    Ok(table)
}
