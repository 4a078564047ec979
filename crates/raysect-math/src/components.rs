//! Coordinates and components by their number, written once.

/// Implements `Index` and `IndexMut` by the number of a component.
macro_rules! indexed {
    ($name:ident, $what:literal, $($number:literal => $field:ident),+) => {
        impl std::ops::Index<usize> for $name {
            type Output = f64;
            #[inline]
            fn index(&self, number: usize) -> &f64 {
                match number {
                    $($number => &self.$field,)+
                    _ => panic!("there is no component {number} of {}", $what),
                }
            }
        }
        impl std::ops::IndexMut<usize> for $name {
            #[inline]
            fn index_mut(&mut self, number: usize) -> &mut f64 {
                match number {
                    $($number => &mut self.$field,)+
                    _ => panic!("there is no component {number} of {}", $what),
                }
            }
        }
    };
}

pub(crate) use indexed;
