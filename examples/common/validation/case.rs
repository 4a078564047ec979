use serde_json::Value;

use crate::json::{field, list, number, numbers, text};

/// A problem with its answer.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) id: String,
    /// Which scene it is.
    pub(crate) kind: String,
    /// The value that must be read.
    pub(crate) expected: f64,
    /// Relative to the expected value, or absolute where that is zero.
    pub(crate) tolerance: f64,
    parameters: Value,
}

impl Case {
    fn read(value: &Value) -> Result<Self, String> {
        Ok(Self {
            id: field(value, "id", text)?,
            kind: field(value, "kind", text)?,
            expected: field(value, "expected", number)?,
            tolerance: field(value, "rel_tolerance_deterministic", number)?,
            parameters: field(value, "parameters", |v| Ok(v.clone()))?,
        })
    }

    /// A number among its parameters; also one that is written as a text, to keep its digits.
    pub(crate) fn number(&self, key: &str) -> Result<f64, String> {
        field(&self.parameters, key, digits)
    }

    /// A number that has a usual value.
    pub(crate) fn number_or(&self, key: &str, usual: f64) -> Result<f64, String> {
        if self.parameters.get(key).is_some() { self.number(key) } else { Ok(usual) }
    }

    /// Two or three numbers.
    pub(crate) fn numbers<const N: usize>(&self, key: &str) -> Result<[f64; N], String> {
        let read = |v: &Value| {
            let all = list(v, digits)?;
            all.try_into().map_err(|_| format!("a list of {N} is needed"))
        };
        field(&self.parameters, key, read)
    }

    /// Columns and rows.
    pub(crate) fn pixels(&self) -> Result<(usize, usize), String> {
        let [columns, rows] = field(&self.parameters, "pixels", numbers::<2>)?;
        Ok((columns as usize, rows as usize))
    }

    pub(crate) fn text(&self, key: &str) -> Result<String, String> {
        field(&self.parameters, key, text)
    }

    pub(crate) fn flag(&self, key: &str) -> Result<bool, String> {
        field(&self.parameters, key, |v| v.as_bool().ok_or_else(|| "true or false is needed".into()))
    }
}

fn digits(value: &Value) -> Result<f64, String> {
    match value.as_str() {
        Some(text) => text.parse().map_err(|_| format!("a number is needed, not '{text}'")),
        None => number(value),
    }
}

/// The cases of a file: an object with a list `cases`, or such a list.
pub(crate) fn read_cases(content: &str) -> Result<Vec<Case>, String> {
    let content: Value = serde_json::from_str(content).map_err(|e| e.to_string())?;
    let cases = content.get("cases").unwrap_or(&content);
    let entries = list(cases, |case| Ok(case.clone()))?;
    let read = |(i, case)| Case::read(case).map_err(|e| format!("case {i}: {e}"));
    entries.iter().enumerate().map(read).collect()
}
