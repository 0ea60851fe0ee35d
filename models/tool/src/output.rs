//! Files that are either complete or not there, directories that one program at a time writes to, and standard output.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Stdout, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::Serialize;
use tempfile::NamedTempFile;

use crate::failure::Failure;

/// A file being written: a temporary one beside it, which takes its name once all is written. A reader sees the old file or the new one,
/// never a part. A symbolic link is followed; a device or pipe (`/dev/stdout`) is written to directly. `-` is standard output, of which
/// each line is handed on at once.
pub(crate) struct WholeFile {
    /// The name that was asked for.
    path: PathBuf,
    kind: Kind,
}

enum Kind {
    Temporary(BufWriter<NamedTempFile>, PathBuf),
    Direct(BufWriter<File>),
    Stdout(Stdout),
}

impl WholeFile {
    /// Begins the file `path`. Where that is not possible it is known here, before a long computation whose result would be lost.
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let kind = match fs::metadata(&target) {
            _ if is_stdout(path) => Ok(Kind::Stdout(io::stdout())),
            Ok(there) if there.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(there) if !there.is_file() => {
                let file = File::options().write(true).open(&target);
                file.map(|file| Kind::Direct(BufWriter::new(file)))
            }
            _ => temporary(&target).map(|file| Kind::Temporary(BufWriter::new(file), target)),
        };
        let path = path.to_path_buf();
        match kind {
            Ok(kind) => Ok(WholeFile { path, kind }),
            Err(error) => Err(Failure::file(&path, &error)),
        }
    }

    /// Writes `bytes` and gives the file its name.
    pub(crate) fn finish_with(mut self, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        let done = self.write_all(bytes.as_ref());
        done.map_err(|e| Failure::file(&self.path, &e))?;
        self.finish()
    }

    fn out(&mut self) -> &mut dyn Write {
        match &mut self.kind {
            Kind::Temporary(file, _) => file,
            Kind::Direct(file) => file,
            Kind::Stdout(out) => out,
        }
    }

    /// Ends the file: from here on it stands under its name, whole.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        let done = match self.kind {
            Kind::Stdout(_) | Kind::Direct(_) => self.flush(),
            Kind::Temporary(file, target) => match file.into_inner() {
                Ok(file) => {
                    unfinished().retain(|path| path != file.path());
                    file.persist(target).map(drop).map_err(|e| e.error)
                }
                Err(error) => Err(error.into_error()),
            },
        };
        done.map_err(|e| Failure::file(&self.path, &e))
    }
}

/// Whether `path` stands for standard output.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Refuses options that name the same file: each would take the place of what the other has written.
///
/// # Errors
/// [`Failure::Usage`] with both options.
pub(crate) fn apart(named: &[(&str, Option<&Path>)]) -> Result<(), Failure> {
    let place = |path: &Path| {
        let directory = path.parent().filter(|d| !d.as_os_str().is_empty());
        let directory = fs::canonicalize(directory.unwrap_or(Path::new("."))).ok()?;
        let place = directory.join(path.file_name()?);
        Some(fs::canonicalize(&place).unwrap_or(place))
    };
    // What is no file, such as /dev/null, takes what all write.
    let files = named.iter().filter_map(|(option, path)| {
        let place = place(path.filter(|path| !is_stdout(path))?)?;
        (place.is_file() || !place.exists()).then_some((option, place))
    });
    let files: Vec<_> = files.collect();
    for (k, (option, place)) in files.iter().enumerate() {
        if let Some((other, _)) = files[..k].iter().find(|(_, other)| other == place) {
            return Err(Failure::Usage(format!(
                "`{other}` and `{option}` name the same file, {}; give each its own",
                place.display()
            )));
        }
    }
    Ok(())
}

/// Formats that a file's name may promise.
const FORMATS: [&str; 14] = [
    "csv", "eps", "gif", "html", "jpeg", "jpg", "json", "mp4", "parquet", "pdf", "png", "svg",
    "webm", "webp",
];

/// Refuses a name for what `option` writes in the format `written` that promises another.
pub(crate) fn promised(option: &str, path: &Path, written: &str) -> Result<(), Failure> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let other = |ending: &OsString| FORMATS.iter().any(|f| ending == f) && ending != written;
    match ending.filter(other) {
        Some(_) => Err(Failure::Usage(format!(
            "`{option}` writes {}, which `{}` does not promise; name the file `{}`",
            written.to_uppercase(),
            path.display(),
            path.with_extension(written).display()
        ))),
        None => Ok(()),
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out().flush()
    }
}

/// The temporary files that are being written, for a program that ends without unwinding.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files; for a program that ends at once.
pub(crate) fn discard_unfinished() {
    discard(|_| true);
}

