//! The pages of a run in one file, so that a run that is resumed can have its tables and XML files written anew from the beginning.
//!
//! Until the first mark the file has a provisional name; a log that is already there, and that pages come from again, stays until
//! then. Pages that come again are the same bytes, so that a former mark holds in the new log as well.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::scribe::Page;
use crate::fault::Fault;

/// Text that is collected before it is written [bytes].
const BUFFER: usize = 1 << 18;
/// No page is longer [bytes].
const LONGEST: u32 = 1 << 30;

/// Writes pages one after the other, each after its length.
pub(super) struct PageLog {
    path: PathBuf,
    /// Its provisional name, as long as it has it.
    partial: Option<PathBuf>,
    file: File,
    buffer: Vec<u8>,
    length: u64,
}

impl PageLog {
    /// Begins a log that will be at `path`.
    pub(super) fn create(path: &Path) -> Result<PageLog, Fault> {
        let mut partial = path.as_os_str().to_owned();
        partial.push(".partial");
        let partial = PathBuf::from(partial);
        let file = File::create(&partial).map_err(|error| Fault::refused(&partial, "created", &error))?;
        Ok(PageLog { path: path.to_owned(), partial: Some(partial), file, buffer: Vec::new(), length: 0 })
    }

    /// Appends a page.
    pub(super) fn write(&mut self, page: &Page) -> Result<(), Fault> {
        let bytes = postcard::to_allocvec(page)
            .map_err(|error| Fault::new(self.path.display(), error, "report this as a bug"))?;
        self.buffer.extend((bytes.len() as u32).to_le_bytes());
        self.buffer.extend(bytes);
        if self.buffer.len() < BUFFER {
            return Ok(());
        }
        self.flush().map_err(|error| Fault::refused(&self.path, "written", &error))
    }

    /// Everything up to here is in the file, which has its name now; returns its length [bytes].
    pub(super) fn mark(&mut self) -> Result<u64, Fault> {
        let marked =
            self.flush().and_then(|()| self.file.sync_data()).and_then(|()| match self.partial.take() {
                Some(partial) => fs::rename(partial, &self.path),
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

impl Drop for PageLog {
    fn drop(&mut self) {
        if let Some(partial) = &self.partial {
            // A drop has nobody to tell of another failure.
            let _ = fs::remove_file(partial);
        }
    }
}

/// The pages of the log at `path`, up to `length` [bytes].
pub(super) fn pages(path: &Path, length: u64) -> Result<impl Iterator<Item = Result<Page, Fault>>, Fault> {
    let place = path.to_owned();
    let damaged = move |what: String| {
        Fault::new(place.display(), what, "run again from the beginning, without --resume")
    };
    let file = File::open(path).map_err(|error| Fault::refused(path, "read", &error))?;
    let size = file.metadata().map_err(|error| Fault::refused(path, "read", &error))?.len();
    if size < length {
        return Err(damaged(format!("{size} bytes of {length} that the checkpoint needs")));
    }
    let mut reader = io::BufReader::new(file.take(length));
    let read = move || -> Option<Result<Page, Fault>> {
        let mut head = [0; 4];
        match reader.read_exact(&mut head) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return None,
            Err(error) => return Some(Err(damaged(error.to_string()))),
            Ok(()) => {}
        }
        let size = u32::from_le_bytes(head);
        if size > LONGEST {
            return Some(Err(damaged(format!("a page of {size} bytes"))));
        }
        let mut bytes = vec![0; size as usize];
        if let Err(error) = reader.read_exact(&mut bytes) {
            return Some(Err(damaged(error.to_string())));
        }
        Some(postcard::from_bytes(&bytes).map_err(|error| damaged(error.to_string())))
    };
    Ok(std::iter::from_fn(read))
}
