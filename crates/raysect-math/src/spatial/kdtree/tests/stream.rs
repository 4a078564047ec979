//! Stored trees, sound and broken.

use std::io::{self, ErrorKind, Read};

use super::*;

fn written<const N: usize>(tree: &KdTree<N>) -> Vec<u8> {
    let mut bytes = Vec::new();
    tree.write(&mut bytes).unwrap();
    bytes
}

fn small() -> (Vec<KdItem<2>>, Vec<u8>) {
    let items: Vec<KdItem<2>> = random_items(&mut Rng::new(12), 9, true);
    let tree = KdTree::new(items.clone()).unwrap();
    assert!(tree.nodes.len() > 10);
    let bytes = written(&tree);
    (items, bytes)
}

fn check<const N: usize>(count: u32) {
    let items: Vec<KdItem<N>> = random_items(&mut Rng::new(2), count, false);
    let tree = KdTree::new(items.clone()).unwrap();
    let bytes = written(&tree);
    let read = KdTree::read(&mut &bytes[..], items).unwrap();
    assert_eq!(read, tree);
    assert_eq!(written(&read), bytes);
}

#[test]
fn what_is_written_is_read() {
    for count in [0, 1, 500] {
        check::<2>(count);
        check::<3>(count);
    }
}

/// One box from (1, 2, 3) to (4, 5, 6), and two boxes on both sides of x = 2, byte for byte.
#[test]
fn the_bytes_are_those_of_the_layout() {
    let header = |max_depth: i32, bounds: [f64; 6], nodes: i32| {
        let mut bytes = [max_depth.to_le_bytes(), 1i32.to_le_bytes()].concat();
        bytes.extend([20.0, 0.2].iter().chain(&bounds).flat_map(|x: &f64| x.to_le_bytes()));
        bytes.extend(nodes.to_le_bytes());
        bytes
    };
    let ints = |values: &[i32]| values.iter().flat_map(|i| i.to_le_bytes()).collect::<Vec<u8>>();
    let one = KdTree3D::new([KdItem::new(7, [1.0, 2.0, 3.0], [4.0, 5.0, 6.0]).unwrap()]).unwrap();
    assert_eq!(written(&one), [header(8, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 1), ints(&[-1, 1, 7])].concat());
    let left = KdItem::new(3, [0.0; 3], [2.0, 1.0, 1.0]).unwrap();
    let right = KdItem::new(4, [2.0, 0.0, 0.0], [9.0, 1.0, 1.0]).unwrap();
    // 8 + 1.3 ln 2 = 8.9; the bounds of (0, 0, 0) … (9, 1, 1) are cut at x = 2.
    let mut expected = header(9, [0.0, 0.0, 0.0, 9.0, 1.0, 1.0], 3);
    expected.extend(ints(&[0]));
    expected.extend(2.0f64.to_le_bytes());
    expected.extend(ints(&[2, -1, 1, 3, -1, 1, 4]));
    assert_eq!(written(&KdTree3D::new([left, right]).unwrap()), expected);
}

/// The offset that an error names.
fn offset(error: &MathError) -> u64 {
    match error {
        MathError::KdTreeFormat { offset, .. } | MathError::KdTreeStream { offset, .. } => *offset,
        other => panic!("{other} names no byte"),
    }
}

#[test]
fn every_cut_is_an_error_where_the_stream_ends() {
    let (items, bytes) = small();
    for end in 0..bytes.len() {
        let error = KdTree2D::read(&mut &bytes[..end], items.clone()).unwrap_err();
        let at = offset(&error);
        assert!(matches!(error, MathError::KdTreeStream { kind: ErrorKind::UnexpectedEof, .. }), "{error}");
        assert!(at <= end as u64 && end as u64 - at < 8, "{error}, cut at {end}");
    }
}

#[test]
fn every_changed_byte_gives_an_error_or_a_tree_that_ends() {
    let (items, bytes) = small();
    let (mut refused, mut taken) = (0, 0);
    for at in 0..bytes.len() {
        for flip in [0x01, 0x02, 0x04, 0x40, 0x80, 0xff] {
            let mut broken = bytes.clone();
            broken[at] ^= flip;
            match KdTree2D::read(&mut &broken[..], items.clone()) {
                Err(error) => {
                    assert!(offset(&error) <= bytes.len() as u64);
                    refused += 1;
                }
                Ok(tree) => {
                    walk_everywhere(&tree);
                    taken += 1;
                }
            }
        }
    }
    // Digits of planes and settings may be anything, other bytes may not.
    assert!(refused > 100 && taken > 100, "{refused} refused, {taken} taken");
}

/// Asks for points and rays; each leaf may be visited once.
fn walk_everywhere(tree: &KdTree2D) {
    let mut rng = Rng::new(6);
    for _ in 0..20 {
        let [x, y, u, v] = std::array::from_fn(|_| (12.0 * rng.uniform()).round() / 2.0);
        let mut visits = 0;
        tree.items_containing([x, y]);
        tree.trace([x, y], [u - 3.0, v - 3.0], f64::INFINITY, |_, limit| {
            visits += 1;
            limit
        });
        assert!(visits <= tree.nodes.len());
    }
}

