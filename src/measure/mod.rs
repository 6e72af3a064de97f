//! Speed against accuracy, and where methods fail: measured against certified truth.
//!
//! [`plain`] holds the thesis's formulas in machine doubles; [`stability`] maps the digits that each loses;
//! [`accuracy`] times the certified methods. What is measured here is drawn in [`report::survey`](crate::report::survey).

pub mod accuracy;
pub mod instructions;
pub mod plain;
pub mod stability;
