//! Reading columns of numbers.

use std::path::Path;

use crate::OpticalError;

/// The `N` columns of a text of numbers; blank lines and lines that begin with `#` are passed over.
pub(crate) fn columns<const N: usize>(path: &Path, text: &str) -> Result<[Vec<f64>; N], OpticalError> {
    let mut columns = [const { Vec::new() }; N];
    for (number, line) in text.lines().enumerate() {
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let row = row::<N>(line).map_err(|what| wrong(path, number + 1, what))?;
        for (column, value) in columns.iter_mut().zip(row) {
            column.push(value);
        }
    }
    Ok(columns)
}

/// The `N` numbers of a line.
pub(crate) fn row<const N: usize>(line: &str) -> Result<[f64; N], String> {
    let fields: Vec<&str> =
        line.split(|c: char| c == ',' || c == ';' || c.is_whitespace()).filter(|f| !f.is_empty()).collect();
    if fields.len() != N {
        return Err(format!("{} fields where {N} numbers belong: '{line}'", fields.len()));
    }
    let mut numbers = [0.0; N];
    for (number, field) in numbers.iter_mut().zip(fields) {
        *number = field.parse().map_err(|_| format!("'{field}' is not a number"))?;
    }
    Ok(numbers)
}

pub(crate) fn wrong(path: &Path, line: usize, what: String) -> OpticalError {
    OpticalError::Line { path: path.to_owned(), line, what }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_are_wrong_are_named() {
        let read = |text: &str| columns::<2>(Path::new("x.csv"), text).map_err(|e| e.to_string());
        assert_eq!(
            read("# c\n\n400, 1\n500;2\n600\t3e0\n").unwrap(),
            [vec![400.0, 500.0, 600.0], vec![1.0, 2.0, 3.0]]
        );
        assert_eq!(
            read("400, 1\n500\n").unwrap_err(),
            "x.csv, line 2: 1 fields where 2 numbers belong: '500'"
        );
        assert!(read("400, a").unwrap_err().contains("'a' is not a number"));
    }
}
