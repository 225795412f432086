//! Files that are written atomically.

use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempPath;

/// Creates or replaces a file with the output of `write`. If that fails, the old file stays unchanged.
///
/// The text goes to a temporary file in the same folder, which is renamed at the end, and removed on error. The new
/// file has the permissions of the one that it replaces, and the owner of this process. Other hard links to the old
/// file keep the old text. A symbolic link is followed, even if its target does not exist yet. A read-only file is not
/// replaced. A pipe, a terminal or a device such as `/dev/null` cannot be replaced: it receives the whole text at the
/// end.
///
/// # Errors
/// The errors of `write` and of the file system.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    match Place::of(path)? {
        Place::Stream => {
            let mut text = Vec::new();
            write(&mut text)?;
            File::options().write(true).open(path)?.write_all(&text)
        }
        Place::File { target, permissions } => {
            let (temporary, file) = Temporary::beside(&target)?;
            if let Some(permissions) = permissions {
                file.set_permissions(permissions)?;
            }
            let mut writer = BufWriter::new(file);
            write(&mut writer)?;
            let file = writer.into_inner()?;
            // The text must reach the disk before the name.
            file.sync_all()?;
            // Some systems rename only closed files.
            drop(file);
            temporary.rename(&target)
        }
    }
}

/// Checks whether [`write_atomically`] could write here, as far as that is known in advance. Leaves no file behind.
///
/// # Errors
/// The errors of the file system.
///
/// ```
/// use stackless_scene::check_writable;
/// use std::path::Path;
/// assert!(check_writable(&std::env::temp_dir().join("hits.csv")).is_ok());
/// assert!(check_writable(Path::new("no such folder/hits.csv")).is_err());
/// ```
pub fn check_writable(path: &Path) -> io::Result<()> {
    match Place::of(path)? {
        Place::Stream => Ok(()),
        Place::File { target, .. } => Temporary::beside(&target).map(drop),
    }
}

/// Removes the temporary files of all running writes, and permits no new ones: for a program that ends by a signal.
/// From then on, a writing thread waits.
pub fn abandon_writes() {
    let mut live = live();
    live.clear();
    std::mem::forget(live);
}

/// The destination of text.
enum Place {
    /// A stream, which cannot be replaced.
    Stream,
    /// A file, with the permissions of the existing one.
    File { target: PathBuf, permissions: Option<Permissions> },
}

impl Place {
    fn of(path: &Path) -> io::Result<Self> {
        let existing = fs::metadata(path);
        match &existing {
            Ok(existing) if existing.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(existing) if !existing.is_file() => Ok(Self::Stream),
            Ok(existing) if existing.permissions().readonly() => {
                Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is read-only"))
            }
            _ => Ok(Self::File {
                target: resolve(path)?,
                permissions: existing.ok().map(|existing| existing.permissions()),
            }),
        }
    }
}

/// Resolves a path to an absolute one without symbolic links. The file need not exist.
///
/// # Errors
/// The errors of the file system: the folder must exist.
pub fn resolve(path: &Path) -> io::Result<PathBuf> {
    if let Ok(there) = fs::canonicalize(path) {
        return Ok(there);
    }
    let end = end_of_links(path)?;
    let Some(name) = end.file_name() else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"));
    };
    let parent = end.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Ok(fs::canonicalize(parent)?.join(name))
}

/// Follows symbolic links to a name that does not exist yet.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut end = path.to_path_buf();
    // Linux follows 40 links.
    for _ in 0..40 {
        match fs::read_link(&end) {
            Ok(next) => end = end.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(end),
        }
    }
    Err(io::Error::new(io::ErrorKind::InvalidInput, "too many symbolic links"))
}

/// The existing temporary files. A file is removed when it leaves the list, unless it has been renamed.
static LIVE: Mutex<Vec<TempPath>> = Mutex::new(Vec::new());

fn live() -> MutexGuard<'static, Vec<TempPath>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file of [`LIVE`].
struct Temporary(PathBuf);

impl Temporary {
    fn beside(target: &Path) -> io::Result<(Self, File)> {
        let mut live = live();
        // The target's name is not a part of it, because that may already have the greatest length.
        let mut names = tempfile::Builder::new();
        let names = names.prefix(".stackless.").suffix(".tmp");
        // Created directly, so the file has the permissions of any new file, and errors name no temporary path.
        let file = names.make_in(target.with_file_name(""), |path| File::create_new(path))?;
        let (file, path) = file.into_parts();
        let name = path.to_path_buf();
        live.push(path);
        Ok((Self(name), file))
    }

    fn rename(&self, target: &Path) -> io::Result<()> {
        // The lock is held throughout, so a signal never finds a file without a name, or a name without a file.
        let mut live = live();
        self.take(&mut live).map_or(Ok(()), |path| path.persist(target).map_err(|error| error.error))
    }

