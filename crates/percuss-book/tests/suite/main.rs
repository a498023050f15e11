//! What the book promises of itself.

mod scenario;
