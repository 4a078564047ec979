use raysect_math::MathError;
use thiserror::Error;

use crate::mesh::MeshError;

/// Why a shape cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PrimitiveError {
    /// A dimension lies outside its range.
    #[error("{shape}: {source}")]
    Dimension {
        /// The shape.
        shape: &'static str,
        /// Which dimension, and its range.
        source: MathError,
    },
    /// The corners of a cuboid are swapped, not finite, or leave no surface.
    #[error("cuboid from ({}, {}, {}) m to ({}, {}, {}) m: {what}", lower[0], lower[1], lower[2], upper[0], upper[1], upper[2])]
    Corners {
        /// The lower corner that was given [m].
        lower: [f64; 3],
        /// The upper corner that was given [m].
        upper: [f64; 3],
        /// What is wrong.
        what: &'static str,
    },
    /// A mesh or its file is wrong.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
