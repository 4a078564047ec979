//! Arguments of the command line that several examples share.

/// Reads `256x192` as columns and rows.
pub(crate) fn pixels(text: &str) -> Result<(usize, usize), String> {
    let numbers = text.split_once('x').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    numbers.ok_or_else(|| format!("'{text}' is not a size like 256x192"))
}
