use rayon::prelude::*;

use super::{Scene, SurfacePoint};
use crate::{Attachment, Ray, Scratch};

/// Fewer rays than this are not worth a thread.
const PIECE: usize = 256;

impl<A: Attachment> Scene<A> {
    /// The surfaces at the nearest hits of many rays, in the order of the rays. All processors share the work, which pays
    /// where a hit costs more than the memory of its surface: with meshes, composites or many shapes.
    ///
    /// ```
    /// use raysect_core::{Ray, World};
    /// use raysect_math::{Point3D, Vector3D};
    /// let world: World<()> = World::new();
    /// let rays = [Ray::new(Point3D::ORIGIN, Vector3D::Z), Ray::new(Point3D::ORIGIN, Vector3D::X)];
    /// assert_eq!(world.scene()?.hit_all(&rays), [None, None]);
    /// # Ok::<(), raysect_core::CoreError>(())
    /// ```
    pub fn hit_all(&self, rays: &[Ray]) -> Vec<Option<SurfacePoint>> {
        let hit = |scratch: &mut Scratch, ray: &Ray| {
            let hit = self.hit(ray, None, scratch)?;
            Some(self.finish(ray, &hit))
        };
        rays.par_iter().with_min_len(PIECE).map_init(Scratch::default, hit).collect()
    }
}

#[cfg(test)]
mod tests {
    use raysect_math::{Rng, SphereSampler, Vector3D, translate};

    use crate::testing::Ball;
    use crate::{Node, Ray, World};

    #[test]
    fn many_rays_hit_what_each_of_them_hits() {
        let mut world: World<()> = World::new();
        for [x, y, z] in [[0.0, 0.0, 0.0], [1.5, 0.2, -0.4], [-0.7, 1.1, 0.9]] {
            world.add(Node::of(Ball::new(1.0), ()).transform(translate(x, y, z))).unwrap();
        }
        let mut rng = Rng::new(31);
        let mut draw = || SphereSampler.sample(&mut rng);
        let rays: Vec<Ray> = (0..5000).map(|_| Ray::new((draw() * 2.0).to_array().into(), draw())).collect();
        let all = world.hit_all(&rays).unwrap();
        let each = rays.iter().map(|ray| world.hit(ray).unwrap().map(|hit| hit.surface));
        assert!(all.iter().copied().eq(each));
        let hits = all.iter().flatten().count();
        assert!((400..4500).contains(&hits), "{hits}");
        let lost = Ray::new(rays[0].origin, Vector3D::ZERO);
        assert!(world.hit_all(&[rays[0], lost]).is_err());
    }
}
