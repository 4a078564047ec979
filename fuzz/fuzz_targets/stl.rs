#![no_main]

#[path = "../../crates/raysect-primitive/tests/readers/target.rs"]
mod target;

use raysect_primitive::mesh::io::MeshFormat;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    target::read_anything(MeshFormat::Stl, bytes);
});
