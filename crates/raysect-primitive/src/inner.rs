//! Shapes that are another one under a name of their own.

/// Answers every question to a shape by what is in its only field.
macro_rules! answers_by_inner {
    ($shape:ident $(, $saved:ident)?) => {
        impl raysect_core::Primitive for $shape {
            fn bounding_box(&self, m: &raysect_math::AffineMatrix3D) -> raysect_core::BoundingBox3D {
                raysect_core::Primitive::bounding_box(&self.0, m)
            }
            fn bounding_sphere(&self, m: &raysect_math::AffineMatrix3D) -> raysect_core::BoundingSphere3D {
                raysect_core::Primitive::bounding_sphere(&self.0, m)
            }
            fn contains(&self, point: raysect_math::Point3D) -> bool {
                raysect_core::Primitive::contains(&self.0, point)
            }
            fn crossings(
                &self,
                ray: &raysect_core::Ray,
                scratch: &mut raysect_core::Scratch,
                out: &mut Vec<raysect_core::Crossing>,
            ) {
                raysect_core::Primitive::crossings(&self.0, ray, scratch, out);
            }
            fn crossings_within(
                &self,
                ray: &raysect_core::Ray,
                within: raysect_core::Interval,
                scratch: &mut raysect_core::Scratch,
                out: &mut Vec<raysect_core::Crossing>,
            ) {
                raysect_core::Primitive::crossings_within(&self.0, ray, within, scratch, out);
            }
            fn hit(
                &self,
                ray: &raysect_core::Ray,
                within: raysect_core::Interval,
                scratch: &mut raysect_core::Scratch,
            ) -> Option<raysect_core::Crossing> {
                raysect_core::Primitive::hit(&self.0, ray, within, scratch)
            }
            fn hit_after(
                &self,
                ray: &raysect_core::Ray,
                departure: &raysect_core::Departure,
                max_distance: f64,
                scratch: &mut raysect_core::Scratch,
            ) -> Option<raysect_core::Crossing> {
                raysect_core::Primitive::hit_after(&self.0, ray, departure, max_distance, scratch)
            }
            fn surface(
                &self,
                ray: &raysect_core::Ray,
                crossing: &raysect_core::Crossing,
            ) -> raysect_core::Surface {
                raysect_core::Primitive::surface(&self.0, ray, crossing)
            }
            fn is_convex(&self) -> bool {
                raysect_core::Primitive::is_convex(&self.0)
            }
            $(fn save(
                &self,
                writer: &mut raysect_core::save::SceneWriter,
            ) -> Result<raysect_core::save::Saved, raysect_core::save::SaveError> {
                self.$saved(writer)
            })?
            fn parts(&self) -> u32 {
                raysect_core::Primitive::parts(&self.0)
            }
        }
    };
}
pub(crate) use answers_by_inner;
