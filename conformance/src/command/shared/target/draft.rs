//! The new content of a file, until it is whole.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Stdout, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

/// What is written to a file. Without [`Draft::finish`] a regular file keeps its old content.
pub(crate) struct Draft(Open);

enum Open {
    Stdout(BufWriter<Stdout>),
    Device(BufWriter<File>),
    Beside { file: BufWriter<NamedTempFile>, path: PathBuf },
    Addition { text: Vec<u8>, path: PathBuf },
}

impl Draft {
    pub(super) fn stdout() -> Self {
        Self(Open::Stdout(BufWriter::new(io::stdout())))
    }

    /// Written as it comes.
    pub(super) fn device(file: File) -> Self {
        Self(Open::Device(BufWriter::new(file)))
    }

    /// Takes the place of the file at `path`.
    pub(super) fn beside(path: PathBuf) -> io::Result<Self> {
        let file = BufWriter::new(beside(&path)?);
        Ok(Self(Open::Beside { file, path }))
    }

    /// Goes after the content of the file at `path`.
    pub(super) const fn addition(path: PathBuf) -> Self {
        Self(Open::Addition { text: Vec::new(), path })
    }

    /// Puts the new content where it belongs.
    pub(crate) fn finish(self) -> io::Result<()> {
        match self.0 {
            Open::Stdout(mut out) => out.flush(),
            Open::Device(mut file) => file.flush(),
            Open::Beside { file, path } => {
                let file = file.into_inner()?;
                // Else the name may reach the disk before the content does.
                file.as_file().sync_all()?;
                file.persist(path).map_err(|error| error.error)?;
                Ok(())
            }
            Open::Addition { text, path } => add(&text, &path),
        }
    }

    fn out(&mut self) -> &mut dyn Write {
        match &mut self.0 {
            Open::Stdout(out) => out,
            Open::Device(file) => file,
            Open::Beside { file, .. } => file,
            Open::Addition { text, .. } => text,
        }
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out().flush()
    }
}

/// Finds out whether a file can be made beside `path`, and leaves none there.
pub(super) fn probe(path: &Path) -> io::Result<()> {
    beside(path)?.close()
}

/// A new file beside `path` with the permissions that a file at `path` has, or would have.
fn beside(path: &Path) -> io::Result<NamedTempFile> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let prefix = format!(".{}.", name.chars().take(50).collect::<String>());
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask
    // The error's own text has the name of the new file, which says nothing to a user.
    let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    if let Ok(metadata) = fs::metadata(path) {
        file.as_file().set_permissions(metadata.permissions())?;
    }
    Ok(file)
}

/// Adds a text to a file, all of it or nothing, after an empty line.
fn add(text: &[u8], path: &Path) -> io::Result<()> {
    let mut file = OpenOptions::new().create(true).append(true).open(path)?;
    let before = file.metadata()?.len();
    let gap: &[u8] = if before == 0 { b"" } else { b"\n" };
    let written = file.write_all(&[gap, text].concat());
    if written.is_err() {
        file.set_len(before)?;
    }
    written
}
