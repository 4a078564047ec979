//! Physics of the path tracer against closed forms.

mod check;
mod controls;
mod depth;
mod dispersion;
mod filters;
mod furnace;
mod glass;
mod irradiance;
mod known;
mod lights;
mod materials;
mod mesh_lights;
mod modifiers;
mod plates;
mod prisms;
mod readings;
mod rough;
mod scenes;
mod sensors;
mod volumes;
mod wrong;
mod wrong_sensors;
