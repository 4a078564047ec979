//! What holds of every public function for all arguments, beside the tests of single types.

mod functions;
mod maps;
mod samplers;
mod sums;
