use std::fmt::Write;

use raysect_core::save::SceneWriter;
use raysect_optical::{PathSettings, World};

/// What a statepoint knows a scene by.
///
/// A scene that can be saved is known by all that its file would hold, to the last bit. Of shapes, materials and functions
/// that do not say how they are saved their kinds are known, and place and box of every shape, but not what they do; all
/// others of the scene are known to the last bit.
pub(crate) fn scene_fingerprint(world: &World, paths: &PathSettings) -> String {
    let (kind, hash) = match SceneWriter::new(world) {
        Ok(writer) => ("saved form", fnv(writer.to_json().as_bytes())),
        Err(_) => ("description", fnv((SceneWriter::describe(world) + &facts(world)).as_bytes())),
    };
    format!("{kind} {hash:016x}, {paths:?}")
}

fn facts(world: &World) -> String {
    let mut text = world.tree();
    let instances = world.scene().map(|scene| &scene.instances[..]).unwrap_or_default();
    for instance in instances {
        // Writing to a text cannot fail.
        let _ = write!(text, "{:?} {:?}", instance.to_world.to_rows(), instance.bounds);
    }
    text
}

/// FNV-1a of 64 bits (G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, *The FNV Non-Cryptographic Hash Algorithm*, 2012).
fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::fnv;

    #[test]
    fn published_values_are_met() {
        assert_eq!(fnv(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
