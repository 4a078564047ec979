//! The readers of mesh files through their public interface: files by others, and files that are broken in every way.

mod broken;
mod judges;
mod others;
mod target;

use std::path::{Path, PathBuf};

use raysect_primitive::mesh::io::MeshFormat;

/// The files of the folder `tests/data`, with their formats.
fn files() -> Vec<(PathBuf, MeshFormat)> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let folders = ["raysect", "vtk"].map(|folder| std::fs::read_dir(data.join(folder)).unwrap());
    let paths = folders.into_iter().flatten().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = paths.map(|path| (path.clone(), MeshFormat::of_name(&path).unwrap())).collect();
    files.sort_by(|a, b| a.0.cmp(&b.0));
    assert_eq!(files.len(), 23);
    files
}

/// A folder of its own that vanishes with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("raysect-readers-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    fn join(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
