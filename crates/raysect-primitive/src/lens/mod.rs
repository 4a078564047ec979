//! Spherical lenses: the axis is z, the vertex of the back surface lies at the origin, the body extends to the front
//! towards positive z.

mod bi_concave;
mod bi_convex;
mod body;
mod cap;
mod face;
mod line;
mod measures;
mod meniscus;
mod plano_concave;
mod plano_convex;

#[cfg(test)]
mod tests;

pub use bi_concave::BiConcave;
pub use bi_convex::BiConvex;
pub use face::LensFace;
pub use meniscus::Meniscus;
pub use plano_concave::PlanoConcave;
pub use plano_convex::PlanoConvex;