/// A tree of three leaves; `fields` replaces what stands from a byte on.
fn patched(at: usize, field: &[u8]) -> Result<KdTree2D, MathError> {
    let items = [0.0, 5.0, 10.0].map(|x| KdItem::new(x as u32 / 5, [x, 0.0], [x + 1.0, 1.0]).unwrap());
    let mut bytes = written(&KdTree2D::new(items).unwrap());
    // 8 + 16 + 32 bytes, then the number of nodes at 56 and the first branch at 60.
    assert_eq!(bytes[56..64], [[5, 0, 0, 0], [0, 0, 0, 0]].concat());
    bytes[at..at + field.len()].copy_from_slice(field);
    KdTree2D::read(&mut &bytes[..], items)
}

#[test]
fn impossible_fields_are_refused_at_their_place() {
    assert!(patched(0, &[]).is_ok());
    let int = |i: i32| i.to_le_bytes().to_vec();
    let float = |x: f64| x.to_le_bytes().to_vec();
    // The first branch fills the bytes 60…75, and its upper child is node 2.
    for (at, field, named) in [
        (8, float(f64::NAN), 8),
        (24, float(f64::NAN), 24),
        (24, float(100.0), 24),
        (40, float(f64::INFINITY), 24),
        (56, int(0), 56),
        (56, int(-1), 56),
        (60, int(2), 60),
        (60, int(-2), 60),
        (64, float(f64::NAN), 64),
        (64, float(f64::NEG_INFINITY), 64),
        // Upper children: the node itself, before it, the lower child, beyond the end, a stranger's.
        (72, int(0), 72),
        (72, int(-1), 72),
        (72, int(1), 72),
        (72, int(5), 72),
        (72, int(i32::MAX), 72),
        (72, int(3), 72),
    ] {
        let refused = patched(at, &field);
        match &refused {
            Err(MathError::KdTreeFormat { offset, .. }) => assert_eq!(*offset, named, "{refused:?}"),
            other => panic!("byte {at} set to {field:?} gives {other:?}"),
        }
    }
}

/// Header of a tree over no, or one, flat item at the origin.
fn header(nodes: i32) -> Vec<u8> {
    let mut bytes = [8i32.to_le_bytes(), 1i32.to_le_bytes()].concat();
    bytes.extend([20.0, 0.2, 0.0, 0.0, 0.0, 0.0].iter().flat_map(|x: &f64| x.to_le_bytes()));
    bytes.extend(nodes.to_le_bytes());
    bytes
}

fn read_one(bytes: &[u8]) -> Result<KdTree2D, MathError> {
    KdTree2D::read(&mut &bytes[..], [KdItem::new(4, [0.0; 2], [0.0; 2]).unwrap()])
}

#[test]
fn leaves_hold_known_items_and_no_more_than_there_are() {
    let leaf = |fields: &[i32]| {
        let mut bytes = header(1);
        bytes.extend(fields.iter().flat_map(|i| i.to_le_bytes()));
        read_one(&bytes).map_err(|error| offset(&error))
    };
    assert_eq!(leaf(&[-1, 1, 4]).unwrap().items_containing([0.0, -0.0]), [4]);
    assert_eq!(leaf(&[-1, 1, 3]), Err(68));
    assert_eq!(leaf(&[-1, 1, -1]), Err(68));
    for count in [-1, 2, i32::MAX, i32::MIN] {
        assert_eq!(leaf(&[-1, count, 4]), Err(64), "{count}");
    }
}

#[test]
fn huge_counts_allocate_nothing() {
    // Two thousand million nodes are said to follow.
    let error = read_one(&header(i32::MAX)).unwrap_err();
    assert_eq!(error, MathError::KdTreeStream { offset: 60, kind: ErrorKind::UnexpectedEof });
    assert_eq!(error.to_string(), "reading failed at byte 60 of the kd-tree: unexpected end of file");
}

#[test]
fn a_chain_of_branches_is_refused_beyond_the_limit() {
    let chain = |depth: u32| {
        let mut bytes = header(2 * depth as i32 + 1);
        for level in 0..depth {
            bytes.extend([0u32.to_le_bytes(), [0; 4], [0; 4], (2 * depth - level).to_le_bytes()].concat());
        }
        for _ in 0..=depth {
            bytes.extend([(-1i32).to_le_bytes(), [0; 4]].concat());
        }
        read_one(&bytes)
    };
    let deepest = chain(KdTreeSettings::DEEPEST).unwrap();
    walk_everywhere(&deepest);
    assert!(matches!(chain(KdTreeSettings::DEEPEST + 1), Err(MathError::KdTreeFormat { .. })));
}

#[test]
fn nodes_that_no_branch_names_are_refused() {
    let mut bytes = header(2);
    bytes.extend([(-1i32).to_le_bytes(), [0; 4], (-1i32).to_le_bytes(), [0; 4]].concat());
    assert!(matches!(read_one(&bytes), Err(MathError::KdTreeFormat { offset: 68, .. })));
}

#[test]
fn a_stream_that_fails_says_so() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(ErrorKind::ConnectionReset.into())
        }
    }
    let error = KdTree2D::read(&mut Broken, []).unwrap_err();
    assert_eq!(error, MathError::KdTreeStream { offset: 0, kind: ErrorKind::ConnectionReset });
    let tree = KdTree2D::new([]).unwrap();
    assert!(tree.write(&mut &mut [0; 10][..]).is_err());
}
