//! Simple closed meshes.

use std::collections::HashMap;

use raysect_math::MathError;

use super::{MeshData, MeshError};

/// Ratio of the sides of a golden rectangle: twelve corners of three of them make an icosahedron.
const GOLDEN: f64 = 1.618_033_988_749_895;

/// Finest icosphere: 1.3 thousand million triangles fit into memory no more.
const FINEST: u32 = 12;

fn check_length(what: &'static str, length: f64) -> Result<(), MeshError> {
    let admitted = length > 0.0 && length.is_finite();
    MathError::check(admitted, length, what, "m", "greater than 0 and finite")?;
    Ok(())
}

impl MeshData {
    /// A cube about the origin, of half the length of an edge [m].
    ///
    /// # Errors
    /// [`MeshError::Transform`] unless the length is positive and finite.
    pub fn cube(half: f64) -> Result<Self, MeshError> {
        check_length("half-size", half)?;
        let corner = |i: u32| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { half } else { -half });
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Self::new((0..8).map(corner), triangles)
    }

    /// An icosahedron whose faces are split in four as often as is said, 0 … 12 times, with all corners on a sphere
    /// about the origin [m]: 20 · 4ⁿ triangles.
    ///
    /// # Errors
    /// [`MeshError::Transform`] unless the radius is positive and finite, and for too many splits.
    pub fn icosphere(splits: u32, radius: f64) -> Result<Self, MeshError> {
        check_length("radius", radius)?;
        MathError::check(splits <= FINEST, f64::from(splits), "number of splits", "", "0 … 12")?;
        let (mut points, mut triangles) = icosahedron();
        for _ in 0..splits {
            triangles = split(&mut points, &triangles);
        }
        let on_sphere = points.iter().map(|p| {
            let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            p.map(|x| x / length * radius)
        });
        Self::new(on_sphere, triangles)
    }
}

fn icosahedron() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let signs = [(-1.0, GOLDEN), (1.0, GOLDEN), (-1.0, -GOLDEN), (1.0, -GOLDEN)];
    let points = (0..3).flat_map(|turn| {
        signs.map(|(a, b)| {
            let mut p = [a, b, 0.0];
            p.rotate_right(turn);
            p
        })
    });
    let triangles = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (points.collect(), triangles)
}

/// Every triangle in four, with new points in the middle of the edges.
fn split(points: &mut Vec<[f64; 3]>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let (p, q) = (points[a as usize], points[b as usize]);
            points.push([0, 1, 2].map(|i| 0.5 * (p[i] + q[i])));
            points.len() as u32 - 1
        })
    };
    triangles
        .iter()
        .flat_map(|&[a, b, c]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_sound_and_of_the_right_size() {
        let cube = MeshData::cube(0.5).unwrap().health();
        assert!(cube.is_solid() && cube.is_manifold());
        assert!((cube.volume().unwrap() - 1.0).abs() < 1e-15 && (cube.surface_area - 6.0).abs() < 1e-14);
        for splits in 0..5 {
            let sphere = MeshData::icosphere(splits, 2.0).unwrap();
            assert_eq!(sphere.triangle_count(), 20 << (2 * splits));
            let health = sphere.health();
            assert!(health.is_solid() && health.is_manifold());
            let missing = 1.0 - health.volume().unwrap() / (32.0 / 3.0 * std::f64::consts::PI);
            let expected = 0.5 / f64::from(1 << (2 * splits));
            assert!(missing > 0.6 * expected && missing < 1.2 * expected, "{splits}: {missing}");
        }
    }

    #[test]
    fn impossible_ones_are_refused() {
        assert!(MeshData::cube(0.0).is_err() && MeshData::cube(f64::NAN).is_err());
        assert!(MeshData::icosphere(13, 1.0).is_err() && MeshData::icosphere(1, f64::INFINITY).is_err());
    }
}
