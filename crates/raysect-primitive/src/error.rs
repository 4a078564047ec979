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
    /// An operand of a composite encloses nothing: a sheet, or a surface that is not closed.
    #[error("{shape}: the {position} operand, a {operand}, encloses nothing")]
    OpenOperand {
        /// The composite.
        shape: &'static str,
        /// "first" or "second".
        position: &'static str,
        /// What the operand is.
        operand: &'static str,
    },
    /// The transform of an operand has no inverse.
    #[error("{shape}: the transform of the {position} operand has no inverse: {source}")]
    OperandTransform {
        /// The composite.
        shape: &'static str,
        /// "first" or "second".
        position: &'static str,
        /// What is wrong with the matrix.
        source: MathError,
    },
}
