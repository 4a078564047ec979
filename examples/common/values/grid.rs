//! Values on grids, as nested lists.

use raysect::math::function::Interpolation;
use serde_json::Value;

use crate::json::{field, list, number, same_length};

/// The numbers of a list.
pub(crate) fn numbers_of(object: &Value, key: &str) -> Result<Vec<f64>, String> {
    field(object, key, |v| list(v, number))
}

/// Nested lists one after another; each list has as many entries as its axis.
pub(crate) fn flat(value: &Value, axes: &[(&str, usize)]) -> Result<Vec<f64>, String> {
    let [(axis, count), inner @ ..] = axes else { return Ok(vec![number(value)?]) };
    let parts = list(value, |v| flat(v, inner))?;
    same_length("the list", parts.len(), axis, *count)?;
    Ok(parts.concat())
}

/// The two kinds of interpolation, by their names.
pub(crate) const KINDS: [(&str, Interpolation); 2] =
    [("linear", Interpolation::Linear), ("cubic", Interpolation::Cubic)];
