use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::FileError;

static COUNTER: AtomicU64 = AtomicU64::new(0);

/// Writes a file that at any moment is either the old one or the whole new one.
///
/// The bytes go to a temporary file in the same folder, are forced to the disk, and the temporary file then
/// takes the place of `path`; on failure it is removed and `path` is untouched. Writing is buffered.
/// An existing file keeps its permissions, and a symbolic link stays a link.
///
/// # Errors
/// [`FileError::Io`], also with whatever `write` returns, and if `path` is read-only or no regular file.
pub fn write_atomically(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    let path = path.as_ref();
    replace(path, write).map_err(|source| FileError::io(path, source))
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let (target, permissions) = target(path)?;
    let (temporary, file) = Temporary::create(&target)?;
    let mut writer = BufWriter::new(file);
    write(&mut writer)?;
    let file = writer.into_inner().map_err(|error| error.into_error())?;
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    file.sync_all()?;
    drop(file);
    temporary.rename(&target)
}

/// The file that is to be replaced, with all links followed, and its permissions if it exists.
fn target(path: &Path) -> io::Result<(PathBuf, Option<Permissions>)> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok((path.to_owned(), None)),
        Err(error) => return Err(error),
    };
    if !metadata.is_file() {
        return Err(io::Error::new(ErrorKind::InvalidInput, "not a regular file"));
    }
    if metadata.permissions().readonly() {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "the file is read-only"));
    }
    Ok((fs::canonicalize(path)?, Some(metadata.permissions())))
}

/// A file that is removed unless it takes the place of another.
struct Temporary {
    path: PathBuf,
    kept: bool,
}

impl Temporary {
    fn create(target: &Path) -> io::Result<(Self, File)> {
        if target.file_name().is_none() {
            return Err(io::Error::new(ErrorKind::InvalidInput, "the path names no file"));
        }
        loop {
            let number = COUNTER.fetch_add(1, Ordering::Relaxed);
            let path = target.with_file_name(format!(".raysect-{}-{number}.tmp", std::process::id()));
            match File::create_new(&path) {
                Ok(file) => return Ok((Self { path, kept: false }, file)),
                // Left behind by a process of the same number that was killed.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }

    fn rename(mut self, target: &Path) -> io::Result<()> {
        fs::rename(&self.path, target)?;
        self.kept = true;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.kept {
            let _ = fs::remove_file(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::scratch::Folder;
    use super::*;

    #[test]
    fn replaces_the_whole_file() {
        let folder = Folder::new();
        let path = folder.join("a.bin");
        write_atomically(&path, |writer| writer.write_all(b"first")).unwrap();
        write_atomically(&path, |writer| {
            writer.write_all(b"second")?;
            assert_eq!(fs::read(&path)?, b"first");
            Ok(())
        })
        .unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(folder.names(), ["a.bin"]);
    }

    #[test]
    fn failure_leaves_the_old_file_and_nothing_else() {
        let folder = Folder::new();
        let path = folder.join("a.bin");
        write_atomically(&path, |writer| writer.write_all(b"old")).unwrap();
        let result = write_atomically(&path, |writer| {
            writer.write_all(&[0; 100_000])?;
            Err(io::Error::other("half way"))
        });
        assert_eq!(result.unwrap_err().to_string(), format!("{}: half way", path.display()));
        let unwound = std::panic::catch_unwind(|| write_atomically(&path, |_| panic!("in the closure")));
        assert!(unwound.is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(folder.names(), ["a.bin"]);
    }

    #[test]
    fn refuses_folders_and_protected_files() {
        let folder = Folder::new();
        assert!(matches!(write_atomically(folder.path(), |_| Ok(())), Err(FileError::Io { .. })));
        assert!(matches!(write_atomically(folder.join("no/a"), |_| Ok(())), Err(FileError::Io { .. })));
        assert!(matches!(write_atomically("", |_| Ok(())), Err(FileError::Io { .. })));
        let path = folder.join("a.bin");
        fs::write(&path, b"kept").unwrap();
        let mut permissions = fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        assert!(matches!(write_atomically(&path, |_| Ok(())), Err(FileError::Io { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"kept");
        assert_eq!(folder.names(), ["a.bin"]);
    }

    #[cfg(unix)]
    #[test]
    fn follows_links_and_keeps_permissions() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = Folder::new();
        let (path, link) = (folder.join("a.bin"), folder.join("link"));
        fs::write(&path, b"old").unwrap();
        fs::set_permissions(&path, Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        write_atomically(&link, |writer| writer.write_all(b"new")).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }

    #[test]
    fn many_threads_write_one_path() {
        let folder = Folder::new();
        let path = folder.join("a.bin");
        std::thread::scope(|scope| {
            for byte in 0..8 {
                let path = &path;
                scope.spawn(move || {
                    write_atomically(path, |writer| writer.write_all(&[byte; 50_000])).unwrap();
                    let seen = fs::read(path).unwrap();
                    assert!(seen.len() == 50_000 && seen.iter().all(|&b| b == seen[0]));
                });
            }
        });
        assert_eq!(folder.names(), ["a.bin"]);
    }
}
