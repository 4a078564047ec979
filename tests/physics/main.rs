//! Physics of the path tracer against closed forms.

mod check;
mod furnace;
mod materials;
mod scenes;
