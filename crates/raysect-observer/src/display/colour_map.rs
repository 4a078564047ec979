use std::sync::OnceLock;

/// Colours for brightness: grey, or one of Matplotlib's perceptually uniform maps.
///
/// ```
/// use raysect_observer::ColourMap;
/// assert_eq!(ColourMap::Grey.colour(1.0), [255, 255, 255]);
/// assert_eq!(ColourMap::Viridis.colour(0.0), [68, 1, 84]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColourMap {
    /// From black to white.
    #[default]
    Grey,
    /// Violet, green, yellow.
    Viridis,
    /// Black, purple, pale yellow.
    Magma,
    /// Black, red, bright yellow.
    Inferno,
    /// Blue, red, yellow.
    Plasma,
}

/// The colour of what is not known: middle grey, which the coloured maps do not have.
const UNKNOWN: [u8; 3] = [128; 3];

/// Rows of a table.
const ROWS: usize = 256;

impl ColourMap {
    /// All of them, by the names that files and command lines use.
    pub const ALL: [(&'static str, Self); 5] = [
        ("grey", Self::Grey),
        ("viridis", Self::Viridis),
        ("magma", Self::Magma),
        ("inferno", Self::Inferno),
        ("plasma", Self::Plasma),
    ];

    /// Its name, in small letters.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, map)| *map == self).map_or("", |(name, _)| name)
    }

    /// The 8-bit sRGB values of a brightness; what lies outside 0 … 1 gets the colour of the nearest end, NaN a
    /// middle grey.
    pub fn colour(self, brightness: f64) -> [u8; 3] {
        if brightness.is_nan() {
            return UNKNOWN;
        }
        let level = brightness.clamp(0.0, 1.0);
        let byte = |value: f64| (255.0 * value).round() as u8;
        let Some(table) = self.table() else { return [byte(level); 3] };
        let place = level * (ROWS - 1) as f64;
        let row = (place as usize).min(ROWS - 2);
        let part = place - row as f64;
        let (low, high) = (table[row], table[row + 1]);
        [0, 1, 2].map(|c| byte(low[c] + part * (high[c] - low[c])))
    }

    fn table(self) -> Option<&'static [[f64; 3]]> {
        macro_rules! table {
            ($file:literal) => {{
                static TABLE: OnceLock<Vec<[f64; 3]>> = OnceLock::new();
                TABLE.get_or_init(|| rows(include_str!(concat!("../../data/colour_map/", $file))))
            }};
        }
        match self {
            Self::Grey => None,
            Self::Viridis => Some(table!("viridis.csv")),
            Self::Magma => Some(table!("magma.csv")),
            Self::Inferno => Some(table!("inferno.csv")),
            Self::Plasma => Some(table!("plasma.csv")),
        }
    }
}

/// The rows of a table. Data files of this crate are read by its tests, so that reading them cannot fail later.
fn rows(text: &str) -> Vec<[f64; 3]> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let numbers = |line: &str| {
        let row: Option<Vec<f64>> = line.split(',').map(|number| number.trim().parse().ok()).collect();
        row.and_then(|row| <[f64; 3]>::try_from(row).ok())
    };
    let rows: Option<Vec<[f64; 3]>> = lines.map(numbers).collect();
    match rows {
        Some(rows) if rows.len() == ROWS => rows,
        _ => unreachable!("a data file of this crate: {ROWS} rows of three numbers"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_begin_and_end_with_their_own_colours() {
        let ends = |map: ColourMap| (map.colour(0.0), map.colour(1.0));
        assert_eq!(ends(ColourMap::Grey), ([0, 0, 0], [255, 255, 255]));
        // 440154, fde725; 000004, fcfdbf; 000004, fcffa4; 0d0887, f0f921.
        assert_eq!(ends(ColourMap::Viridis), ([68, 1, 84], [253, 231, 37]));
        assert_eq!(ends(ColourMap::Magma), ([0, 0, 4], [252, 253, 191]));
        assert_eq!(ends(ColourMap::Inferno), ([0, 0, 4], [252, 255, 164]));
        assert_eq!(ends(ColourMap::Plasma), ([13, 8, 135], [240, 249, 33]));
    }

    #[test]
    fn maps_grow_brighter_without_steps() {
        for (name, map) in ColourMap::ALL {
            assert_eq!(map.name(), name);
            let luma =
                |c: [u8; 3]| 0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2]);
            let shown: Vec<[u8; 3]> = (0..=1000).map(|i| map.colour(f64::from(i) / 1000.0)).collect();
            for pair in shown.windows(2) {
                let step = (0..3).map(|c| pair[0][c].abs_diff(pair[1][c])).max().unwrap();
                assert!(step <= 3, "{name}: {pair:?}");
            }
            let tenth = shown.iter().step_by(100).map(|&c| luma(c)).collect::<Vec<_>>();
            assert!(tenth.windows(2).all(|pair| pair[0] < pair[1]), "{name}: {tenth:?}");
        }
    }

    #[test]
    fn what_is_outside_or_unknown_has_a_colour() {
        let map = ColourMap::Magma;
        assert_eq!(map.colour(-3.0), map.colour(0.0));
        assert_eq!(map.colour(f64::INFINITY), map.colour(1.0));
        assert_eq!(map.colour(f64::NAN), [128; 3]);
        let has_unknown = (0..=5000).any(|i| map.colour(f64::from(i) / 5000.0) == [128; 3]);
        assert!(!has_unknown);
    }
}
