//! Which file a path stands for.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// How many symbolic links are followed, as on Linux.
const MOST_LINKS: usize = 40;

/// Standard output, whatever name it has.
pub(super) const STDOUT: &str = "-";

/// The path of the file that is opened at `path`. Unlike with `fs::canonicalize` there need not be a
/// file yet, and an open file of a process, such as `/dev/stderr`, is not followed to its file.
pub(super) fn followed(path: &Path) -> io::Result<PathBuf> {
    if path == Path::new(STDOUT) {
        return Ok(path.to_owned());
    }
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else {
            return Err(ErrorKind::IsADirectory.into());
        };
        let here = folder.as_os_str().is_empty();
        let folder = fs::canonicalize(if here { Path::new(".") } else { folder })?;
        let own = folder.join(name);
        match fs::read_link(&own) {
            Ok(link) if !is_open_file(&own) => path = folder.join(link),
            _ if is_open_file(&own) && own.ends_with("1") => return Ok(STDOUT.into()),
            _ => return Ok(own),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Whether a path is that of an open file of a process.
pub(super) fn is_open_file(path: &Path) -> bool {
    let systems = path.starts_with("/proc") || path.starts_with("/dev");
    systems && path.parent().is_some_and(|folder| folder.ends_with("fd"))
}
