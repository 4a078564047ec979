//! Physics of the path tracer against closed forms.

mod check;
mod controls;
mod depth;
mod furnace;
mod glass;
mod irradiance;
mod lights;
mod materials;
mod modifiers;
mod plates;
mod rough;
mod scenes;
mod wrong;
