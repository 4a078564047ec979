use std::io::{self, Write};
use std::path::Path;

use super::FileError;

/// Writes a file that at any moment is either the old one or the whole new one, as
/// [`raysect_core::write_atomically`] does, with the path in its errors.
///
/// # Errors
/// [`FileError::Io`], also with whatever `write` returns, and if `path` is read-only or no regular file.
pub fn write_atomically(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    let path = path.as_ref();
    raysect_core::write_atomically(path, write).map_err(|source| FileError::io(path, source))
}

#[cfg(test)]
mod tests {
    use super::super::scratch::Folder;
    use super::*;
    use std::fs;

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
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
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
