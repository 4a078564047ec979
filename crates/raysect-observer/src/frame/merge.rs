use super::{Frame, Sums};
use crate::ObserverError;

impl Frame {
    /// Adds the samples of another frame of the same observation: those of other lanes, or of other pixels in the same
    /// lane. The order of several merges changes no bit.
    ///
    /// # Errors
    /// [`ObserverError::OtherFrame`] for a frame of something else; [`ObserverError::Overlap`] if both have samples of
    /// the same pixel in the same lane. The frame is then as before.
    pub fn merge(&mut self, other: &Self) -> Result<(), ObserverError> {
        if other.is_empty() {
            return Ok(());
        }
        if self.name != other.name || self.unit != other.unit {
            return Err(ObserverError::OtherFrame {
                name: self.name.clone(),
                before: format!("'{}' [{}]", self.name, self.unit),
                now: format!("'{}' [{}]", other.name, other.unit),
            });
        }
        self.check(other.shape, &other.channels, &other.fingerprint)?;
        for (&lane, theirs) in &other.lanes {
            let both = |pixel: &usize| self.lane_samples(lane, *pixel) > 0 && theirs.samples(*pixel) > 0;
            if let Some(pixel) = (0..other.shape.pixels()).find(both) {
                return Err(ObserverError::Overlap { name: self.name.clone(), lane, pixel });
            }
        }
        for (&lane, theirs) in &other.lanes {
            self.prepare(other.shape, other.channels.clone(), &other.fingerprint, lane, &other.observed);
            self.take_in(lane, theirs);
        }
        self.settle();
        Ok(())
    }

    fn take_in(&mut self, lane: u64, theirs: &Sums) {
        if let Some(sums) = self.lanes.get_mut(&lane) {
            for pixel in (0..self.shape.pixels()).filter(|&pixel| theirs.samples(pixel) > 0) {
                sums.copy_pixel(pixel, theirs);
            }
        }
    }
}
