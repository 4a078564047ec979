use earcut::Earcut;
use raysect_math::Point3D;

/// Cuts polygons into triangles; keeps its room from one to the next.
#[derive(Default)]
pub(super) struct Triangulator {
    ears: Earcut<f64>,
    cut: Vec<u32>,
}

impl std::fmt::Debug for Triangulator {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Triangulator").finish_non_exhaustive()
    }
}

/// The most corners of a polygon that is not convex: the effort can grow with their square.
const MOST_CORNERS: usize = 20_000;

impl Triangulator {
    /// The corners of the triangles of a polygon, in its own sense: always two fewer than the polygon has corners.
    ///
    /// Convex polygons are cut from their first corner, others by their ears in the plane of the axes that the polygon
    /// leans on least. Where that leaves corners out, as where the outline crosses itself, all triangles come from the
    /// first corner: the edges of the outline stay edges, and neighbours stay joined.
    pub(super) fn cut(&mut self, corners: &[Point3D]) -> Result<&[u32], String> {
        let count = corners.len();
        self.cut.clear();
        if count > 3
            && let Some(outline) = flatten(corners).filter(|outline| !is_convex(outline))
        {
            if count > MOST_CORNERS {
                return Err(format!(
                    "a face of {count} corners that is not convex: {MOST_CORNERS} can be read"
                ));
            }
            self.cut_ears(&outline);
        }
        if self.cut.len() != 3 * count.saturating_sub(2) {
            self.cut.clear();
            self.cut.extend((2..count as u32).flat_map(|k| [0, k - 1, k]));
        }
        Ok(&self.cut)
    }

    fn cut_ears(&mut self, outline: &[[f64; 2]]) {
        let holes: [u32; 0] = [];
        self.ears.earcut(outline.iter().copied(), &holes, &mut self.cut);
        let (triangles, _) = self.cut.as_chunks_mut::<3>();
        for t in triangles {
            let [a, b, c] = t.map(|k| outline[k as usize]);
            if turn(a, b, c) < 0.0 {
                t.swap(1, 2);
            }
        }
    }
}

/// True if an anticlockwise outline turns left at every corner, and once round in all: it goes forth and back along
/// an axis once.
fn is_convex(outline: &[[f64; 2]]) -> bool {
    let corner = |k: usize| outline[k % outline.len()];
    let is_forth = |k: usize| corner(k + 1) > corner(k);
    let all = 0..outline.len();
    let turnings = all.clone().filter(|&k| is_forth(k) != is_forth(k + 1)).count();
    turnings == 2 && all.into_iter().all(|k| turn(corner(k), corner(k + 1), corner(k + 2)) > 0.0)
}

/// A polygon in a plane, anticlockwise and at most of size 2; `None` if it has no area to speak of.
fn flatten(corners: &[Point3D]) -> Option<Vec<[f64; 2]>> {
    let half = |p: Point3D| p.to_vector() * 0.5 - corners[0].to_vector() * 0.5;
    let size = corners.iter().map(|&p| half(p).max_abs()).fold(0.0, f64::max);
    if size == 0.0 {
        return None;
    }
    let local: Vec<_> = corners.iter().map(|&p| half(p) / size).collect();
    // The vector area (M. Newell; I. Sutherland, R. Sproull, R. Schumacker, A Characterization of Ten Hidden-Surface
    // Algorithms, 1974): its largest component tells the plane in which the polygon is seen most widely.
    let next = local.iter().cycle().skip(1);
    let area = local.iter().zip(next).map(|(a, b)| a.cross(*b)).reduce(|sum, n| sum + n)?;
    let (u, v, component) = match [area.x.abs(), area.y.abs(), area.z.abs()] {
        [x, y, z] if x >= y && x >= z => (1, 2, area.x),
        [_, y, z] if y >= z => (2, 0, area.y),
        _ => (0, 1, area.z),
    };
    if component == 0.0 {
        return None;
    }
    let sense = component.signum();
    Some(local.iter().map(|p| [p[u], sense * p[v]]).collect())
}

