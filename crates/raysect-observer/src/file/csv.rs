use std::path::Path;

use raysect_core::{csv_number, csv_text};

use super::{FileError, write_atomically};

/// Saves a table as comma separated values: a line of the titles of its columns, then a line for each row.
///
/// Numbers are written with as few digits as bring every bit back. Titles with a comma, a quotation mark or a line
/// break are quoted (RFC 4180). Infinities are `inf`, what is not a number is `NaN`.
///
/// ```no_run
/// use raysect_observer::file::save_csv;
/// save_csv("a.csv", &["wavelength [nm]", "radiance [W/m²/sr/nm]"], &[vec![500.0, 0.25], vec![510.0, 0.5]])?;
/// # Ok::<(), raysect_observer::file::FileError>(())
/// ```
///
/// # Errors
/// [`FileError::Shape`] for a row of another length than the titles, [`FileError::Io`].
pub fn save_csv(
    path: impl AsRef<Path>,
    titles: &[impl AsRef<str>],
    rows: &[Vec<f64>],
) -> Result<(), FileError> {
    let path = path.as_ref();
    for (number, row) in rows.iter().enumerate() {
        FileError::check_shape(path, &format!("row {number}"), &[titles.len()], row.len())?;
    }
    let titles: Vec<_> = titles.iter().map(|title| csv_text(title.as_ref())).collect();
    write_atomically(path, |writer| {
        writeln!(writer, "{}", titles.join(","))?;
        for row in rows {
            let numbers: Vec<String> = row.iter().map(|&number| csv_number(number)).collect();
            writeln!(writer, "{}", numbers.join(","))?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::super::scratch::Folder;
    use super::*;

    #[test]
    fn every_bit_comes_back() {
        let folder = Folder::new();
        let path = folder.join("a.csv");
        let numbers =
            [0.1, -0.0, 1.0 / 3.0, 1e-310, f64::MAX, f64::MIN_POSITIVE, f64::INFINITY, 5e15, 123456.75];
        let rows: Vec<Vec<f64>> = numbers.iter().map(|&x| vec![x, -x]).collect();
        save_csv(&path, &["wavelength [nm]", "a, \"b\""], &rows).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("wavelength [nm],\"a, \"\"b\"\"\""));
        for (line, row) in lines.by_ref().zip(&rows) {
            let found: Vec<u64> = line.split(',').map(|n| n.parse::<f64>().unwrap().to_bits()).collect();
            assert_eq!(found, row.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), "{line}");
            assert!(line.len() < 52, "{line}");
        }
        assert_eq!((lines.next(), text.lines().count()), (None, 1 + numbers.len()));
        assert_eq!(folder.names(), ["a.csv"]);
    }

    #[test]
    fn rows_of_another_length_are_refused() {
        let folder = Folder::new();
        let result = save_csv(folder.join("a.csv"), &["a", "b"], &[vec![1.0, 2.0], vec![1.0]]);
        assert_eq!(
            result.unwrap_err().to_string().rsplit(": ").next().unwrap(),
            "row 1 of shape [2] holds 2 values, 1 are given"
        );
        assert!(folder.names().is_empty());
    }
}
