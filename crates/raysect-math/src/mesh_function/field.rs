use std::sync::Arc;

use crate::MathError;
use crate::function::Place;

/// The values on a mesh, and what holds outside of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    values: Arc<[f64]>,
    /// Without one, there is no value outside.
    pub(super) default: Option<f64>,
}

impl Field {
    /// As many finite values as there are vertices or elements.
    pub(super) fn new(values: Vec<f64>, needed: usize, of: &'static str) -> Result<Self, MathError> {
        if values.len() != needed {
            return Err(MathError::ValueCount { given: values.len(), needed, of });
        }
        if let Some(index) = values.iter().position(|v| !v.is_finite()) {
            let reason = format!("{} is not finite", values[index]);
            return Err(MathError::MeshPart { kind: "value", index, reason });
        }
        Ok(Self { values: values.into(), default: None })
    }

    #[inline]
    pub(super) fn value(&self, index: u32) -> f64 {
        self.values[index as usize]
    }

    /// What holds at a point that no element contains. There is nothing at NaN.
    #[cold]
    pub(super) fn outside(&self, at: &[f64]) -> Option<f64> {
        self.default.filter(|_| !at.iter().any(|x| x.is_nan()))
    }
}

/// The value at a point, or the error that there is none.
pub(super) fn found<P: Place>(at: P, value: Option<f64>) -> Result<f64, MathError> {
    value.ok_or_else(|| MathError::OutsideMesh { at: at.coordinates() })
}

/// Makes a type with `find` a function of points.
macro_rules! function_on_mesh {
    ($name:ident, $place:ty) => {
        impl Function<$place> for $name {
            type Value = f64;

            /// The value at a point [m]: NaN outside of the mesh if there is no default value, and at NaN.
            #[inline]
            fn evaluate(&self, at: $place) -> f64 {
                self.find(at).unwrap_or(f64::NAN)
            }

            /// As [`evaluate`](Function::evaluate), with [`MathError::OutsideMesh`] in place of NaN.
            fn checked(&self, at: $place) -> Result<f64, MathError> {
                found(at, self.find(at))
            }
        }
    };
}
pub(super) use function_on_mesh;