/// Twice the signed area of a triangle.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshData;
    use raysect_math::rotate;

    /// Area of the triangles, those wound the other way than the polygon counted negative.
    fn signed_area(corners: &[Point3D], cut: &[u32], normal: [f64; 3]) -> f64 {
        let (triangles, _) = cut.as_chunks::<3>();
        let mesh = MeshData::new(corners.to_vec(), triangles.iter().copied()).unwrap();
        let sense = |t| mesh.face_normal(t).map_or(0.0, |n| n.dot(raysect_math::Normal3D::from(normal)));
        (0..mesh.triangle_count()).map(|t| mesh.triangle_area(t) * sense(t).signum()).sum()
    }

    fn absolute_area(corners: &[Point3D], cut: &[u32]) -> f64 {
        let (triangles, _) = cut.as_chunks::<3>();
        let mesh = MeshData::new(corners.to_vec(), triangles.iter().copied()).unwrap();
        (0..mesh.triangle_count()).map(|t| mesh.triangle_area(t)).sum()
    }

    fn star(points: usize, inner: f64) -> (Vec<Point3D>, f64) {
        let radius = |k: usize| if k.is_multiple_of(2) { 1.0 } else { inner };
        let angle = std::f64::consts::PI / points as f64;
        let corner = |k: usize| {
            let (s, c) = (k as f64 * angle).sin_cos();
            Point3D::new(radius(k) * c, radius(k) * s, 0.0)
        };
        let area = points as f64 * inner * angle.sin();
        ((0..2 * points).map(corner).collect(), area)
    }

    #[test]
    fn concave_polygons_are_covered_once_in_every_plane() {
        let mut cutter = Triangulator::default();
        for (points, inner) in [(3, 0.2), (5, 0.3), (60, 0.9)] {
            let (flat, area) = star(points, inner);
            for turned in
                [(0.0, 0.0, 0.0), (90.0, 0.0, 0.0), (0.0, 90.0, 0.0), (30.0, 50.0, 70.0), (0.0, 180.0, 0.0)]
            {
                let m = rotate(turned.0, turned.1, turned.2);
                // Each corner may come first, and the star may be tiny, huge or far away.
                for (first, scale) in [(0, 1.0), (1, 1e-170), (2, 1e170)] {
                    let mut corners: Vec<Point3D> = flat
                        .iter()
                        .map(|&p| m * p)
                        .map(|p| Point3D::new(p.x * scale, p.y * scale, p.z * scale))
                        .collect();
                    corners.rotate_left(first);
                    let cut = cutter.cut(&corners).unwrap().to_vec();
                    assert_eq!(cut.len(), 3 * (2 * points - 2));
                    let unit: Vec<Point3D> =
                        corners.iter().map(|p| Point3D::new(p.x / scale, p.y / scale, p.z / scale)).collect();
                    let normal = (m * raysect_math::Vector3D::Z).to_array();
                    let signed = signed_area(&unit, &cut, normal);
                    assert!(
                        (signed - area).abs() < 1e-12 && (absolute_area(&unit, &cut) - area).abs() < 1e-12
                    );
                }
            }
        }
        // The fan from a tip, which covers more than the star.
        let (flat, area) = star(5, 0.3);
        let fan: Vec<u32> = (2..10).flat_map(|k| [0, k - 1, k]).collect();
        assert!(absolute_area(&flat, &fan) > 1.1 * area);
    }

    #[test]
    fn corners_on_a_straight_edge_stay() {
        let mut cutter = Triangulator::default();
        let corners = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
        let corners = corners.map(|[x, y]| Point3D::new(x, y, 3.0));
        let cut = cutter.cut(&corners).unwrap().to_vec();
        assert_eq!(cut.len(), 12);
        assert!((signed_area(&corners, &cut, [0.0, 0.0, 1.0]) - 4.0).abs() < 1e-15);
        assert!((0..6).all(|k| cut.contains(&k)));
    }

    #[test]
    fn hopeless_polygons_keep_their_outline() {
        let mut cutter = Triangulator::default();
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| Point3D::new(x, y, 0.0));
        assert_eq!(cutter.cut(&bow).unwrap().len(), 6);
        let line: Vec<Point3D> = (0..5).map(|k| Point3D::new(f64::from(k), 0.0, 0.0)).collect();
        assert_eq!(cutter.cut(&line).unwrap(), [0, 1, 2, 0, 2, 3, 0, 3, 4]);
        assert_eq!(cutter.cut(&[Point3D::ORIGIN; 4]).unwrap().len(), 6);
        assert!(cutter.cut(&line[..2]).unwrap().is_empty());
    }

    #[test]
    fn convex_polygons_are_cut_from_their_first_corner_however_many_they_have() {
        let mut cutter = Triangulator::default();
        for count in [4, 5, 12, 100_000] {
            let round = |k: usize| (k as f64 / count as f64 * std::f64::consts::TAU).sin_cos();
            let circle: Vec<Point3D> =
                (0..count).map(|k| Point3D::new(3.0, round(k).1, round(k).0)).collect();
            let fan: Vec<u32> = (2..count as u32).flat_map(|k| [0, k - 1, k]).collect();
            assert!(cutter.cut(&circle).unwrap() == fan.as_slice(), "{count}");
        }
        // A pentagram turns left everywhere, but twice round.
        let tip = |k: i32| (f64::from(k) * 144.0).to_radians().sin_cos();
        let pentagram: Vec<[f64; 2]> = (0..5).map(|k| [tip(k).1, tip(k).0]).collect();
        assert!(!is_convex(&pentagram));
        // Too many corners for the effort of a concave polygon.
        let (flat, _) = star(10_001, 0.5);
        assert!(cutter.cut(&flat).unwrap_err().contains("20002 corners"));
        assert!(cutter.cut(&star(10_000, 0.5).0).is_ok());
    }
}
