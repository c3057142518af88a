//! A file that a command writes. It keeps its old content until the new one is whole.

mod draft;
mod path;

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

pub(crate) use draft::Draft;

use super::Failure;

/// A place that can be written.
#[derive(Debug)]
pub(crate) struct Target {
    /// As the user wrote it.
    pub(crate) name: String,
    place: Place,
}

#[derive(Debug)]
enum Place {
    Stdout,
    /// No regular file: a terminal, a pipe or a device.
    Device(File),
    /// A regular file, which may not exist yet.
    File {
        path: PathBuf,
        appends: bool,
    },
}

impl Target {
    /// Finds out whether `path` can be written; `-` is standard output. A regular file keeps its
    /// content, and none is made.
    pub(crate) fn new(path: &Path) -> Result<Self, Failure> {
        Self::open(path, false)
    }

    /// The same, but what is written is added to the content of a regular file.
    pub(crate) fn appending(path: &Path) -> Result<Self, Failure> {
        Self::open(path, true)
    }

    fn open(path: &Path, appends: bool) -> Result<Self, Failure> {
        let name = path.display().to_string();
        match Place::find(path, appends) {
            Ok(place) => Ok(Self { name, place }),
            Err(error) => Err(Failure::usage(format!("cannot write {name}: {error}"))),
        }
    }

    pub(crate) const fn is_stdout(&self) -> bool {
        matches!(self.place, Place::Stdout)
    }

    /// Whether it is a file with content, which would be replaced.
    pub(crate) fn has_content(&self) -> bool {
        let Place::File { path, .. } = &self.place else { return false };
        fs::metadata(path).is_ok_and(|metadata| metadata.len() > 0)
    }

    /// Whether both paths are of the same file.
    pub(crate) fn are_same(one: &Path, other: &Path) -> bool {
        matches!((path::followed(one), path::followed(other)), (Ok(one), Ok(other)) if one == other)
    }

    /// Refuses to write a file twice, whatever its names.
    pub(crate) fn all_differ<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
        let mut before: Vec<(&Path, PathBuf)> = Vec::new();
        for path in paths {
            // What can't be found is told when it is opened.
            let Ok(own) = path::followed(path) else { continue };
            if let Some((other, _)) = before.iter().find(|(_, other)| *other == own) {
                let (first, second) = (other.display(), path.display());
                let message = if *other == path {
                    format!("two outputs go to {first}; give each a path of its own")
                } else {
                    format!("{first} and {second} are the same file; give each output its own")
                };
                return Err(Failure::usage(message));
            }
            before.push((path, own));
        }
        Ok(())
    }

    /// Writes the whole content.
    pub(crate) fn write(self, text: &[u8]) -> Result<(), Failure> {
        let name = self.name.clone();
        let write = |mut draft: Draft| draft.write_all(text).and_then(|()| draft.finish());
        seen(&name, self.begin().and_then(write))
    }

    /// Opens it for writing.
    pub(crate) fn begin(self) -> io::Result<Draft> {
        match self.place {
            Place::Stdout => Ok(Draft::stdout()),
            Place::Device(file) => Ok(Draft::device(file)),
            Place::File { path, appends: true } => Ok(Draft::addition(path)),
            Place::File { path, appends: false } => Draft::beside(path),
        }
    }

    /// Opens it as a record whose lines are wanted even if it is not whole.
    pub(crate) fn begin_record(self) -> io::Result<Draft> {
        match self.place {
            Place::File { path, .. } => Ok(Draft::device(File::create(path)?)),
            _ => self.begin(),
        }
    }
}

impl Place {
    fn find(path: &Path, appends: bool) -> io::Result<Self> {
        let path = path::followed(path)?;
        if path == Path::new(path::STDOUT) {
            return Ok(Self::Stdout);
        }
        if path::is_open_file(&path) {
            // It may stand for a file, and something may be written there already.
            return Ok(Self::Device(OpenOptions::new().append(true).open(&path)?));
        }
        match fs::metadata(&path) {
            Ok(metadata) if metadata.is_file() => {
                drop(OpenOptions::new().append(true).open(&path)?);
            }
            Ok(_) => return Ok(Self::Device(OpenOptions::new().write(true).open(&path)?)),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
            Err(_) => draft::probe(&path)?,
        }
        if !appends {
            draft::probe(&path)?;
        }
        Ok(Self::File { path, appends })
    }
}

/// Prints a text, with colours only on a terminal.
pub(crate) fn print(text: impl AsRef<[u8]>) -> Result<(), Failure> {
    let mut out = anstream::stdout();
    printed(out.write_all(text.as_ref()).and_then(|()| out.flush()))
}

/// Whether a text could be written to standard output.
pub(crate) fn printed(written: io::Result<()>) -> Result<(), Failure> {
    seen("to standard output", written)
}

/// A closed pipe, as of `| head`, is not an error.
pub(crate) fn seen(name: &str, written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::incomplete(format!("cannot write {name}: {error}")))
        }
        _ => Ok(()),
    }
}
