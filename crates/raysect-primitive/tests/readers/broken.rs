//! Broken files give an error or a mesh, never a panic.

use std::time::{Duration, Instant};

use raysect_math::Rng;
use raysect_primitive::mesh::io::MeshFormat;

use crate::files;
use crate::target::read_anything;

const FORMATS: [MeshFormat; 5] =
    [MeshFormat::Obj, MeshFormat::Stl, MeshFormat::Ply, MeshFormat::Vtk, MeshFormat::Rsm];

fn seeds(format: MeshFormat) -> Vec<Vec<u8>> {
    let files = files().into_iter().filter(|&(_, f)| f == format);
    files.map(|(path, _)| std::fs::read(path).unwrap()).collect()
}

#[test]
fn every_truncation_is_an_error_or_a_mesh() {
    for format in FORMATS {
        for whole in seeds(format) {
            assert!(read_anything(format, &whole));
            let read = (0..whole.len()).filter(|&end| read_anything(format, &whole[..end])).count();
            // Texts may lose digits of their last number or the end of their last line, sections may be optional.
            let most = if format == MeshFormat::Rsm { 0 } else { 350 };
            assert!(read <= most, "{format:?}: {read} of {}", whole.len());
        }
    }
}

#[test]
fn every_wrong_byte_is_an_error_or_a_mesh() {
    for format in FORMATS {
        let (mut read, mut refused) = (0, 0);
        for mut bytes in seeds(format) {
            for at in 0..bytes.len() {
                let right = bytes[at];
                let flips = (0..8).map(|bit| right ^ 1 << bit);
                for wrong in [0x00, 0xff].into_iter().chain(flips) {
                    bytes[at] = wrong;
                    if read_anything(format, &bytes) { read += 1 } else { refused += 1 }
                }
                bytes[at] = right;
            }
        }
        // Both happen: a coordinate can be another one, a count cannot.
        assert!(read > 100 && refused > 100, "{format:?}: {read} read, {refused} refused");
    }
}

/// Changes some bytes: one replaced, some removed, some repeated, a number put in, two files joined.
fn mutate(bytes: &mut Vec<u8>, other: &[u8], rng: &mut Rng) {
    const WORDS: [&[u8]; 16] = [
        b"-1",
        b"0",
        b"1e999",
        b"nan",
        b"4294967295",
        b"2147483648",
        b"18446744073709551615",
        b" ",
        b"\n",
        b"\\\n",
        b"/",
        b"\xff\xff\xff\xff",
        b"\x00\x00\x00\x80",
        b"\xff\xff\xff\x7f",
        b"\x00\x00\xc0\x7f",
        b"9223372036854775808",
    ];
    let below = |rng: &mut Rng, n: usize| ((rng.uniform() * n as f64) as usize).min(n.saturating_sub(1));
    for _ in 0..1 + below(rng, 4) {
        let at = below(rng, bytes.len() + 1).min(bytes.len());
        let end = (at + below(rng, 40)).min(bytes.len());
        match below(rng, 6) {
            0 if at < bytes.len() => bytes[at] = below(rng, 256) as u8,
            1 => drop(bytes.drain(at..end)),
            2 => {
                let again = bytes[at..end].to_vec();
                bytes.splice(at..at, again);
            }
            3 => drop(bytes.splice(at..at, WORDS[below(rng, WORDS.len())].iter().copied())),
            4 => drop(bytes.splice(at..end, WORDS[below(rng, WORDS.len())].iter().copied())),
            _ => {
                let from = below(rng, other.len());
                bytes.truncate(at);
                bytes.extend(&other[from..]);
            }
        }
    }
}

#[test]
fn mutations_are_errors_or_meshes() {
    for (stream, format) in FORMATS.into_iter().enumerate() {
        let seeds = seeds(format);
        let mut rng = Rng::new(7 + stream as u64);
        let (start, mut read) = (Instant::now(), 0);
        for round in 0..2000 {
            let mut bytes = seeds[round % seeds.len()].clone();
            mutate(&mut bytes, &seeds[(round / 7) % seeds.len()], &mut rng);
            read += usize::from(read_anything(format, &bytes));
        }
        assert!(start.elapsed() < Duration::from_secs(20), "{format:?} took {:?}", start.elapsed());
        assert!((20..1980).contains(&read), "{format:?}: {read} of 2000");
    }
}

#[test]
fn random_bytes_are_refused() {
    let mut rng = Rng::new(11);
    for format in FORMATS {
        for length in 0..400 {
            let bytes: Vec<u8> = (0..length).map(|_| (rng.uniform() * 256.0) as u8).collect();
            assert!(!read_anything(format, &bytes));
        }
    }
}

#[test]
fn a_file_of_another_format_is_refused() {
    for format in FORMATS {
        for other in FORMATS.into_iter().filter(|&other| other != format) {
            assert!(
                seeds(other).iter().all(|bytes| !read_anything(format, bytes)),
                "{other:?} as {format:?}"
            );
        }
    }
}
