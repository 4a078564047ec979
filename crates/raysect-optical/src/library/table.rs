//! Reading columns of numbers.

use std::path::Path;

use crate::{InterpolatedSf, OpticalError, WavelengthUnit};

/// The rows of a text of numbers, each with its line, counted from 1; blank lines and lines that begin with `#` are
/// passed over.
fn rows(path: &Path, text: &str, count: usize) -> Result<Vec<(usize, Vec<f64>)>, OpticalError> {
    let lines = text.lines().map(|line| line.trim().trim_start_matches('\u{feff}')).zip(1..);
    lines
        .filter(|(line, _)| !line.is_empty() && !line.starts_with('#'))
        .map(|(line, number)| Ok((number, numbers(line, count).map_err(|what| wrong(path, number, what))?)))
        .collect()
}

/// The `N` columns of a text of numbers.
pub(crate) fn columns<const N: usize>(path: &Path, text: &str) -> Result<[Vec<f64>; N], OpticalError> {
    let rows = rows(path, text, N)?;
    Ok(std::array::from_fn(|column| rows.iter().map(|(_, row)| row[column]).collect()))
}

/// The functions of a text whose first column is the wavelength and the others are `N` functions; what is wrong with
/// one is told with its line.
pub(crate) fn functions<const N: usize>(
    path: &Path,
    text: &str,
    unit: WavelengthUnit,
) -> Result<[InterpolatedSf; N], OpticalError> {
    let rows = rows(path, text, N + 1)?;
    if rows.is_empty() {
        return Err(wrong(path, 1, "there are no rows of numbers".to_owned()));
    }
    let wavelengths: Vec<f64> = rows.iter().map(|(_, row)| unit.to_nanometres(row[0])).collect();
    let mut functions = Vec::with_capacity(N);
    for column in 1..=N {
        let values: Vec<f64> = rows.iter().map(|(_, row)| row[column]).collect();
        functions.push(InterpolatedSf::new(wavelengths.clone(), values).map_err(|error| match error {
            OpticalError::Table { index, wavelength, value, what } => {
                wrong(path, rows[index].0, format!("{what} ({wavelength} nm, {value})"))
            }
            other => other,
        })?);
    }
    Ok(functions.try_into().unwrap_or_else(|_| unreachable!("one function was made of each column")))
}

/// The `N` numbers of a line.
pub(crate) fn row<const N: usize>(line: &str) -> Result<[f64; N], String> {
    let numbers = numbers(line, N)?;
    Ok(std::array::from_fn(|i| numbers[i]))
}

fn numbers(line: &str, count: usize) -> Result<Vec<f64>, String> {
    let fields: Vec<&str> =
        line.split(|c: char| c == ',' || c == ';' || c.is_whitespace()).filter(|f| !f.is_empty()).collect();
    if fields.len() != count {
        return Err(format!("{} fields where {count} numbers belong: '{line}'", fields.len()));
    }
    fields.iter().map(|field| field.parse().map_err(|_| format!("'{field}' is not a number"))).collect()
}

pub(crate) fn wrong(path: &Path, line: usize, what: String) -> OpticalError {
    OpticalError::Line { path: path.to_owned(), line, what }
}

/// Data files of this crate are all read by its tests, so that reading them cannot fail later.
pub(crate) fn proven<T>(result: Result<T, OpticalError>) -> T {
    result.unwrap_or_else(|error| unreachable!("a data file of this crate: {error}"))
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

    #[test]
    fn the_columns_of_functions_share_their_wavelengths() {
        let read = |text: &str| functions::<2>(Path::new("x.csv"), text, WavelengthUnit::Micrometre);
        let [n, k] = read("0.4, 1.5, 3\n0.5, 1.6, 4\n").unwrap();
        assert_eq!(
            (n.wavelengths(), n.values(), k.values()),
            (&[400.0, 500.0][..], &[1.5, 1.6][..], &[3.0, 4.0][..])
        );
        let message = read("0.4, 1.5, 3\n0.5, 1.6, inf\n").unwrap_err().to_string();
        assert_eq!(message, "x.csv, line 2: values must be finite (500 nm, inf)");
    }
}
