use thiserror::Error;

/// What can be wrong with an argument of this crate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MathError {
    /// A vector of zero length, or with components that are not finite, has no direction.
    #[error("({x}, {y}, {z}) has no direction: its length must be positive and finite")]
    NoDirection {
        /// Component along x.
        x: f64,
        /// Component along y.
        y: f64,
        /// Component along z.
        z: f64,
    },
    /// Two directions that must span a plane are parallel.
    #[error("the directions are parallel (angle {angle} deg): they must span a plane")]
    Parallel {
        /// Angle between them [deg].
        angle: f64,
    },
    /// The matrix has no inverse.
    #[error("the matrix is singular: one of its axes vanishes or lies in the plane of the others")]
    Singular,
    /// A matrix element is not a finite number.
    #[error("matrix element [{row}, {column}] = {value} is not finite")]
    NotFinite {
        /// Row, counted from 0.
        row: usize,
        /// Column, counted from 0.
        column: usize,
        /// The offending value.
        value: f64,
    },
    /// The bottom row of an affine matrix must be (0, 0, 0, 1).
    #[error("the bottom row is ({}, {}, {}, {}): an affine matrix has (0, 0, 0, 1)", row[0], row[1], row[2], row[3])]
    NotAffine {
        /// The bottom row that was given.
        row: [f64; 4],
    },
    /// Arrays of different shapes cannot be merged cell by cell.
    #[error("the arrays have the shapes {left:?} and {right:?} [cells]: they must be equal")]
    ShapeMismatch {
        /// Shape of the array that was to receive the other.
        left: Vec<usize>,
        /// Shape of the other array.
        right: Vec<usize>,
    },
    /// Two items of a tree have the same number.
    #[error("two items have the id {id}: each needs its own")]
    DuplicateItem {
        /// The number.
        id: u32,
    },
    /// The bytes of a stored tree are not those of a tree.
    #[error("byte {offset} of the kd-tree: {reason}")]
    KdTreeFormat {
        /// Where the wrong field begins, in bytes from the beginning of the tree.
        offset: u64,
        /// What is wrong there.
        reason: String,
    },
    /// A stream ends early or cannot be read.
    #[error("reading failed at byte {offset} of the kd-tree: {kind}")]
    KdTreeStream {
        /// Where the field that cannot be read begins, in bytes from the beginning of the tree.
        offset: u64,
        /// What the stream says; `UnexpectedEof` if it ends.
        kind: std::io::ErrorKind,
    },
    /// A root can only be found between places where the signs of a function differ.
    #[error("f({low}) = {at_low} and f({high}) = {at_high} do not enclose a root: their signs must differ")]
    NoSignChange {
        /// The lower place.
        low: f64,
        /// The value there.
        at_low: f64,
        /// The upper place.
        high: f64,
        /// The value there.
        at_high: f64,
    },
    /// A parameter lies outside its range.
    #[error("{name} = {value}{}{unit} is outside its range {range}", if unit.is_empty() { "" } else { " " })]
    OutOfRange {
        /// Name of the parameter.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// Its unit, empty for a pure number.
        unit: &'static str,
        /// The admitted range.
        range: &'static str,
    },
}

impl MathError {
    /// `Ok(value)` if `admitted`, otherwise the error that names the parameter, its unit and its range.
    pub fn check(
        admitted: bool,
        value: f64,
        name: &'static str,
        unit: &'static str,
        range: &'static str,
    ) -> Result<f64, Self> {
        if admitted { Ok(value) } else { Err(Self::OutOfRange { name, value, unit, range }) }
    }
}
