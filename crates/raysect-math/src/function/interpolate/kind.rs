/// How an interpolator of one variable passes between its knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Interpolation1D {
    /// Straight from knot to knot.
    Linear,
    /// Cubic pieces with a continuous slope. The slope of a knot is that of the parabola through it and its neighbours,
    /// at the ends that of the line to the neighbour; quadratics come back exactly but for the two end pieces.
    Cubic,
    /// Cubic pieces with a continuous slope that rise and fall only where the values do: no overshoot, so that a density
    /// stays positive (F. N. Fritsch and J. Butland, *A method for constructing local monotone piecewise cubic
    /// interpolants*, SIAM J. Sci. Stat. Comput. 5, 1984). Less exact at maxima.
    #[doc(alias = "pchip")]
    Monotone,
}

/// How an interpolator of one variable goes on beyond its knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Extrapolation1D {
    /// With the value of the end.
    Nearest,
    /// Along the line through the last two knots.
    Linear,
    /// From the value and slope of the end, with the curvature by which the slopes of the last two knots differ.
    /// Beyond a linear interpolator that is the straight line.
    Quadratic,
}

/// How an interpolator of two or three variables passes between its knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// Linear in each variable.
    Linear,
    /// Cubic in each variable, with continuous slopes: see [`Interpolator2DArray`](super::Interpolator2DArray).
    Cubic,
}

/// How an interpolator of two or three variables goes on beyond its knots, in each variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Extrapolation {
    /// With the value of the edge.
    Nearest,
    /// With the slope at the edge, linear in each variable that lies outside.
    Linear,
}
