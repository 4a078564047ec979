use super::super::scratch::Folder;
use super::*;
use proptest::prelude::*;

fn array(shape: &[usize], data: NpyData) -> NpyArray {
    NpyArray { shape: shape.to_vec(), data }
}

fn sample() -> Vec<(&'static str, NpyArray)> {
    let numbers = vec![0.1, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE / 8.0, f64::MAX];
    vec![
        ("mean", array(&[2, 3], NpyData::F64(numbers))),
        ("samples", array(&[2], NpyData::U64(vec![0, u64::MAX]))),
        ("offset", array(&[1, 1, 2], NpyData::I64(vec![i64::MIN, i64::MAX]))),
        ("bytes", array(&[4], NpyData::U8(vec![0, 1, 127, 255]))),
        ("mask", array(&[2, 1], NpyData::Bool(vec![true, false]))),
        ("λ/names", array(&[3], NpyData::Text(vec!["α β".into(), String::new(), "𝔸z".into()]))),
        ("empty", array(&[0, 5], NpyData::F64(vec![]))),
        ("no text", array(&[0], NpyData::Text(vec![]))),
        ("gain", NpyArray::scalar(2.5)),
        ("version", NpyArray::text("0.1.0")),
    ]
}

fn sample_map() -> BTreeMap<String, NpyArray> {
    sample().into_iter().map(|(name, array)| (name.to_owned(), array)).collect()
}

fn packed(zip64_limit: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_archive(&mut bytes, &sample(), zip64_limit).unwrap();
    bytes
}

fn set(bytes: &mut [u8], at: usize, value: &[u8]) {
    bytes[at..at + value.len()].copy_from_slice(value);
}

#[test]
fn arrays_come_back() {
    let folder = Folder::new();
    let path = folder.join("a.npz");
    save_npz(&path, &sample()).unwrap();
    assert_eq!(load_npz(&path).unwrap(), sample_map());
    save_npz::<&str>(&path, &[]).unwrap();
    assert!(load_npz(&path).unwrap().is_empty());
    assert_eq!(folder.names(), ["a.npz"]);
}

#[test]
fn bits_of_not_a_number_come_back() {
    let folder = Folder::new();
    let path = folder.join("a.npz");
    let nan = f64::from_bits(0x7ff8_dead_beef_0001);
    save_npz(&path, &[("x", NpyArray::scalar(nan))]).unwrap();
    let NpyData::F64(values) = &load_npz(&path).unwrap()["x"].data else { panic!("another type") };
    assert_eq!(values[0].to_bits(), nan.to_bits());
}

#[test]
fn large_archives_use_fields_of_64_bits() {
    let plain = packed(ZIP64_LIMIT).len();
    for limit in [0, 100, 300, 1000, 1500] {
        let bytes = packed(limit);
        assert!(bytes.len() > plain, "limit {limit}");
        assert_eq!(read_archive(&bytes).unwrap(), sample_map(), "limit {limit}");
    }
}

#[test]
fn more_than_65535_arrays() {
    let names: Vec<String> = (0..70_000).map(|i| format!("a{i:05}")).collect();
    let arrays: Vec<_> = names.iter().map(|name| (name, NpyArray::scalar(1.0))).collect();
    let mut bytes = Vec::new();
    write_archive(&mut bytes, &arrays, ZIP64_LIMIT).unwrap();
    assert_eq!(read_archive(&bytes).unwrap().len(), 70_000);
}

#[test]
fn deflated_entries_are_read() {
    let mut npy = Vec::new();
    array(&[1000], NpyData::F64(vec![3.0; 1000])).write(&mut npy).unwrap();
    let deflated = miniz_oxide::deflate::compress_to_vec(&npy, 6);
    let mut bytes = Vec::new();
    let mut archive = ZipWriter::new(&mut bytes, ZIP64_LIMIT);
    archive.add("x.npy", deflated.len() as u64, &|writer| writer.write_all(&deflated)).unwrap();
    archive.finish().unwrap();
    let record = bytes.len() - 22 - 46 - 5;
    set(&mut bytes, record + 10, &8u16.to_le_bytes());
    set(&mut bytes, record + 16, &crc32fast::hash(&npy).to_le_bytes());
    set(&mut bytes, record + 24, &(npy.len() as u32).to_le_bytes());
    assert_eq!(read_archive(&bytes).unwrap()["x"].data, NpyData::F64(vec![3.0; 1000]));
    for size in [npy.len() as u32 - 1, npy.len() as u32 + 1, u32::MAX - 1] {
        set(&mut bytes, record + 24, &size.to_le_bytes());
        assert!(read_archive(&bytes).is_err(), "{size} bytes declared");
    }
}