fn discard(which: impl Fn(&Path) -> bool) {
    for path in unfinished().extract_if(.., |path| which(path)) {
        // One that cannot be removed stays; there is nobody left to act on it.
        let _ = fs::remove_file(path);
    }
}

/// The directory that `target` is to be in.
pub(crate) fn directory(target: &Path) -> io::Result<&Path> {
    let directory = target.parent().filter(|d| !d.as_os_str().is_empty());
    let directory = directory.unwrap_or(Path::new("."));
    if !directory.is_dir() {
        let message = format!("there is no directory {}", directory.display());
        return Err(io::Error::new(io::ErrorKind::NotFound, message));
    }
    Ok(directory)
}

/// A hidden file in the directory of `target`, so that renaming stays within one file system.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let directory = directory(target)?;
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let prefix = format!(".{name}.");
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    // As any other file that is created: for all whom the user's mask admits.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(directory);
    // The name of the temporary file would puzzle who is told of it: the cause alone.
    let file = file.map_err(|e| {
        let text = e.to_string();
        let cause = text.split(" at path ").next().unwrap_or_default();
        io::Error::new(e.kind(), cause.to_owned())
    })?;
    unfinished().push(file.path().to_path_buf());
    Ok(file)
}

/// Writes the [whole file](WholeFile) `path` through `fill`; where that fails, what stood there before stands there still.
pub(crate) fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut file = WholeFile::create(path)?;
    fill(&mut file).map_err(|e| Failure::file(path, &e))?;
    file.finish()
}

/// A directory of a report, which no other program writes a report to meanwhile.
#[derive(Debug)]
pub struct Directory {
    path: PathBuf,
    /// The lock, held as long as it is open.
    _lock: Option<File>,
}

impl Directory {
    /// Creates the directory `path` with its parents, unless it is there, and sees to it that a page can be written to it.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the directory, also where another program is writing to it.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        let place = path.display();
        fs::create_dir_all(path)
            .map_err(|e| Failure::Failed(format!("cannot create directory {place}: {e}")))?;
        // Elsewhere a directory cannot be opened as a file.
        let lock = File::open(path).ok().filter(|_| cfg!(unix));
        if let Some(Err(fs::TryLockError::WouldBlock)) = lock.as_ref().map(File::try_lock) {
            return Err(Failure::Failed(format!(
                "another program is writing its report to {place}; wait for it, or take another directory with `--out`"
            )));
        }
        let directory = Directory {
            path: path.to_path_buf(),
            _lock: lock,
        };
        WholeFile::create(&directory.file("index.html"))?;
        Ok(directory)
    }

    /// The path of the file called `name` in this directory.
    #[must_use]
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// The last line at the terminal: what is done, how long it took, and where the page is.
    #[must_use]
    pub fn told(&self, done: &str, seconds: f64) -> String {
        let page = self.file("index.html");
        format!("{done} in {seconds:.1} s; the report is {}", page.display())
    }

    /// Writes the whole file `name`, which may lie in a directory below.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the file.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        let path = self.file(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(|e| Failure::file(&path, &e))?;
        }
        write_whole(&path, |w| w.write_all(bytes.as_ref()))
    }

    /// Writes `value` as JSON to the whole file `name`.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the file.
    pub fn json(&self, name: &str, value: &impl Serialize) -> Result<(), Failure> {
        write_whole(&self.file(name), |w| json(w, value))
    }

    /// Writes `rows` as comma-separated values to the whole file `name`. Each row has its cells under the names of their columns, which are
    /// those of the first.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the file.
    pub fn csv(
        &self,
        name: &str,
        rows: impl IntoIterator<Item = Vec<(&'static str, String)>>,
    ) -> Result<(), Failure> {
        let mut rows = rows.into_iter().peekable();
        let names = rows.peek().into_iter().flatten().map(|(name, _)| *name);
        let names: Vec<_> = names.collect();
        let cells = rows.map(|row| row.into_iter().map(|(_, cell)| cell));
        write_whole(&self.file(name), |w| csv(w, names, cells))
    }
}

/// Writes comma-separated values: the names of columns, then rows of cells.
pub(crate) fn csv<C: AsRef<[u8]>>(
    out: &mut dyn Write,
    names: impl IntoIterator<Item = impl AsRef<[u8]>>,
    rows: impl IntoIterator<Item = impl IntoIterator<Item = C>>,
) -> io::Result<()> {
    let mut names = names.into_iter().peekable();
    let mut table = csv::Writer::from_writer(out);
    // As it came, for a reader that is gone is no failure.
    let failed = |error: csv::Error| {
        let told = error.to_string();
        match error.into_kind() {
            csv::ErrorKind::Io(error) => error,
            _ => io::Error::other(told),
        }
    };
    // A record of nothing would be one of an empty text.
    if names.peek().is_some() {
        table.write_record(names).map_err(failed)?;
    }
    for row in rows {
        table.write_record(row).map_err(failed)?;
    }
    table.flush()
}

