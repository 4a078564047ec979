use super::super::Value;
use crate::MathError;

/// More knots along one variable than fit into any memory.
const MOST: usize = 1 << 31;

/// The knots along one variable, and how far beyond them an interpolator may go.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    name: &'static str,
    knots: Vec<f64>,
    range: f64,
    /// The first and the last knot.
    domain: (f64, f64),
    /// The knots on both sides of each cell.
    cells: Vec<[f64; 2]>,
    /// For each of as many equal parts of the domain as there are cells, the numbers of inner knots in the parts below it
    /// and in these and itself.
    parts: Vec<[u32; 2]>,
    /// Parts for a unit of length.
    density: f64,
    /// True if the part is as good as always the cell.
    even: bool,
}

impl Axis {
    /// At least two ascending, finite knots; without extrapolation.
    pub(super) fn new(name: &'static str, knots: &[f64]) -> Result<Self, MathError> {
        check_knots(name, knots)?;
        let last = knots.len() - 1;
        // Even knots begin their parts in spite of rounding.
        let density = (1.0 + 1e-9) * last as f64 / (knots[last] - knots[0]);
        let mut axis = Self {
            name,
            knots: knots.to_vec(),
            range: 0.0,
            domain: (knots[0], knots[last]),
            cells: knots.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
            parts: vec![[0; 2]; last],
            density,
            even: false,
        };
        axis.even = axis.cells.iter().enumerate().all(|(cell, &[a, b])| {
            let near = |t: f64| axis.part(a + t * (b - a)) == cell;
            near(1e-3) && near(1.0 - 1e-3)
        });
        for &knot in &knots[1..last] {
            let part = axis.part(knot);
            axis.parts[part][1] += 1;
        }
        for part in 1..last {
            let below = axis.parts[part - 1][1];
            axis.parts[part] = [below, below + axis.parts[part][1]];
        }
        Ok(axis)
    }

    /// Lets places through up to `range` beyond the ends, infinity for any.
    pub(super) fn extend(&mut self, range: f64) -> Result<(), MathError> {
        self.range = MathError::check(range >= 0.0, range, "extrapolation range", "", "0 or more")?;
        Ok(())
    }

    pub(super) fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Where its values end, those beyond the knots included; infinite if they go on for ever.
    pub(super) fn reach(&self) -> (f64, f64) {
        (self.domain.0 - self.range, self.domain.1 + self.range)
    }

    /// Where its pieces meet, and where its values end.
    pub(super) fn borders(&self) -> impl Iterator<Item = f64> {
        let (first, last) = self.reach();
        let beyond = [first, last].into_iter().filter(|x| x.is_finite() && self.range > 0.0);
        self.knots.iter().copied().chain(beyond)
    }

    /// The shortest distance of two knots.
    pub(super) fn shortest_step(&self) -> f64 {
        self.cells.iter().map(|[low, high]| high - low).fold(f64::INFINITY, f64::min)
    }

    #[inline]
    pub(super) fn len(&self) -> usize {
        self.knots.len()
    }

    /// The first and last knot.
    #[inline]
    pub(super) fn domain(&self) -> (f64, f64) {
        self.domain
    }

    /// True between the first and the last knot.
    #[inline]
    pub(super) fn holds(&self, x: f64) -> bool {
        x >= self.domain.0 && x <= self.domain.1
    }

    /// True where the interpolator has a value; false for NaN.
    #[inline]
    pub(super) fn admits(&self, x: f64) -> bool {
        x >= self.domain.0 - self.range && x <= self.domain.1 + self.range
    }

    /// The error for a coordinate that is not admitted.
    pub(super) fn check(&self, x: f64) -> Result<(), MathError> {
        if self.admits(x) {
            return Ok(());
        }
        let (low, high) = self.domain;
        Err(MathError::OutsideGrid {
            axis: self.name,
            value: x,
            low: low - self.range,
            high: high + self.range,
        })
    }

    /// The part of the domain that holds `x`, the end ones for places outside. It never falls where `x` rises, whatever
    /// is rounded.
    #[inline]
    fn part(&self, x: f64) -> usize {
        // To 32 bits takes a third of the instructions that 64 take.
        (((x - self.domain.0) * self.density) as u32 as usize).min(self.parts.len() - 1)
    }

    /// The number of the cell that holds `x`, the end ones for places outside, and the knots at its ends. A knot belongs to
    /// the cell above it, the last one to the last cell.
    ///
    /// Knots in other parts need not be looked at; where the knots are about even there is one to look at.
    #[inline]
    pub(super) fn cell(&self, x: f64) -> (usize, [f64; 2]) {
        self.even_cell(x).unwrap_or_else(|| {
            let cell = self.search(self.part(x), x);
            (cell, self.cells[cell])
        })
    }

    /// The same where the knots are about even and `x` lies above the lower knot of its part and below the upper one, so
    /// that it is not outside. None says nothing.
    #[inline]
    pub(super) fn even_cell(&self, x: f64) -> Option<(usize, [f64; 2])> {
        if !self.even {
            return None;
        }
        let part = self.part(x);
        let ends = self.cells[part];
        (ends[0] <= x && x < ends[1]).then_some((part, ends))
    }

