use std::path::{Path, PathBuf};

use raysect_core::save::{Entry, MakeError, SaveError, Saved};

use crate::{Frame, MonoDisplay, ObserverError, Shown};

/// How a pipeline of one channel shows what it has gathered, and where after every pass.
#[derive(Debug, Default)]
pub(super) struct Output {
    pub(super) display: MonoDisplay,
    pub(super) preview: Option<PathBuf>,
}

impl Output {
    /// A picture of the first channel, or a file of all numbers.
    pub(super) fn save(&self, frame: &Frame, path: &Path) -> Result<(), ObserverError> {
        if has_ending(path, "png") {
            return frame.save_map(path, 0, Shown::Mean, &self.display);
        }
        frame.save(path)
    }

    pub(super) fn rewrite(&self, frame: &Frame) -> Result<(), ObserverError> {
        self.preview.as_ref().map_or(Ok(()), |path| self.save(frame, path))
    }

    pub(super) fn save_settings(&self, frame: &Frame, saved: Saved) -> Result<Saved, SaveError> {
        save_preview(self.preview.as_deref(), self.display.save(saved.text("name", frame.name())))
    }

    pub(super) fn load_settings(entry: &Entry<'_>) -> Result<Self, MakeError> {
        Ok(Self { display: MonoDisplay::load(entry)?, preview: load_preview(entry)? })
    }
}

/// Gives a frame the name that was saved, if one was.
pub(super) fn load_name(frame: &mut Frame, entry: &Entry<'_>) -> Result<(), SaveError> {
    if entry.has("name") {
        frame.rename(entry.text("name")?.to_owned());
    }
    Ok(())
}

/// True if a name ends in a dot and these letters, in any case.
pub(super) fn has_ending(path: &Path, letters: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(letters))
}

/// The path of a preview as a field, if there is one.
pub(super) fn save_preview(preview: Option<&Path>, saved: Saved) -> Result<Saved, SaveError> {
    let Some(path) = preview else { return Ok(saved) };
    match path.to_str() {
        Some(path) => Ok(saved.text("preview", path)),
        None => Err(SaveError::NoPlace(format!("the path {}, which is not Unicode,", path.display()))),
    }
}

pub(super) fn load_preview(entry: &Entry<'_>) -> Result<Option<PathBuf>, SaveError> {
    entry.has("preview").then(|| entry.text("preview").map(PathBuf::from)).transpose()
}
