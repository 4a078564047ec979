//! Scenes as files: what is read is what was saved, to the last bit, and what is no scene is refused.

#[path = "../../examples/common/cornell.rs"]
mod cornell;

mod cameras;
mod cornell_box;
mod faults;
mod kinds;
mod mutations;
mod sensors;
mod sharing;
mod users;

use raysect::prelude::*;
use raysect::save::{SavedScene, SceneWriter, registry};

/// A world as text.
fn text_of(world: &World) -> String {
    SceneWriter::new(world).unwrap().to_json()
}

/// The scene of a text, with the library's own kinds.
fn read(text: &str) -> raysect::Result<SavedScene> {
    Ok(SavedScene::from_json(text, &registry())?)
}

/// Why a text is refused.
#[track_caller]
fn refusal(text: &str) -> String {
    read(text).err().unwrap_or_else(|| panic!("accepted:\n{text}")).to_string()
}
