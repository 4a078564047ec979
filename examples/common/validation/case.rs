use serde_json::Value;

use crate::json::{array, field, list, number, numbers, text};

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

    /// The same, with a usual value.
    pub(crate) fn numbers_or<const N: usize>(&self, key: &str, usual: [f64; N]) -> Result<[f64; N], String> {
        if self.has(key) { self.numbers(key) } else { Ok(usual) }
    }

    /// True if it has a parameter.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.parameters.get(key).is_some()
    }

    /// The first of some keys that it has.
    fn among<'k>(&self, keys: &[&'k str]) -> Option<&'k str> {
        keys.iter().copied().find(|key| self.has(key))
    }

    /// A number by one of several names, or a usual value.
    pub(crate) fn number_among(&self, keys: &[&str], usual: f64) -> Result<f64, String> {
        self.among(keys).map_or(Ok(usual), |key| self.number(key))
    }

    /// Numbers, if there are any.
    pub(crate) fn list_or(&self, key: &str, usual: &[f64]) -> Result<Vec<f64>, String> {
        if !self.has(key) {
            return Ok(usual.to_vec());
        }
        field(&self.parameters, key, |v| list(v, digits))
    }

    /// Lists of numbers, if there are any.
    pub(crate) fn lists(&self, key: &str) -> Result<Option<Vec<Vec<f64>>>, String> {
        let read = |v: &Value| list(v, |row| list(row, digits));
        self.has(key).then(|| field(&self.parameters, key, read)).transpose()
    }

    /// Three rows of three numbers, if there are any.
    pub(crate) fn matrix(&self, key: &str) -> Result<Option<[[f64; 3]; 3]>, String> {
        self.has(key).then(|| field(&self.parameters, key, |v| array(v, numbers::<3>))).transpose()
    }

    /// Points or vectors by one of several names, with the columns and rows that they fill: a list of them, or a list of
    /// columns. They are then row by row.
    pub(crate) fn vectors(&self, keys: &[&str]) -> Result<Option<Picture>, String> {
        self.among(keys).map(|key| field(&self.parameters, key, picture)).transpose()
    }

    /// Columns and rows, or a number of columns of one row; usual ones if there are none.
    pub(crate) fn pixels_or(&self, usual: (usize, usize)) -> Result<(usize, usize), String> {
        let read = |v: &Value| match v.as_u64() {
            Some(columns) => Ok((columns as usize, 1)),
            None => numbers::<2>(v).map(|[columns, rows]| (columns as usize, rows as usize)),
        };
        if self.has("pixels") { field(&self.parameters, "pixels", read) } else { Ok(usual) }
    }

    pub(crate) fn text(&self, key: &str) -> Result<String, String> {
        field(&self.parameters, key, text)
    }

    /// True or false, with a usual value.
    pub(crate) fn flag_or(&self, key: &str, usual: bool) -> Result<bool, String> {
        if self.has(key) { self.flag(key) } else { Ok(usual) }
    }

    pub(crate) fn flag(&self, key: &str) -> Result<bool, String> {
        field(&self.parameters, key, |v| v.as_bool().ok_or_else(|| "true or false is needed".into()))
    }
}

/// Columns and rows, and vectors row by row.
pub(crate) type Picture = ((usize, usize), Vec<[f64; 3]>);

fn picture(value: &Value) -> Result<Picture, String> {
    if !value[0][0].is_array() {
        let all = list(value, numbers::<3>)?;
        return Ok(((all.len(), 1), all));
    }
    let columns = list(value, |column| list(column, numbers::<3>))?;
    let rows = columns[0].len();
    if columns.iter().any(|column| column.len() != rows) {
        return Err("columns of equal length are needed".to_owned());
    }
    let all = (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
    Ok(((columns.len(), rows), all))
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