#[test]
fn refuses_what_numpy_would_not_read() {
    let folder = Folder::new();
    let path = folder.join("a.npz");
    let one = NpyArray::scalar(1.0);
    let shape = save_npz(&path, &[("a", array(&[2, 2], NpyData::F64(vec![1.0; 3])))]);
    assert!(matches!(shape, Err(FileError::Shape { name, expected: 4, found: 3, .. }) if name == "a"));
    for name in ["", "a\0b", &"x".repeat(65532)] {
        assert!(matches!(save_npz(&path, &[(name, one.clone())]), Err(FileError::Encode { .. })));
    }
    for arrays in [
        vec![("a", one.clone()), ("a", one)],
        vec![("a", array(&[1; 33], NpyData::U8(vec![1])))],
        vec![("a", NpyArray::text("x\0"))],
    ] {
        assert!(matches!(save_npz(&path, &arrays), Err(FileError::Encode { .. })));
    }
    assert!(folder.names().is_empty());
}

#[test]
fn errors_name_path_and_offset() {
    let folder = Folder::new();
    let path = folder.join("a.npz");
    assert!(matches!(load_npz(&path), Err(FileError::Io { .. })));
    assert!(matches!(load_npz(folder.path()), Err(FileError::Io { .. })));
    for (contents, fault) in [
        (&b""[..], "byte 0: not a zip"),
        (b"%PDF-1.7 and so on", "byte 0: not a zip"),
        (b"\x93NUMPY\x01\x00", "a single array (.npy)"),
        (b"PK\x03\x04 and nothing else to follow", "byte 31: the archive is cut short"),
    ] {
        std::fs::write(&path, contents).unwrap();
        let message = load_npz(&path).unwrap_err().to_string();
        assert!(message.starts_with(&path.display().to_string()) && message.contains(fault), "{message}");
    }
    let mut bytes = packed(ZIP64_LIMIT);
    bytes[200] ^= 1;
    std::fs::write(&path, &bytes).unwrap();
    let message = load_npz(&path).unwrap_err().to_string();
    assert!(message.contains("byte 38: the entry 'mean.npy': checksum"), "{message}");
}

#[test]
fn every_truncation_is_noticed() {
    for limit in [0, ZIP64_LIMIT] {
        let bytes = packed(limit);
        for length in 0..bytes.len() {
            assert!(read_archive(&bytes[..length]).is_err(), "{length} of {} bytes", bytes.len());
        }
    }
}

#[test]
fn every_changed_bit_is_noticed_or_harmless() {
    let (mut bytes, original) = (packed(ZIP64_LIMIT), sample_map());
    for at in 0..bytes.len() {
        for bit in 0..8 {
            bytes[at] ^= 1 << bit;
            if let Ok(arrays) = read_archive(&bytes) {
                assert!(arrays == original, "bit {bit} of byte {at}");
            }
            bytes[at] ^= 1 << bit;
        }
    }
}

#[test]
fn absurd_sizes_claim_no_memory() {
    let bytes = packed(0);
    for value in [u64::MAX, u64::MAX / 2, 1 << 62, 1 << 40, 0] {
        for at in 0..bytes.len() - 8 {
            let mut changed = bytes.clone();
            set(&mut changed, at, &value.to_le_bytes());
            if let Ok(arrays) = read_archive(&changed) {
                assert!(arrays.values().all(|array| array.data.len() < bytes.len()));
            }
        }
    }
}

proptest! {
    #[test]
    fn damaged_files_do_not_panic(
        zip64 in any::<bool>(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        length in any::<prop::sample::Index>(),
        cut in any::<bool>(),
    ) {
        let mut bytes = packed(if zip64 { 0 } else { ZIP64_LIMIT });
        for (at, byte) in flips {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if cut {
            bytes.truncate(length.index(bytes.len()));
        }
        let _ = read_archive(&bytes);
    }

    #[test]
    fn any_bytes_do_not_panic(mut bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = read_archive(&bytes);
        bytes.splice(0..0, *b"PK\x05\x06");
        let _ = read_archive(&bytes);
    }
}
