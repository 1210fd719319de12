//! ```text
ABOUT
//! ```
#![no_std]
#![forbid(unsafe_code)]
// the field's symbols: R, R_d, E
#![allow(non_snake_case)]
// the numbers of f64 stand in f32, too, and a law may hold pi as a number
#![allow(clippy::excessive_precision, clippy::approx_constant)]
// kp, kv and the state are arguments of their own
#![allow(clippy::too_many_arguments)]
// fields of a goal or of gains that a law does not read
#![allow(dead_code)]
// as the law's source has it: a variable before the branches that set it, loops that count, and x = x + y
#![allow(clippy::needless_late_init, clippy::needless_range_loop, clippy::assign_op_pattern)]

/// The law in double precision.
pub mod double {
    /// A number.
    pub type Real = f64;

    include!("NAME.rs");
}

/// The law in single precision.
pub mod single {
    /// A number.
    pub type Real = f32;

    include!("NAME.rs");
}