/// Writes `value` as JSON with a line's end.
pub(crate) fn json(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    writeln!(out)
}

/// Writes to standard output through `fill`; a reader that stops reading is no error.
///
/// # Errors
/// [`Failure::ReaderGone`] or [`Failure::Failed`].
pub fn to_stdout(fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    fill(&mut out)
        .and_then(|()| out.flush())
        .map_err(|e| Failure::stdout(&e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_promise_another_format_are_refused() {
        let plotted = |name| promised("--plot", Path::new(name), "svg").map_err(|e| e.message());
        for fine in ["a.svg", "a.SVG", "a", "run.2", "-", "/dev/stdout", "a.b"] {
            assert_eq!(plotted(fine), Ok(()), "{fine}");
        }
        let message =
            "`--plot` writes SVG, which `d/a.PNG` does not promise; name the file `d/a.svg`";
        assert_eq!(plotted("d/a.PNG"), Err(message.to_owned()));
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let scratch = tempfile::tempdir().expect("directory");
        let path = scratch.path().join("a.csv");
        write_whole(&path, |w| w.write_all(b"old")).expect("first write");
        let failure = write_whole(&path, |w| {
            w.write_all(b"half")?;
            Err(io::Error::other("interrupted"))
        });
        assert!(failure.is_err());
        assert_eq!(fs::read(&path).expect("file"), b"old");
        assert_eq!(fs::read_dir(scratch.path()).expect("directory").count(), 1);
    }

    #[test]
    fn a_program_that_ends_at_once_leaves_no_temporary_file() {
        let scratch = tempfile::tempdir().expect("directory");
        let file = WholeFile::create(&scratch.path().join("a.csv")).expect("file");
        let number = || fs::read_dir(scratch.path()).expect("directory").count();
        assert_eq!(number(), 1);
        // (Those of other tests stay: they are in other directories.)
        discard(|path| path.starts_with(scratch.path()));
        assert_eq!(number(), 0);
        drop(file);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_written_to() {
        use std::os::unix::fs::PermissionsExt;
        let scratch = tempfile::tempdir().expect("directory");
        let (file, link) = (scratch.path().join("file"), scratch.path().join("link"));
        fs::write(&file, "old").expect("file");
        let usual = fs::metadata(&file).expect("file").permissions().mode();
        std::os::unix::fs::symlink(&file, &link).expect("link");
        write_whole(&link, |w| w.write_all(b"new")).expect("write");
        assert_eq!(fs::read(&file).expect("file"), b"new");
        let mode = fs::metadata(&file).expect("file").permissions().mode();
        assert_eq!(mode, usual, "readable by whom a new file is");
        assert!(fs::symlink_metadata(&link).expect("link").is_symlink());
        write_whole(Path::new("/dev/null"), |w| w.write_all(b"gone")).expect("device");
        assert!(!fs::metadata("/dev/null").expect("device").is_file());
    }

    #[test]
    fn a_directory_that_is_missing_is_named() {
        let failure = WholeFile::create(Path::new("/nonexistent/x.csv"));
        let told = "cannot write /nonexistent/x.csv: there is no directory /nonexistent";
        assert!(matches!(failure, Err(Failure::Failed(m)) if m == told));
    }

    #[cfg(unix)]
    #[test]
    fn a_directory_has_one_writer() {
        let scratch = tempfile::tempdir().expect("directory");
        let path = scratch.path().join("out/report");
        let first = Directory::create(&path).expect("nobody else");
        let second = Directory::create(&path);
        assert!(matches!(second, Err(Failure::Failed(m)) if m.contains("another program")));
        first
            .write("figures/a.svg", "<svg/>")
            .expect("a directory below");
        drop(first);
        Directory::create(&path).expect("nobody any more");
    }

    #[test]
    fn a_table_that_nobody_reads_on_is_told_as_such() {
        struct Gone;
        impl Write for Gone {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::BrokenPipe.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        // More than any buffer holds.
        let rows = (0..100_000).map(|k| [k.to_string()]);
        let error = csv(&mut Gone, ["k"], rows).expect_err("nobody reads");
        assert_eq!(error.kind(), io::ErrorKind::BrokenPipe);
        assert_eq!(Failure::stdout(&error).code(), 0);
    }
}
