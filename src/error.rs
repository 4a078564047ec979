use thiserror::Error;

/// Everything that can go wrong, whichever crate it comes from.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument of a mathematical function.
    #[error(transparent)]
    Math(#[from] crate::math::MathError),
    /// The scene.
    #[error(transparent)]
    Core(#[from] crate::core::CoreError),
    /// An engine.
    #[error(transparent)]
    Engine(#[from] crate::core::EngineError),
    /// A shape.
    #[error(transparent)]
    Primitive(#[from] crate::primitive::PrimitiveError),
    /// A mesh or its file.
    #[error(transparent)]
    Mesh(#[from] crate::primitive::MeshError),
    /// A spectrum or a material.
    #[error(transparent)]
    Optical(#[from] crate::optical::OpticalError),
    /// An observation.
    #[error(transparent)]
    Observer(#[from] crate::observer::ObserverError),
    /// A scene that cannot be saved, or a file that is none.
    #[error(transparent)]
    Save(#[from] crate::core::save::SaveError),
    /// A file.
    #[error(transparent)]
    File(#[from] crate::observer::file::FileError),
    /// Anything else that a program of the user's wants to report in the same way.
    #[error(transparent)]
    Io(#[from] std::io::Error),
}

/// The result of anything that can go wrong.
pub type Result<T, E = Error> = std::result::Result<T, E>;