    fn take(&self, live: &mut Vec<TempPath>) -> Option<TempPath> {
        let at = live.iter().position(|path| **path == *self.0)?;
        Some(live.swap_remove(at))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        self.take(&mut live());
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Folder;
    use super::*;

    #[test]
    fn the_text_appears_whole_and_nothing_else() {
        let folder = Folder::new("whole");
        let path = folder.file("out.csv");
        for text in ["first", "and second, which replaces it"] {
            write_atomically(&path, |w| w.write_all(text.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
            assert_eq!(folder.names(), ["out.csv"]);
        }
    }

    #[test]
    fn a_failure_leaves_everything_as_it_was() {
        let folder = Folder::new("failure");
        let path = folder.file("out.csv");
        let fail = |w: &mut dyn Write| {
            w.write_all(&vec![b'x'; 100_000])?;
            Err(io::Error::other("no more"))
        };
        assert_eq!(write_atomically(&path, fail).unwrap_err().to_string(), "no more");
        assert!(folder.names().is_empty());

        fs::write(&path, "old").unwrap();
        assert!(write_atomically(&path, fail).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");

        let panicking = || write_atomically(&path, |_| panic!("on purpose"));
        assert!(std::panic::catch_unwind(panicking).is_err());
        assert_eq!(folder.names(), ["out.csv"]);
    }

    #[test]
    fn a_temporary_name_is_used_once() {
        let folder = Folder::new("once");
        let mut names = Vec::new();
        for _ in 0..20 {
            write_atomically(&folder.file("out.csv"), |_| {
                names.extend(folder.names().into_iter().filter(|name| name != "out.csv"));
                Ok(())
            })
            .unwrap();
        }
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 20, "{names:?}");
    }

    /// A writer never touches the temporary file of another thread or process. The test starts itself as processes.
    #[test]
    fn many_writers_of_one_file_all_succeed() {
        let inherited = std::env::var_os("STACKLESS_TEST_WRITES");
        let folder = Folder::new("many");
        let path = inherited.clone().map_or_else(|| folder.file("out.csv"), PathBuf::from);
        let write = |name: u8| {
            for _ in 0..60 {
                check_writable(&path).unwrap();
                write_atomically(&path, |w| w.write_all(&[name; 1000])).unwrap();
                let text = fs::read(&path).unwrap();
                assert!(text.len() == 1000 && text.iter().all(|&byte| byte == text[0]));
            }
        };
        let other = || {
            let mut command = std::process::Command::new(std::env::current_exe().unwrap());
            command.args(["many_writers_of_one_file", "--quiet"]).env("STACKLESS_TEST_WRITES", &path);
            command.stdout(std::process::Stdio::piped()).spawn().unwrap()
        };
        let others: Vec<_> = inherited.is_none().then(|| [other(), other()]).into_iter().flatten().collect();
        std::thread::scope(|scope| (0..2).for_each(|name| _ = scope.spawn(move || write(name))));
        for other in others {
            let output = other.wait_with_output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
        }
        assert!(folder.names().iter().all(|name| name == "out.csv"), "{:?}", folder.names());
    }

    #[cfg(unix)]
    #[test]
    fn any_name_that_the_system_has_is_written() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let folder = Folder::new("names");
        for name in [&[b'x'; 255][..], "\u{e9}".repeat(127).as_bytes(), b"\xFF.csv"] {
            let path = folder.file("").join(OsStr::from_bytes(name));
            check_writable(&path).unwrap();
            write_atomically(&path, |w| w.write_all(b"new")).unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"new");
        }
    }

    #[test]
    fn a_folder_is_refused() {
        let folder = Folder::new("refused");
        assert!(write_atomically(&folder.file(""), |w| w.write_all(b"new")).is_err());
        assert!(write_atomically(&folder.file("missing/out.csv"), |w| w.write_all(b"new")).is_err());
        assert!(folder.names().is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_what_is_no_file_is_kept() {
        use std::os::unix::fs::{FileTypeExt, symlink};
        use std::os::unix::net::UnixListener;
        let folder = Folder::new("links");
        fs::write(folder.file("out.csv"), "old").unwrap();
        symlink("out.csv", folder.file("link")).unwrap();
        write_atomically(&folder.file("link"), |w| w.write_all(b"new")).unwrap();
        assert_eq!(fs::read_to_string(folder.file("out.csv")).unwrap(), "new");
        assert!(fs::symlink_metadata(folder.file("link")).unwrap().is_symlink());

        // A socket replaces a device, which no test should put at risk. It cannot be opened, so that is an error.
        let _socket = UnixListener::bind(folder.file("socket")).unwrap();
        assert!(write_atomically(&folder.file("socket"), |w| w.write_all(b"new")).is_err());
        assert!(fs::metadata(folder.file("socket")).unwrap().file_type().is_socket());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_a_file_that_is_not_there_stays_a_link() {
        use std::os::unix::fs::symlink;
        let folder = Folder::new("dangling");
        symlink("middle", folder.file("link")).unwrap();
        symlink("out.csv", folder.file("middle")).unwrap();
        write_atomically(&folder.file("link"), |w| w.write_all(b"new")).unwrap();
        assert_eq!(folder.names(), ["link", "middle", "out.csv"]);
        assert_eq!(fs::read_to_string(folder.file("link")).unwrap(), "new");
        assert!(fs::symlink_metadata(folder.file("link")).unwrap().is_symlink());

        symlink("round", folder.file("round")).unwrap();
        assert!(write_atomically(&folder.file("round"), |w| w.write_all(b"new")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_kept_and_a_read_only_file_too() {
        use std::os::unix::fs::PermissionsExt;
        let folder = Folder::new("permissions");
        let path = folder.file("out.csv");
        fs::write(&path, "old").unwrap();
        for mode in [0o600, 0o664, 0o755] {
            fs::set_permissions(&path, Permissions::from_mode(mode)).unwrap();
            write_atomically(&path, |w| w.write_all(b"new")).unwrap();
            assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, mode);
        }
        fs::set_permissions(&path, Permissions::from_mode(0o444)).unwrap();
        assert!(check_writable(&path).is_err());
        assert!(write_atomically(&path, |w| w.write_all(b"newer")).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    }

    #[test]
    fn a_place_is_tried_without_a_trace() {
        let folder = Folder::new("tried");
        check_writable(&folder.file("out.csv")).unwrap();
        assert!(folder.names().is_empty());
        for place in ["", "missing/out.csv"] {
            assert!(check_writable(&folder.file(place)).is_err(), "{place}");
        }
    }
}
