//! Files that are either complete or not there, and standard output.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Writes `path` through `fill`: to a temporary file beside it, which takes its name once all is written. A reader sees the old file or
/// the new one, never a part. A symbolic link is followed; a device or pipe (`/dev/stdout`) is written to directly.
///
/// # Errors
/// [`Failure::Failed`] naming the file; the temporary file is removed then.
pub(crate) fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    if fs::metadata(&target).is_ok_and(|m| !m.is_file()) {
        return write_through(&target, fill).map_err(|e| Failure::file(path, &e));
    }
    let temporary = beside(&target);
    write_through(&temporary, fill)
        .and_then(|()| fs::rename(&temporary, &target))
        .map_err(|e| {
            // The first error is the one to report; a file that was never created cannot be removed either.
            let _ = fs::remove_file(&temporary);
            Failure::file(path, &e)
        })
}

/// Whether [`write_whole`] can be expected to succeed: before a long computation whose result would be lost.
///
/// # Errors
/// [`Failure::Failed`] naming the file.
pub(crate) fn check_writable(path: &Path) -> Result<(), Failure> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let result = match fs::metadata(&target) {
        Ok(there) if there.is_dir() => Err(io::Error::from(io::ErrorKind::IsADirectory)),
        // A device or pipe: opening it may already have an effect.
        Ok(there) if !there.is_file() => Ok(()),
        _ => {
            let temporary = beside(&target);
            File::create(&temporary).and_then(|_| fs::remove_file(&temporary))
        }
    };
    result.map_err(|e| Failure::file(path, &e))
}

fn write_through(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    fill(&mut file)?;
    file.flush()
}

/// A hidden name in the same directory (so that renaming stays within one file system), distinct for each process.
fn beside(target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

/// Creates a directory with its parents.
///
/// # Errors
/// [`Failure::Failed`] naming the directory.
pub(crate) fn create_directory(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path)
        .map_err(|e| Failure::Failed(format!("cannot create directory {}: {e}", path.display())))
}

/// Writes to standard output through `fill`; a reader that stops reading is no error.
///
/// # Errors
/// [`Failure::ReaderGone`] or [`Failure::Failed`].
pub(crate) fn to_stdout(
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    fill(&mut out)
        .and_then(|()| out.flush())
        .map_err(|e| Failure::stdout(&e))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let dir = std::env::temp_dir().join(format!("uk-output-{name}-{}", std::process::id()));
        fs::create_dir_all(&dir).expect("temporary directory");
        dir
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let dir = scratch("failed");
        let path = dir.join("a.csv");
        write_whole(&path, |w| w.write_all(b"old")).expect("first write");
        let failure = write_whole(&path, |w| {
            w.write_all(b"half")?;
            Err(io::Error::other("interrupted"))
        });
        assert!(failure.is_err());
        assert_eq!(fs::read(&path).expect("file"), b"old");
        assert_eq!(fs::read_dir(&dir).expect("directory").count(), 1);
        fs::remove_dir_all(dir).expect("clean up");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_written_to() {
        let dir = scratch("links");
        let (file, link) = (dir.join("file"), dir.join("link"));
        fs::write(&file, "old").expect("file");
        std::os::unix::fs::symlink(&file, &link).expect("link");
        write_whole(&link, |w| w.write_all(b"new")).expect("write");
        assert_eq!(fs::read(&file).expect("file"), b"new");
        assert!(fs::symlink_metadata(&link).expect("link").is_symlink());
        write_whole(Path::new("/dev/null"), |w| w.write_all(b"gone")).expect("device");
        assert!(!fs::metadata("/dev/null").expect("device").is_file());
        fs::remove_dir_all(dir).expect("clean up");
    }

    #[test]
    fn a_directory_that_is_missing_is_named() {
        let path = Path::new("/nonexistent/x.csv");
        for failure in [write_whole(path, |_| Ok(())), check_writable(path)] {
            assert!(matches!(failure, Err(Failure::Failed(m)) if m.contains("/nonexistent/x.csv")));
        }
        assert!(check_writable(Path::new("/dev/null")).is_ok());
    }
}
