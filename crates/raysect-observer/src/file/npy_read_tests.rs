use super::*;
use proptest::prelude::*;

fn npy(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend_from_slice(&[version, 0]);
    match version {
        1 => bytes.extend_from_slice(&(header.len() as u16).to_le_bytes()),
        _ => bytes.extend_from_slice(&(header.len() as u32).to_le_bytes()),
    }
    bytes.extend_from_slice(header.as_bytes());
    bytes.extend_from_slice(data);
    bytes
}

fn read(dtype: &str, shape: &str, fortran: &str, data: &[u8]) -> Result<NpyArray, Fault> {
    let header = format!("{{'descr': '{dtype}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
    read_npy(&npy(1, &header, data))
}

fn values(dtype: &str, data: &[u8], size: usize) -> NpyData {
    read(dtype, &format!("({},)", data.len() / size), "False", data).unwrap().data
}

#[test]
fn widens_narrow_numbers() {
    assert_eq!(values("<f4", &1.5f32.to_le_bytes(), 4), NpyData::F64(vec![1.5]));
    assert_eq!(values(">f4", &1.5f32.to_be_bytes(), 4), NpyData::F64(vec![1.5]));
    assert_eq!(values(">f8", &(-2.25f64).to_be_bytes(), 8), NpyData::F64(vec![-2.25]));
    assert_eq!(values("|i1", &[0xff, 7], 1), NpyData::I64(vec![-1, 7]));
    assert_eq!(values(">i2", &[0xff, 0xfe], 2), NpyData::I64(vec![-2]));
    assert_eq!(values("<i4", &(-3i32).to_le_bytes(), 4), NpyData::I64(vec![-3]));
    assert_eq!(values(">i8", &i64::MIN.to_be_bytes(), 8), NpyData::I64(vec![i64::MIN]));
    assert_eq!(values("|u1", &[0, 255], 1), NpyData::U8(vec![0, 255]));
    assert_eq!(values(">u2", &[1, 2], 2), NpyData::U64(vec![258]));
    assert_eq!(values("<u4", &[1, 2, 0, 0], 4), NpyData::U64(vec![513]));
    assert_eq!(values("<u8", &u64::MAX.to_le_bytes(), 8), NpyData::U64(vec![u64::MAX]));
    assert_eq!(values("|b1", &[0, 1, 1], 1), NpyData::Bool(vec![false, true, true]));
    assert_eq!(values(">U2", &[0, 0, 0, 0xe9, 0, 0, 0, 0], 8), NpyData::Text(vec!["é".to_owned()]));
}

#[test]
fn turns_fortran_order_round() {
    // a[i, j, k] = 100 i + 10 j + k, first index fastest.
    let bytes: Vec<u8> =
        (0..24).map(|n| (n % 2, n / 2 % 3, n / 6)).map(|(i, j, k)| (100 * i + 10 * j + k) as u8).collect();
    let array = read("|u1", "(2, 3, 4)", "True", &bytes).unwrap();
    let expected: Vec<u8> =
        (0..24).map(|n| (n / 12, n / 4 % 3, n % 4)).map(|(i, j, k)| (100 * i + 10 * j + k) as u8).collect();
    assert_eq!(array.data, NpyData::U8(expected));
    let empty = read("<f8", "(2, 0, 18446744073709551615)", "True", &[]).unwrap();
    assert_eq!((empty.shape, empty.data), (vec![2, 0, usize::MAX], NpyData::F64(vec![])));
    assert_eq!(read("|u1", "()", "True", &[9]).unwrap().data, NpyData::U8(vec![9]));
}

#[test]
fn reads_three_versions_and_any_order_of_keys() {
    for version in 1..=3 {
        let header = "{\"shape\": (2L,), 'fortran_order':False,'descr' : '|u1'}   \n";
        let array = read_npy(&npy(version, header, &[3, 4])).unwrap();
        assert_eq!(array, NpyArray { shape: vec![2], data: NpyData::U8(vec![3, 4]) });
    }
    assert_eq!(read_npy(&npy(4, "", &[])).unwrap_err().at, 6);
}

#[test]
fn refuses_what_it_cannot_read() {
    let what = |result: Result<NpyArray, Fault>| result.unwrap_err().what;
    assert!(what(read("<c16", "()", "False", &[0; 16])).contains("'<c16'"));
    assert!(what(read("|O", "()", "False", &[])).contains("'|O'"));
    assert!(what(read("<U0", "(1000000000000,)", "False", &[])).contains("'<U0'"));
    assert!(what(read("<U1", "()", "False", &[0, 0, 0x11, 0])).contains("0x110000"));
    assert!(what(read("<f8", "(3,)", "False", &[0; 23])).contains("23 bytes do not fill"));
    assert!(what(read("<f8", "(3,)", "False", &[0; 32])).contains("32 bytes do not fill"));
    assert!(what(read("<f8", "(-3,)", "False", &[])).contains("length of an axis"));
    assert!(what(read("<f8", "(18446744073709551616,)", "False", &[])).contains("length of an axis"));
    assert!(what(read("<f8", "(4611686018427387904, 4)", "False", &[])).contains("do not fill"));
    assert!(what(read("<f8", &format!("({})", "1,".repeat(65)), "False", &[0; 8])).contains("64 axes"));
    assert!(what(read("<f8", "()", "Perhaps", &[0; 8])).contains("True or False"));
    let record = "{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (), }";
    assert!(what(read_npy(&npy(1, record, &[0; 8]))).contains("records"));
    for (header, fault) in [
        ("{'descr': '<f8', 'shape': ()}", "lacks the key 'fortran_order'"),
        ("{'shape': (), 'shape': ()}", "repeated"),
        ("{'colour': 'red'}", "unknown"),
        ("{'descr': '<f8", "expected"),
        ("", "expected"),
        ("{'descr': '<f8', 'fortran_order': False, 'shape': (), } 7", "should end"),
    ] {
        assert!(what(read_npy(&npy(2, header, &[0; 8]))).contains(fault), "{header}");
    }
    assert!(what(read_npy(b"\x93NUMPY\x02\x00\xff\xff\xff\xff{")).contains("4294967295 bytes should follow"));
}

proptest! {
    #[test]
    fn changed_headers_do_not_panic(
        flips in prop::collection::vec((0..64usize, any::<u8>()), 1..4),
        fortran in any::<bool>(),
    ) {
        let order = if fortran { "True" } else { "False" };
        let header = format!("{{'descr': '<i2', 'fortran_order': {order}, 'shape': (2, 6), }}\n");
        let mut bytes = npy(1, &header, &[1; 24]);
        for (at, byte) in flips {
            bytes[at] = byte;
        }
        if let Ok(array) = read_npy(&bytes) {
            prop_assert_eq!(product(&array.shape), Some(array.data.len()));
        }
    }
}
