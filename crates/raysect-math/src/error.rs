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
    /// A quaternion of zero length, or with components that are not finite, is no rotation and has no inverse.
    #[error("the quaternion ({x}, {y}, {z}, {s}) is no rotation: its length must be positive and finite")]
    NullQuaternion {
        /// Component along i.
        x: f64,
        /// Component along j.
        y: f64,
        /// Component along k.
        z: f64,
        /// Scalar part.
        s: f64,
    },
    /// The matrix does more than rotate and translate.
    #[error(
        "the matrix is no rotation: its axes deviate from right angles and unit length by {deviation} (at most 1e-8), \
         its determinant is {determinant} (positive)"
    )]
    NotRotation {
        /// The largest difference of the products of its axes from those of unit vectors at right angles.
        deviation: f64,
        /// Determinant of the 3×3 part.
        determinant: f64,
    },
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
    /// A polygon cannot have such a vertex.
    #[error("vertex {vertex} = ({x}, {y}) of the polygon: {reason}")]
    PolygonVertex {
        /// Number of the vertex, counted from 0.
        vertex: usize,
        /// Its coordinate along x [m]; NaN if there is no vertex.
        x: f64,
        /// Its coordinate along y [m]; NaN if there is no vertex.
        y: f64,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The outline of a polygon crosses or touches itself.
    #[error("the edges that leave the vertices {first} and {second} of the polygon cross or touch")]
    PolygonCrossing {
        /// Number of the vertex that the one edge leaves.
        first: usize,
        /// Number of the vertex that the other edge leaves.
        second: usize,
    },
    /// The triangles of a polygon do not fill it.
    #[error("the triangles of the polygon cover {covered} m² of {area} m²")]
    PolygonNotCut {
        /// Area of the triangles [m²].
        covered: f64,
        /// Area of the polygon [m²].
        area: f64,
    },
    /// A vertex, element or value of a mesh is not possible.
    #[error("{kind} {index} of the mesh: {reason}")]
    MeshPart {
        /// What it is: a vertex, a triangle, a tetrahedron or a value.
        kind: &'static str,
        /// Its number, counted from 0.
        index: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// There must be one value for each vertex or element.
    #[error("{given} values for {needed} {of}: there must be as many")]
    ValueCount {
        /// Number of values.
        given: usize,
        /// Number of vertices or elements.
        needed: usize,
        /// What the values belong to.
        of: &'static str,
    },
    /// A function that is limited to a mesh has no value outside.
    #[error("{at:?} m lies outside of the mesh, and the function is limited to it")]
    OutsideMesh {
        /// Coordinates of the point [m].
        at: Vec<f64>,
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
    /// A function has no finite value where one is needed.
    #[error("f({}) = {} is not finite", list(at), list(value))]
    Undefined {
        /// The coordinates of the place.
        at: Vec<f64>,
        /// The value there, or the components of the vector.
        value: Vec<f64>,
    },
    /// An axis of a table needs a knot at each end.
    #[error("the axis {axis} has {count} knots: it needs 2 or more")]
    TooFewKnots {
        /// Name of the axis.
        axis: &'static str,
        /// The number of knots that were given.
        count: usize,
    },
    /// The knots along an axis must ascend, without two that are equal.
    #[error("{axis}[{index}] = {value} follows {previous}: knots must ascend")]
    KnotsNotAscending {
        /// Name of the axis.
        axis: &'static str,
        /// Index of the offending knot, counted from 0.
        index: usize,
        /// The offending knot.
        value: f64,
        /// The knot before it.
        previous: f64,
    },
    /// A number of a table is infinite or NaN.
    #[error("{name}{index:?} = {value} is not finite")]
    TableNotFinite {
        /// Name of the axis, or `f` for the values.
        name: &'static str,
        /// Indices along the axes, counted from 0.
        index: Vec<usize>,
        /// The offending number.
        value: f64,
    },
    /// A table needs one value for each point of its grid.
    #[error("there are {count} values for a grid of {shape:?} [knots]: it needs {}", shape.iter().product::<usize>())]
    TableSize {
        /// The numbers of knots along the axes.
        shape: Vec<usize>,
        /// The number of values that were given.
        count: usize,
    },
    /// A place lies farther from the grid of an interpolator than it may extrapolate.
    #[error("{axis} = {value} is outside the range {low} … {high} of the interpolator")]
    OutsideGrid {
        /// Name of the axis.
        axis: &'static str,
        /// The coordinate that was asked for.
        value: f64,
        /// The lowest coordinate that is allowed.
        low: f64,
        /// The highest coordinate that is allowed.
        high: f64,
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

/// Numbers with commas between them.
fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
}
