//! Statistics, integrals, roots of functions, trees.

use proptest::prelude::*;
use raysect_math::spatial::{KdItem, KdTree2D};
use raysect_math::{
    BlockStatistics, Bracket, Statistics, StatisticsArray, find_root, integrate, solve_cubic,
    solve_quadratic, solve_quartic,
};

proptest! {
    #[test]
    fn integrals_of_cubics_are_exact(c in prop::array::uniform4(-2.0..2.0f64), a in -3.0..3.0f64, b in -3.0..3.0f64) {
        let f = |x: f64| ((c[3] * x + c[2]) * x + c[1]) * x + c[0];
        let whole = |x: f64| (((c[3] / 4.0 * x + c[2] / 3.0) * x + c[1] / 2.0) * x + c[0]) * x;
        let (value, error) = integrate(&f, a, b, 1.0, 1e-12);
        prop_assert!((value - (whole(b) - whole(a))).abs() < 1e-12 && error < 1e-11);
        prop_assert!((integrate(&f, b, a, 1.0, 1e-12).0 + value).abs() < 1e-12);
    }

    #[test]
    fn roots_of_rising_functions_are_found(root in -5.0..5.0f64, steep in 0.01..50.0f64, below in 0.1..9.0f64, above in 0.1..9.0f64) {
        let f = |x: f64| (x - root) * (steep + (x - root).powi(2));
        let slope = |x: f64| steep + 3.0 * (x - root).powi(2);
        let found = find_root(f, root - below, root + above, 0.0).unwrap();
        prop_assert!((found - root).abs() <= 4.0 * f64::EPSILON * root.abs().max(1e-3), "{found} {root}");
        let bracket = Bracket { low: root - below, high: root + above, rising: true };
        let newton = bracket.newton(0.0, |x| (f(x), slope(x)));
        prop_assert!((newton - root).abs() <= 4.0 * f64::EPSILON * root.abs().max(1e-3), "{newton} {root}");
        let falling = Bracket { rising: false, ..bracket };
        prop_assert_eq!(falling.newton(0.0, |x| (-f(x), -slope(x))), newton);
        prop_assert!(find_root(f, root + 0.5 * above, root + above, 0.0).is_err());
    }

    #[test]
    fn quadratics_are_solved_as_made(p in -1e3..1e3f64, q in -1e3..1e3f64, a in 0.1..10.0f64) {
        // Few bits: the coefficients are exact.
        let [p, q, a] = [p, q, a].map(|x| (x * 64.0).round() / 64.0);
        let roots = solve_quadratic(a, -a * (p + q), a * p * q);
        prop_assert_eq!(roots.len(), 2);
        for (found, expected) in roots.iter().zip([p.min(q), p.max(q)]) {
            prop_assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs());
        }
        prop_assert_eq!(solve_cubic(0.0, a, -a * (p + q), a * p * q)[..].to_vec(), roots[..].to_vec());
        prop_assert_eq!(solve_quartic(0.0, 0.0, a, -a * (p + q), a * p * q)[..].to_vec(), roots[..].to_vec());
    }

    #[test]
    fn blocks_have_the_statistics_of_their_means(x in prop::collection::vec(-1.0..1.0f64, 0..60), size in 1..9u32) {
        let mut blocks = BlockStatistics::new(size);
        let mut means = Statistics::new();
        x.iter().for_each(|&x| blocks.add(x));
        for chunk in x.chunks_exact(size as usize) {
            means.add(chunk.iter().sum::<f64>() / chunk.len() as f64);
        }
        let ours = blocks.blocks();
        prop_assert_eq!(ours.count(), means.count());
        prop_assert!((ours.mean() - means.mean()).abs() < 1e-14);
        prop_assert!(means.count() < 2 || (ours.variance() - means.variance()).abs() < 1e-14);
        prop_assert!(means.count() < 2 || (ours.error() - (means.variance() / means.count() as f64).sqrt()).abs() < 1e-14);
    }

    #[test]
    fn cells_of_an_array_are_statistics_by_themselves(
        samples in prop::collection::vec((0..6usize, -1.0..1.0f64), 0..80),
    ) {
        let mut array = StatisticsArray::new(&[2, 3]).unwrap();
        let mut single = [Statistics::new(); 6];
        for &(cell, x) in &samples {
            array.add(cell, x);
            single[cell].add(x);
        }
        prop_assert_eq!((array.shape(), array.len(), array.is_empty()), (&[2, 3][..], 6, false));
        for (i, statistics) in single.iter().enumerate() {
            prop_assert_eq!(array.cell(array.index(&[i / 3, i % 3]).unwrap()), *statistics);
            prop_assert_eq!((array.counts()[i], array.mean()[i]), (statistics.count(), statistics.mean()));
            prop_assert_eq!((array.variances()[i], array.errors()[i]), (statistics.variance(), statistics.error()));
        }
        let mut twice = array.clone();
        twice.merge(&array).unwrap();
        single[0].merge(&array.cell(0));
        prop_assert_eq!(twice.cell(0), single[0]);
        twice.clear();
        prop_assert!(twice.counts().iter().all(|&n| n == 0));
    }

    #[test]
    fn trees_name_the_boxes_around_a_point(
        boxes in prop::collection::vec((0..20i32, 0..20i32, 0..5i32, 0..5i32), 0..60), x in 0..48i32, y in 0..48i32,
    ) {
        let f = f64::from;
        let items: Vec<KdItem<2>> = boxes.iter().enumerate()
            .map(|(i, &(a, b, w, h))| KdItem::new(i as u32, [f(a), f(b)], [f(a + w), f(b + h)]).unwrap())
            .collect();
        let tree = KdTree2D::new(items.clone()).unwrap();
        // Halves: on edges of boxes and planes of the tree too.
        let at = [0.5 * f(x), 0.5 * f(y)];
        let expected: Vec<u32> = items.iter().filter(|item| item.contains(at)).map(KdItem::id).collect();
        prop_assert_eq!(tree.items_containing(at), expected.clone());
        prop_assert_eq!((tree.len(), tree.is_empty(), tree.is_contained(at, |_| true)), (items.len(), items.is_empty(), !expected.is_empty()));
        prop_assert_eq!(tree.first_containing(at, |id| Some(&id) == expected.last()), expected.last().copied());
        let bounds = tree.bounds();
        prop_assert_eq!(bounds.is_none(), items.is_empty());
        for item in &items {
            prop_assert_eq!(tree.item(item.id()), Some(item));
            let (low, high) = bounds.unwrap();
            prop_assert!((0..2).all(|k| low[k] <= item.lower()[k] && high[k] >= item.upper()[k]));
        }
    }
}
