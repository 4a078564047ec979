//! Constructive solid geometry: bodies made of two others, nested to any depth.

mod composite;
mod intersect;
mod operand;
mod subtract;
mod union;

#[cfg(test)]
mod tests;

pub use intersect::Intersect;
pub use operand::{Operand, Place};
pub use subtract::Subtract;
pub use union::Union;

/// Answers every question to a shape by the composite in its only field.
macro_rules! answers_by_composite {
    ($shape:ident) => {
        impl raysect_core::Primitive for $shape {
            fn bounding_box(&self, m: &raysect_math::AffineMatrix3D) -> raysect_core::BoundingBox3D {
                self.0.bounding_box(m)
            }
            fn bounding_sphere(&self, m: &raysect_math::AffineMatrix3D) -> raysect_core::BoundingSphere3D {
                self.0.bounding_sphere(m)
            }
            fn contains(&self, point: raysect_math::Point3D) -> bool {
                self.0.contains(point)
            }
            fn crossings(
                &self,
                ray: &raysect_core::Ray,
                scratch: &mut raysect_core::Scratch,
                out: &mut Vec<raysect_core::Crossing>,
            ) {
                self.0.crossings(ray, scratch, out);
            }
            fn hit(
                &self,
                ray: &raysect_core::Ray,
                within: raysect_core::Interval,
                scratch: &mut raysect_core::Scratch,
            ) -> Option<raysect_core::Crossing> {
                self.0.hit(ray, within, scratch)
            }
            fn hit_after(
                &self,
                ray: &raysect_core::Ray,
                departure: &raysect_core::Departure,
                max_distance: f64,
                scratch: &mut raysect_core::Scratch,
            ) -> Option<raysect_core::Crossing> {
                self.0.hit_after(ray, departure, max_distance, scratch)
            }
            fn surface(
                &self,
                ray: &raysect_core::Ray,
                crossing: &raysect_core::Crossing,
            ) -> raysect_core::Surface {
                self.0.surface(ray, crossing)
            }
            fn is_convex(&self) -> bool {
                self.0.is_convex()
            }
            fn parts(&self) -> u32 {
                self.0.parts()
            }
        }

        impl std::fmt::Debug for $shape {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.describe(stringify!($shape), f)
            }
        }
    };
}
pub(crate) use answers_by_composite;
