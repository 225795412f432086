//! Output that is there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Creates or replaces a file with what `write` writes, or leaves everything as it was if that fails.
///
/// The text goes to a temporary file in the same folder, which takes the name at the end and is removed on error. A
/// link is followed, so that its target is replaced. What is not a file (a pipe, a terminal, `/dev/null`) cannot be
/// replaced: it gets the whole text at the end.
///
/// # Errors
/// Those of `write` and of the file system.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let target = match fs::metadata(path) {
        Ok(existing) if !existing.is_file() => {
            let mut text = Vec::new();
            write(&mut text)?;
            return File::options().write(true).open(path)?.write_all(&text);
        }
        Ok(_) => fs::canonicalize(path)?,
        Err(_) => path.into(),
    };
    let (temporary, file) = Temporary::beside(&target)?;
    let mut writer = BufWriter::new(file);
    write(&mut writer)?;
    // Closed before it is renamed, as some systems want.
    drop(writer.into_inner()?);
    fs::rename(&temporary.0, &target)
}

/// A file that is removed in the end, unless it has got another name by then.
struct Temporary(PathBuf);

impl Temporary {
    fn beside(target: &Path) -> io::Result<(Self, File)> {
        let Some(name) = target.file_name() else {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"));
        };
        let mut number = 0_u32;
        loop {
            let temporary = target.with_file_name(format!(".{}.{number}.tmp", name.to_string_lossy()));
            match File::create_new(&temporary) {
                Ok(file) => return Ok((Self(temporary), file)),
                // Of another run: take the next number.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                Err(error) => return Err(error),
            }
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // Renamed away or not removable: either way nothing is left to do.
        fs::remove_file(&self.0).ok();
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
    fn a_taken_temporary_name_is_left_alone() {
        let folder = Folder::new("taken");
        fs::write(folder.file(".out.csv.0.tmp"), "of another run").unwrap();
        write_atomically(&folder.file("out.csv"), |w| w.write_all(b"new")).unwrap();
        assert_eq!(folder.names(), [".out.csv.0.tmp", "out.csv"]);
        assert_eq!(fs::read_to_string(folder.file(".out.csv.0.tmp")).unwrap(), "of another run");
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

        // A socket stands for a device, which no test should put at risk. It cannot be opened, so that is an error.
        let _socket = UnixListener::bind(folder.file("socket")).unwrap();
        assert!(write_atomically(&folder.file("socket"), |w| w.write_all(b"new")).is_err());
        assert!(fs::metadata(folder.file("socket")).unwrap().file_type().is_socket());
    }
}
