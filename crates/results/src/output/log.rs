//! The log: all batches of a run in one file, so that a resumed run can write its tables and XML files again from the
//! beginning.
//!
//! Until the first mark the file has a provisional name. An existing log, from which batches are read again, stays
//! until then. Repeated batches are the same bytes, so that a former mark is valid in the new log as well.
//!
//! Each batch follows its head: its length and its hash.

use std::fs::File;
use std::io::{self, BufRead, Read, Write};
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;
use laneweave_study::PartialFile;
use xxhash_rust::xxh3::xxh3_64;

use super::batch::Batch;

/// Text is collected up to this length before it is written [bytes].
const BUFFER: usize = 1 << 18;
/// Maximum length of a batch [bytes].
const LONGEST: u32 = 1 << 30;

/// Writes batches one after the other.
pub(super) struct PageLog {
    path: PathBuf,
    file: File,
    /// Its provisional name, as long as it has it. It comes after the file, which is closed when it is removed.
    partial: Option<PartialFile>,
    buffer: Vec<u8>,
    length: u64,
}

impl PageLog {
    /// Begins a log that will be at `path`.
    pub(super) fn create(path: &Path) -> Result<PageLog, Fault> {
        let (partial, file) =
            PartialFile::create(path).map_err(|error| Fault::refused(path, "created", &error))?;
        Ok(PageLog { path: path.to_owned(), file, partial: Some(partial), buffer: Vec::new(), length: 0 })
    }

    /// Appends a batch.
    pub(super) fn write(&mut self, batch: &Batch) -> Result<(), Fault> {
        let bytes = postcard::to_allocvec(batch).map_err(|error| Fault::bug(self.path.display(), error))?;
        self.buffer.extend((bytes.len() as u32).to_le_bytes());
        self.buffer.extend(xxh3_64(&bytes).to_le_bytes());
        self.buffer.extend(bytes);
        if self.buffer.len() < BUFFER {
            return Ok(());
        }
        self.flush().map_err(|error| Fault::refused(&self.path, "written", &error))
    }

    /// Writes everything up to here into the file and gives it its final name; returns its length [bytes].
    pub(super) fn mark(&mut self) -> Result<u64, Fault> {
        let marked =
            self.flush().and_then(|()| self.file.sync_data()).and_then(|()| match self.partial.take() {
                Some(partial) => partial.complete(),
                None => Ok(()),
            });
        marked.map_err(|error| Fault::refused(&self.path, "written", &error))?;
        Ok(self.length)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.write_all(&self.buffer)?;
        self.length += self.buffer.len() as u64;
        self.buffer.clear();
        Ok(())
    }
}

/// The batches of the log at `path`, up to `length` [bytes].
pub(super) fn batches(path: &Path, length: u64) -> Result<impl Iterator<Item = Result<Batch, Fault>>, Fault> {
    let place = path.to_owned();
    let damaged = move |what: String| {
        Fault::new(place.display(), what, "run again from the beginning, without --resume")
    };
    let file = File::open(path).map_err(|error| Fault::refused(path, "read", &error))?;
    let size = file.metadata().map_err(|error| Fault::refused(path, "read", &error))?.len();
    if size < length {
        return Err(damaged(format!("it has {size} bytes, but the checkpoint needs {length}")));
    }
    let mut reader = io::BufReader::new(file.take(length));
    Ok(std::iter::from_fn(move || match reader.fill_buf() {
        Ok([]) => None,
        _ => Some(batch(&mut reader).map_err(|error| damaged(error.to_string()))),
    }))
}

/// The next batch.
fn batch(reader: &mut impl Read) -> io::Result<Batch> {
    let (mut size, mut hash) = ([0; 4], [0; 8]);
    reader.read_exact(&mut size)?;
    reader.read_exact(&mut hash)?;
    let size = u32::from_le_bytes(size);
    if size > LONGEST {
        return Err(io::Error::other(format!("a batch of {size} bytes")));
    }
    let mut bytes = Vec::new();
    // A damaged size is not believed before so many bytes have come.
    reader.take(size.into()).read_to_end(&mut bytes)?;
    if bytes.len() < size as usize {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    if xxh3_64(&bytes).to_le_bytes() != hash {
        return Err(io::Error::other("a batch is damaged"));
    }
    postcard::from_bytes(&bytes).map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn pages_come_again_as_they_were_and_a_damaged_one_is_refused() {
        let folder = std::env::temp_dir().join(format!("laneweave-log-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("batches");
        let mut log = PageLog::create(&path).unwrap();
        (0..3).for_each(|_| log.write(&Batch::Trips(Vec::new())).unwrap());
        assert!(!path.exists());
        let length = log.mark().unwrap();
        log.write(&Batch::LaneChanges(Vec::new())).unwrap();
        log.mark().unwrap();
        let read = || batches(&path, length).unwrap().collect::<Result<Vec<Batch>, Fault>>();
        let again = read().unwrap();
        assert!(
            again.len() == 3 && again.iter().all(|it| matches!(it, Batch::Trips(trips) if trips.is_empty()))
        );

        let whole = fs::read(&path).unwrap();
        for place in 0..length as usize {
            let mut damaged = whole.clone();
            damaged[place] ^= 1;
            fs::write(&path, damaged).unwrap();
            let fault = read().err().unwrap_or_else(|| panic!("byte {place} is not looked at"));
            assert_eq!(fault.remedy, "run again from the beginning, without --resume");
        }
        fs::write(&path, &whole[..length as usize - 1]).unwrap();
        assert!(batches(&path, length).is_err());
        drop(log);
        fs::remove_dir_all(folder).unwrap();
    }
}
