use super::{Mesh, MeshData, MeshError};

/// Options of a [`Mesh`].
#[derive(Debug, Clone)]
pub struct MeshBuilder {
    data: MeshData,
    smoothing: bool,
    closed: Option<bool>,
    tolerant: bool,
    flip_normals: bool,
}

impl MeshBuilder {
    pub(super) fn new(data: MeshData) -> Self {
        Self { data, smoothing: true, closed: None, tolerant: true, flip_normals: false }
    }

    /// Whether to shade with vertex normals, interpolated over each triangle, if there are any. On by default.
    pub fn smoothing(mut self, smoothing: bool) -> Self {
        self.smoothing = smoothing;
        self
    }

    /// Declares that the mesh encloses a volume, or that it does not, instead of looking whether its triangles close.
    /// An open mesh has two sides and contains nothing.
    pub fn closed(mut self, closed: bool) -> Self {
        self.closed = Some(closed);
        self
    }

    /// Whether to leave out triangles without area, which no ray meets, instead of refusing them. On by default.
    pub fn tolerant(mut self, tolerant: bool) -> Self {
        self.tolerant = tolerant;
        self
    }

    /// Whether to turn the mesh inside out: triangles are wound the other way, vertex normals reversed.
    pub fn flip_normals(mut self, flip_normals: bool) -> Self {
        self.flip_normals = flip_normals;
        self
    }

    /// Builds the tree.
    ///
    /// # Errors
    /// [`MeshError::Empty`] if no triangle has an area; [`MeshError::Degenerate`] for a triangle without area in a
    /// mesh that is not tolerant; [`MeshError::InsideOut`] if the triangles close but look inward.
    pub fn build(self) -> Result<Mesh, MeshError> {
        let count = self.data.triangle_count();
        let degenerate = (0..count).find(|&t| self.data.is_degenerate(t));
        let data = match degenerate {
            None => self.data,
            Some(triangle) if !self.tolerant => return Err(MeshError::Degenerate { triangle }),
            Some(_) => self.data.without_degenerate()?.0,
        };
        let data = if self.flip_normals { data.flipped() } else { data };
        let closed = match self.closed {
            Some(closed) => closed,
            None => {
                let health = data.health();
                let sound = health.is_watertight() && health.is_consistently_oriented();
                if sound && health.volume().is_some_and(|v| v < 0.0) {
                    return Err(MeshError::InsideOut);
                }
                sound
            }
        };
        Ok(Mesh::of(data, self.smoothing, closed))
    }
}
