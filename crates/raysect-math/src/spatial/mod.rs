//! Trees that find boxes in a plane or in space: which contain a point, which lie on the way of a ray.
//!
//! A [`KdTree`] knows the boxes of its items and their numbers, and nothing else of them. Its user asks it for the few
//! items worth a look and tests those; whatever has a box can be kept in one.
//!
//! ```
//! use raysect_math::spatial::{KdItem, KdTree3D};
//! use raysect_math::{MathError, Point3D, Vector3D};
//!
//! /// Balls of one radius, found by a tree.
//! struct Balls {
//!     centres: Vec<Point3D>,
//!     radius: f64,
//!     tree: KdTree3D,
//! }
//!
//! impl Balls {
//!     fn new(centres: Vec<Point3D>, radius: f64) -> Result<Self, MathError> {
//!         let r = Vector3D::new(radius, radius, radius);
//!         let items = centres.iter().enumerate().map(|(i, &c)| KdItem::new(i as u32, c - r, c + r));
//!         let tree = KdTree3D::new(items.collect::<Result<Vec<_>, _>>()?)?;
//!         Ok(Self { centres, radius, tree })
//!     }
//!
//!     fn contains(&self, point: Point3D) -> bool {
//!         self.tree.is_contained(point, |i| self.centres[i as usize].distance_to(point) <= self.radius)
//!     }
//!
//!     /// The first ball on the way of a ray, and its distance.
//!     fn hit(&self, origin: Point3D, direction: Vector3D) -> Option<(u32, f64)> {
//!         let mut nearest = None;
//!         self.tree.trace(origin, direction, f64::INFINITY, |ids, mut limit| {
//!             for &i in ids {
//!                 if let Some(t) = self.distance(i, origin, direction).filter(|&t| t <= limit) {
//!                     (nearest, limit) = (Some((i, t)), t);
//!                 }
//!             }
//!             limit
//!         });
//!         nearest
//!     }
//!
//!     fn distance(&self, i: u32, origin: Point3D, direction: Vector3D) -> Option<f64> {
//!         let to_centre = origin.vector_to(self.centres[i as usize]);
//!         let along = to_centre.dot(direction);
//!         let inside = self.radius.powi(2) - (to_centre - along * direction).length_squared();
//!         (inside >= 0.0).then(|| along - inside.sqrt()).filter(|&t| t >= 0.0)
//!     }
//! }
//!
//! let balls = Balls::new((0..1000).map(|i| Point3D::new(0.0, 0.0, 3.0 * f64::from(i))).collect(), 1.0)?;
//! assert!(balls.contains(Point3D::new(0.5, 0.5, 300.0)));
//! assert!(!balls.contains(Point3D::new(0.0, 0.0, 301.5)));
//! assert_eq!(balls.hit(Point3D::new(0.0, 0.0, 301.5), Vector3D::Z), Some((101, 0.5)));
//! # Ok::<(), MathError>(())
//! ```

mod build;
mod item;
mod kdtree;
mod settings;
mod stream;
mod trace;

pub use item::KdItem;
pub use kdtree::{KdTree, KdTree2D, KdTree3D};
pub use settings::KdTreeSettings;
