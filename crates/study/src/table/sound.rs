//! Parquet files that take no more time and memory than their size accounts for. The reader of the crate believes the
//! lengths that a file gives: a kilobyte could ask for two gigabytes, or for minutes. Here they are checked first.

use std::fs::File;
use std::io::Read;

use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, RowGroupMetaData};
use parquet::file::reader::{ChunkReader, FileReader, Length, SerializedFileReader};

use super::thrift::length;

/// The end of a file: the length of its metadata, and four letters [B].
const END: u64 = 8;
/// A page is at most so much larger than its compressed bytes: Snappy writes at least 3 bytes for 64.
const MOST_TIMES: u64 = 32;
/// The headers of most pages are shorter than this, and of all others than that [B].
const HEADERS: [u64; 2] = [1 << 10, 1 << 24];

/// The reader of `file`.
///
/// # Errors
/// If it is no Parquet file, is damaged, or compressed in a way that is not supported.
pub fn open(file: File) -> Result<SerializedFileReader<File>, ParquetError> {
    check_metadata(&file)?;
    let reader = SerializedFileReader::new(file.try_clone()?)?;
    let mut columns = reader.metadata().row_groups().iter().flat_map(RowGroupMetaData::columns);
    columns.try_for_each(|it| check_pages(&file, it))?;
    Ok(reader)
}

/// A file that is damaged.
pub fn damaged() -> ParquetError {
    ParquetError::General("it is damaged".into())
}

/// Checks the length of the metadata. What is no Parquet file at all is left to the reader, which says so.
fn check_metadata(file: &File) -> Result<(), ParquetError> {
    let Some(end) = file.len().checked_sub(END) else { return Ok(()) };
    let last = file.get_bytes(end, END as usize)?;
    let (size, letters) = last.split_at(4);
    let size = u64::from(u32::from_le_bytes([size[0], size[1], size[2], size[3]]));
    if letters != b"PAR1" || size > end {
        return Ok(());
    }
    let metadata = file.get_bytes(end - size, size as usize)?;
    length(&metadata, |_, _| ()).map(drop).ok_or_else(damaged)
}

/// Checks that a column lies within the file, and that its pages follow each other and are not much larger than their
/// bytes. Pages that are compressed otherwise than by Snappy are left to the reader, which refuses them.
fn check_pages(file: &File, column: &ColumnChunkMetaData) -> Result<(), ParquetError> {
    let first = column.dictionary_page_offset().unwrap_or_else(|| column.data_page_offset());
    let (Ok(mut at), Ok(size)) = (u64::try_from(first), u64::try_from(column.compressed_size())) else {
        return Err(damaged());
    };
    let end = at.checked_add(size).filter(|it| *it <= file.len()).ok_or_else(damaged)?;
    if !matches!(column.compression(), Compression::UNCOMPRESSED | Compression::SNAPPY) {
        return Ok(());
    }
    while at < end {
        let Page { header, compressed, uncompressed } = HEADERS
            .into_iter()
            .find_map(|most| page(file, at, most.min(file.len() - at)).transpose())
            .ok_or_else(damaged)??;
        let sizes = [compressed, uncompressed].map(|it| u64::try_from(it).unwrap_or(u64::MAX));
        let rest = file.len() - at - header;
        if sizes[0] > rest || sizes[1] > MOST_TIMES * (sizes[0] + 1) {
            return Err(damaged());
        }
        at += header + sizes[0];
    }
    Ok(())
}

/// What the header of a page says of its size [B].
struct Page {
    header: u64,
    compressed: i64,
    uncompressed: i64,
}

/// The page at `at`, if its header is whole within `most` bytes.
fn page(file: &File, at: u64, most: u64) -> Result<Option<Page>, ParquetError> {
    // Ids of `PageHeader` in the format's definition.
    const UNCOMPRESSED: i64 = 2;
    const COMPRESSED: i64 = 3;
    let mut bytes = Vec::new();
    file.get_read(at)?.take(most).read_to_end(&mut bytes)?;
    let (mut compressed, mut uncompressed) = (0, 0);
    let header = length(&bytes, |id, value| match id {
        UNCOMPRESSED => uncompressed = value,
        COMPRESSED => compressed = value,
        _ => {}
    });
    Ok(header.map(|it| Page { header: it as u64, compressed, uncompressed }))
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;
    use crate::table::{Column, Format, TableWriter};

    /// A table of a hundred numbers.
    fn written(name: &str) -> PathBuf {
        let path =
            std::env::temp_dir().join(format!("laneweave-sound-{name}-{}.parquet", std::process::id()));
        let mut table = TableWriter::create(&path, Format::Parquet, &[Column::real("speed_mps")]).unwrap();
        (0..100).for_each(|it| table.row(&[f64::from(it).sqrt().into()]).unwrap());
        table.finish().unwrap();
        path
    }

    #[test]
    fn a_page_that_claims_to_be_much_larger_than_its_bytes_is_damaged() {
        let path = written("page");
        assert!(open(File::open(&path).unwrap()).is_ok());
        let sound = std::fs::read(&path).unwrap();
        // The first page begins after four letters: 1: i32, 2: i32 its size, 3: i32 its compressed size.
        let place = 4 + 1 + sound[5..].iter().position(|it| *it < 0x80).unwrap() + 2;
        assert_eq!(sound[place - 1], 0x15);
        let mut forged = sound.clone();
        let last = place + sound[place..].iter().position(|it| *it < 0x80).unwrap();
        assert!(last > place, "the size has two bytes or more");
        forged[place..last].fill(0xff);
        forged[last] = 0x7f;
        std::fs::write(&path, &forged).unwrap();
        let error = open(File::open(&path).unwrap()).err().expect("it is refused");
        assert_eq!(error.to_string(), damaged().to_string());
        // A file that was cut, at any place, is no table either.
        for end in (0..sound.len()).step_by(7) {
            std::fs::write(&path, &sound[..end]).unwrap();
            assert!(open(File::open(&path).unwrap()).is_err(), "{end} bytes");
        }
        std::fs::remove_file(&path).unwrap();
    }
}
