use std::fmt;

/// What happens to a path at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PathEvent {
    /// It begins here.
    Started,
    /// It passes straight on: through a null surface, or one that a medium of higher priority hides.
    Passed,
    /// It stays on its side of a surface, in the one direction that is left to it.
    Mirrored,
    /// It goes through a surface, in the one direction that is left to it.
    Refracted,
    /// It stays on its side of a surface, in a direction drawn from many.
    Reflected,
    /// It goes through a surface, in a direction drawn from many.
    Transmitted,
    /// It is scattered in a volume.
    Scattered,
    /// It ends on a surface that emits towards it.
    Emitted,
    /// It ends on a surface, or where a volume was to scatter it and nothing did.
    Absorbed,
    /// It leaves the scene, or reaches the end that was set to it.
    Escaped,
    /// Roulette ends it; the survivors make up for it.
    Killed,
    /// `max_depth` ends it, which nothing makes up for.
    Truncated,
    /// It is given up between transparent surfaces, or in a medium without end.
    Lost,
}

impl PathEvent {
    /// All events, in the order of the numbers by which [`save_vtk`](crate::LoggedPath::save_vtk) names them.
    pub const ALL: [Self; 13] = [
        Self::Started,
        Self::Passed,
        Self::Mirrored,
        Self::Refracted,
        Self::Reflected,
        Self::Transmitted,
        Self::Scattered,
        Self::Emitted,
        Self::Absorbed,
        Self::Escaped,
        Self::Killed,
        Self::Truncated,
        Self::Lost,
    ];

    /// True if no path goes on from there.
    pub fn is_end(self) -> bool {
        self as usize >= Self::Emitted as usize
    }

    /// One word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Started => "started",
            Self::Passed => "passed",
            Self::Mirrored => "mirrored",
            Self::Refracted => "refracted",
            Self::Reflected => "reflected",
            Self::Transmitted => "transmitted",
            Self::Scattered => "scattered",
            Self::Emitted => "emitted",
            Self::Absorbed => "absorbed",
            Self::Escaped => "escaped",
            Self::Killed => "killed",
            Self::Truncated => "truncated",
            Self::Lost => "lost",
        }
    }
}

impl fmt::Display for PathEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_stand_at_their_numbers() {
        assert!(PathEvent::ALL.iter().enumerate().all(|(number, &event)| event as usize == number));
        let ends = PathEvent::ALL.into_iter().filter(|event| event.is_end()).count();
        assert_eq!((ends, PathEvent::Scattered.is_end()), (6, false));
    }
}
