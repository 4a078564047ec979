//! Files of pictures, arrays and tables: PNG, OpenEXR, `.npz` and `.csv`.
//!
//! Every file is written whole or not at all, see [`write_atomically`], and equal contents give equal bytes.

mod atomic;
mod csv;
mod error;
mod exr;
mod npy;
mod npy_read;
mod npz;
mod png;
mod zip_read;
mod zip_write;

pub use self::exr::{ExrAttribute, ExrLayer, save_exr};
pub use atomic::write_atomically;
pub use csv::save_csv;
pub use error::FileError;
pub use npy::{NpyArray, NpyData};
pub use npz::{load_npz, save_npz};
#[cfg(feature = "plot")]
pub(crate) use png::png_rgb8;
pub use png::{save_png_rgb8, save_png_rgb16};

#[cfg(test)]
pub(crate) mod scratch {
    use std::path::{Path, PathBuf};
    use std::sync::atomic::{AtomicUsize, Ordering};

    static COUNTER: AtomicUsize = AtomicUsize::new(0);

    /// A folder of its own that vanishes with the test.
    pub(crate) struct Folder(PathBuf);

    impl Folder {
        pub(crate) fn new() -> Self {
            let number = COUNTER.fetch_add(1, Ordering::Relaxed);
            let folder = std::env::temp_dir().join(format!("raysect-file-{}-{number}", std::process::id()));
            std::fs::create_dir_all(&folder).unwrap();
            Self(folder)
        }

        pub(crate) fn path(&self) -> &Path {
            &self.0
        }

        pub(crate) fn join(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }

        /// The sorted names of the files inside.
        pub(crate) fn names(&self) -> Vec<String> {
            let entries = std::fs::read_dir(&self.0).unwrap();
            let mut names: Vec<String> =
                entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
            names.sort();
            names
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }
}
