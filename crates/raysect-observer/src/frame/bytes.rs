//! Frames as bytes, every bit of them.

use std::collections::BTreeMap;

use super::{Frame, Sums};
use crate::FrameShape;
use crate::statepoint::{ByteReader, ByteWriter};

impl FrameShape {
    fn write(self, out: &mut ByteWriter) {
        let kind = match self {
            Self::Single => 0,
            Self::Line(_) => 1,
            Self::Image { .. } => 2,
        };
        [kind, self.columns() as u64, self.rows() as u64].into_iter().for_each(|number| out.count(number));
    }

    fn read(bytes: &mut ByteReader<'_>) -> Result<Self, String> {
        let (kind, columns, rows) = (bytes.count()?, bytes.size()?, bytes.size()?);
        if columns.checked_mul(rows).is_none() {
            return Err(format!("{columns}×{rows} pixels"));
        }
        match kind {
            0 => Ok(Self::Single),
            1 => Ok(Self::Line(columns)),
            2 => Ok(Self::Image { columns, rows }),
            other => Err(format!("a shape of kind {other}")),
        }
    }
}

impl Frame {
    /// Appends everything that is known of it.
    pub(crate) fn write(&self, out: &mut ByteWriter) {
        out.text(&self.name);
        out.text(&self.unit);
        self.shape.write(out);
        out.count(self.channels.len() as u64);
        self.channels.iter().for_each(|channel| out.text(channel));
        out.text(&self.fingerprint);
        let observed: String = self.observed.iter().map(|&seen| if seen { '1' } else { '0' }).collect();
        out.text(&observed);
        out.count(self.lanes.len() as u64);
        for (&lane, sums) in &self.lanes {
            out.count(lane);
            out.numbers(&sums.closed);
            out.numbers(&sums.open);
        }
    }

    /// Reads what [`write`](Self::write) has written.
    pub(crate) fn read(bytes: &mut ByteReader<'_>) -> Result<Self, String> {
        let (name, unit) = (bytes.text()?, bytes.text()?);
        let shape = FrameShape::read(bytes)?;
        let channels = (0..bytes.count()?).map(|_| bytes.text()).collect::<Result<Vec<_>, _>>()?;
        let fingerprint = bytes.text()?;
        let observed: Vec<bool> = bytes.text()?.bytes().map(|b| b == b'1').collect();
        let mut lanes = BTreeMap::new();
        for _ in 0..bytes.count()? {
            let lane = bytes.count()?;
            let (closed, open) = (bytes.numbers()?, bytes.numbers()?);
            let sums = Sums::from_parts(shape.pixels(), channels.len(), closed, open);
            lanes.insert(lane, sums.ok_or_else(|| format!("lane {lane} of '{name}' has a wrong size"))?);
        }
        if !lanes.is_empty() && observed.len() != shape.pixels() {
            return Err(format!("{} pixels of '{name}' instead of {}", observed.len(), shape.pixels()));
        }
        Ok(Self { name, unit, shape, channels, fingerprint, observed, lanes, stretches: Vec::new() }
            .settled())
    }
}
