//! Reads values of JSON; errors name the place, like `shape: a: radius: a number is needed, not "wide"`.

use serde_json::Value;

/// What a field of an object holds.
pub(crate) fn field<T>(
    object: &Value,
    key: &str,
    read: impl FnOnce(&Value) -> Result<T, String>,
) -> Result<T, String> {
    let value = object.get(key).ok_or_else(|| format!("there is no '{key}'"))?;
    read(value).map_err(|e| format!("{key}: {e}"))
}

/// A sentence is cut off after so many characters of a value.
const EXCERPT: usize = 40;

fn wrong(needed: &str, value: &Value) -> String {
    let text = value.to_string();
    let excerpt: String = text.chars().take(EXCERPT).collect();
    format!("{needed} is needed, not {excerpt}{}", if excerpt.len() < text.len() { "…" } else { "" })
}

pub(crate) fn text(value: &Value) -> Result<String, String> {
    value.as_str().map(str::to_owned).ok_or_else(|| wrong("a text", value))
}

pub(crate) fn number(value: &Value) -> Result<f64, String> {
    value.as_f64().filter(|v| v.is_finite()).ok_or_else(|| wrong("a number", value))
}

/// The number of a vertex.
pub(crate) fn index(value: &Value) -> Result<u32, String> {
    let index = value.as_u64().and_then(|v| u32::try_from(v).ok());
    index.ok_or_else(|| wrong("a number of a vertex", value))
}

/// 0 or 1.
pub(crate) fn flag(value: &Value) -> Result<bool, String> {
    match value.as_u64() {
        Some(0) => Ok(false),
        Some(1) => Ok(true),
        _ => Err(wrong("0 or 1", value)),
    }
}

/// A list of any length.
pub(crate) fn list<T>(value: &Value, read: impl Fn(&Value) -> Result<T, String>) -> Result<Vec<T>, String> {
    let items = value.as_array().ok_or_else(|| wrong("a list", value))?;
    let entry = |(i, item)| read(item).map_err(|e| format!("entry {i}: {e}"));
    items.iter().enumerate().map(entry).collect()
}

/// A list of `N` entries.
pub(crate) fn array<T, const N: usize>(
    value: &Value,
    read: impl Fn(&Value) -> Result<T, String>,
) -> Result<[T; N], String> {
    list(value, read)?.try_into().map_err(|_| wrong(&format!("a list of {N}"), value))
}

/// `N` numbers.
pub(crate) fn numbers<const N: usize>(value: &Value) -> Result<[f64; N], String> {
    array(value, number)
}

/// An error unless two lists have equally many entries.
pub(crate) fn same_length(a: &str, count_a: usize, b: &str, count_b: usize) -> Result<(), String> {
    let same = count_a == count_b;
    if same { Ok(()) } else { Err(format!("{a} and {b}: {count_a} and {count_b} entries")) }
}