    /// The cell that holds `x`, of those that have to do with a part.
    fn search(&self, part: usize, x: f64) -> usize {
        let [below, end] = self.parts[part].map(|count| count as usize);
        if end - below > 4 {
            return below + self.knots[below + 1..=end].partition_point(|&knot| knot <= x);
        }
        let mut cell = below;
        while cell < end && self.cells[cell][1] <= x {
            cell += 1;
        }
        cell
    }

    /// The knots at the ends of a cell.
    #[inline]
    pub(super) fn ends(&self, cell: usize) -> [f64; 2] {
        self.cells[cell]
    }

    /// The mean width of the cells, whatever their number.
    pub(super) fn mean_width(&self) -> f64 {
        let cells = (self.knots.len() - 1) as f64;
        self.domain.1 / cells - self.domain.0 / cells
    }

    /// Width of a cell.
    #[inline]
    pub(super) fn width(&self, cell: usize) -> f64 {
        let [low, high] = self.cells[cell];
        high - low
    }
}

/// The error that names the first number of a table (in row-major order) that is not finite.
pub(super) fn check_finite(name: &'static str, shape: &[usize], values: &[f64]) -> Result<(), MathError> {
    let Some(first) = values.iter().position(|value| !Value::is_finite(*value)) else { return Ok(()) };
    let mut index = vec![0; shape.len()];
    let mut rest = first;
    for (axis, &count) in shape.iter().enumerate().rev() {
        index[axis] = rest % count;
        rest /= count;
    }
    Err(MathError::TableNotFinite { name, index, value: values[first] })
}

/// At least two ascending, finite knots.
pub(in super::super) fn check_knots(name: &'static str, knots: &[f64]) -> Result<(), MathError> {
    if knots.len() < 2 {
        return Err(MathError::TooFewKnots { axis: name, count: knots.len() });
    }
    MathError::check(knots.len() <= MOST, knots.len() as f64, "number of knots", "", "2 … 2³¹")?;
    check_finite(name, &[knots.len()], knots)?;
    for (i, pair) in knots.windows(2).enumerate() {
        if pair[0] >= pair[1] {
            let (index, previous, value) = (i + 1, pair[0], pair[1]);
            return Err(MathError::KnotsNotAscending { axis: name, index, value, previous });
        }
    }
    Ok(())
}

/// One finite value for each point of a grid.
pub(in super::super) fn check_values(shape: &[usize], values: &[f64]) -> Result<(), MathError> {
    if shape.iter().product::<usize>() != values.len() {
        return Err(MathError::TableSize { shape: shape.to_vec(), count: values.len() });
    }
    check_finite("f", shape, values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// By bisection of all inner knots.
    fn bisected(axis: &Axis, x: f64) -> usize {
        axis.knots[1..axis.len() - 1].partition_point(|&knot| knot <= x)
    }

    /// True if all knots, their neighbours among numbers, places between and far outside are found.
    fn finds(axis: &Axis) -> bool {
        let beside = axis.knots.iter().flat_map(|&x| [x.next_down(), x, x.next_up()]);
        let between = axis.knots.windows(2).map(|pair| 0.5 * pair[0] + 0.5 * pair[1]);
        let outside = [f64::NEG_INFINITY, -f64::MAX, f64::MAX, f64::INFINITY];
        beside.chain(between).chain(outside).all(|x| axis.cell(x).0 == bisected(axis, x))
    }

    #[test]
    fn cells_are_found_on_grids_of_all_kinds() {
        for count in [2, 3, 4, 10, 33, 1000] {
            let shapes: [&dyn Fn(f64) -> f64; 7] = [
                &|i| i,
                &|i| 0.1 * i - 7.3,
                &|i| i * i,
                &|i| 1.5f64.powf(i),
                &|i| i * 1e-310,
                &|i| (i / 1000.0 - 0.5) * f64::MAX,
                &|i| if i < 1.0 { -1e9 } else { 1.0 + i * 1e-12 },
            ];
            for (number, shape) in shapes.into_iter().enumerate() {
                let knots: Vec<f64> = (0..count).map(|i| shape(f64::from(i))).collect();
                assert!(finds(&Axis::new("x", &knots).unwrap()), "{number} {count}");
            }
        }
        let axis = Axis::new("x", &[-f64::MAX, 0.0, 1.0, f64::MAX]).unwrap();
        assert!(finds(&axis));
        // Negative control: one knot counted in the part below.
        let mut axis = Axis::new("x", &[0.0, 1.0, 2.0, 3.0]).unwrap();
        axis.parts[0][1] += 1;
        axis.parts[1][0] += 1;
        assert!(!finds(&axis));
    }

    proptest! {
        #[test]
        fn cells_are_found_on_random_grids(
            steps in prop::collection::vec(-12.0..3.0f64, 1..40), first in -1e3..1e3f64, x in -2e3..2e4f64,
        ) {
            let mut knots = vec![first];
            for step in steps {
                knots.push(knots[knots.len() - 1] + 10f64.powf(step));
            }
            knots.dedup();
            prop_assume!(knots.len() > 1);
            let axis = Axis::new("x", &knots).unwrap();
            prop_assert!(finds(&axis));
            prop_assert_eq!(axis.cell(x).0, bisected(&axis, x));
        }
    }
}
