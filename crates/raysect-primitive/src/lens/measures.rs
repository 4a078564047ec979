//! What can be asked of a lens, written once for all five.

/// For a shape whose first field is the body.
macro_rules! measures {
    ($lens:ident { $($number:ident),* }) => {
        impl $lens {
            /// The diameter [m].
            pub fn diameter(&self) -> f64 {
                self.0.diameter
            }

            /// Thickness on the axis [m].
            #[doc(alias = "center_thickness")]
            pub fn centre_thickness(&self) -> f64 {
                self.0.centre_thickness
            }

            /// Thickness at the edge: length of the barrel [m].
            pub fn edge_thickness(&self) -> f64 {
                self.0.edge_thickness
            }

            /// Volume [m³].
            pub fn volume(&self) -> f64 {
                self.0.volume()
            }

            /// Area of both surfaces and the barrel [m²].
            pub fn surface_area(&self) -> f64 {
                self.0.surface_area()
            }

            fn saved(
                &self,
                _: &mut raysect_core::save::SceneWriter,
            ) -> Result<raysect_core::save::Saved, raysect_core::save::SaveError> {
                let saved = raysect_core::save::Saved::new(stringify!($lens))
                    .number("diameter", self.diameter())
                    .number("centre_thickness", self.centre_thickness());
                Ok(saved$(.number(stringify!($number), self.$number()))*)
            }
        }
    };
}
pub(super) use measures;

/// For a shape of a body and the radii of curvature of its front and its back.
macro_rules! two_curved_faces {
    ($lens:ident) => {
        crate::lens::measures::measures!($lens { front_curvature, back_curvature });

        impl $lens {
            /// Radius of curvature of the front surface [m].
            pub fn front_curvature(&self) -> f64 {
                self.1
            }

            /// Depth of the cap of the front surface, its sagitta [m].
            pub fn front_thickness(&self) -> f64 {
                self.0.front_sag()
            }

            /// Radius of curvature of the back surface [m].
            pub fn back_curvature(&self) -> f64 {
                self.2
            }

            /// Depth of the cap of the back surface, its sagitta [m].
            pub fn back_thickness(&self) -> f64 {
                self.0.back_sag()
            }
        }
    };
}
pub(super) use two_curved_faces;

/// For a shape of a body and the radius of curvature of its front, with a flat back.
macro_rules! one_curved_face {
    ($lens:ident) => {
        crate::lens::measures::measures!($lens { curvature });

        impl $lens {
            /// Radius of curvature of the curved surface [m].
            pub fn curvature(&self) -> f64 {
                self.1
            }

            /// Depth of the cap of the curved surface, its sagitta [m].
            pub fn curve_thickness(&self) -> f64 {
                self.0.front_sag()
            }
        }
    };
}
pub(super) use one_curved_face;
