use raysect_math::MathError;
use thiserror::Error;

use crate::NodeId;

/// What can go wrong with a scene and its rays.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CoreError {
    /// An argument of a mathematical function is wrong.
    #[error(transparent)]
    Math(#[from] MathError),
    /// A bounding box whose lower corner lies above its upper one.
    #[error("the box is inverted along axis {axis}: lower {lower} m lies above upper {upper} m")]
    InvertedBox {
        /// 0 (x), 1 (y) or 2 (z).
        axis: usize,
        /// Lower bound [m].
        lower: f64,
        /// Upper bound [m].
        upper: f64,
    },
    /// A node id of another world, or of a node that has been removed.
    #[error("{0} is not a node of this world")]
    UnknownNode(NodeId),
    /// A node may not hang under itself.
    #[error("{node} cannot hang under {parent}, which is the node itself or lies below it")]
    Cycle {
        /// The node to be moved.
        node: NodeId,
        /// The wanted parent.
        parent: NodeId,
    },
    /// The root of a world stays where it is.
    #[error("the root of a world can neither be moved nor removed")]
    Root,
    /// Two nodes that are not connected have no common frame.
    #[error("{0} and {1} belong to different trees: one of them is detached")]
    Unconnected(NodeId, NodeId),
    /// The transform of a node has no inverse.
    #[error("the transform of '{name}' has no inverse: {source}")]
    Transform {
        /// Name of the node.
        name: String,
        /// What is wrong with the matrix.
        source: MathError,
    },
    /// What is attached to the primitives cannot be compiled.
    #[error("the scene cannot be compiled: {0}")]
    Compile(Box<dyn std::error::Error + Send + Sync>),
    /// A ray that leads nowhere.
    #[error("a ray needs a finite origin and a finite, non-zero direction: {0}")]
    Ray(String),
}

/// How a run of an engine can end early.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EngineError {
    /// The work on an item panicked; items that were finished before have been delivered.
    #[error("work item {item} panicked: {message}")]
    Panicked {
        /// Number of the item.
        item: usize,
        /// The panic's message.
        message: String,
    },
    /// The threads could not be started.
    #[error("the worker threads could not be started: {0}")]
    Threads(String),
    /// A number of threads that makes no sense.
    #[error("{0} threads were asked for: at least one is needed")]
    NoThreads(usize),
}
