//! How much of a long list a reader sees: one place for terminal, pages, summary text and studies. Files always have all of it.

/// Rows of a table of a page.
pub const ROWS: usize = 200;

/// Rows of the log of contacts, impacts and failures of a page.
pub const EVENTS: usize = 40;

/// Findings, formulas, faults and failed runs, one by one.
pub const FINDINGS: usize = 50;

/// Recorded points, supports and limit points with a figure each.
pub const FIGURES: usize = 24;

/// Beams, contacts and discs with figures each, and panels of an overview.
pub const LARGE_FIGURES: usize = 12;

/// Lines of a list in the terminal that is the answer itself.
pub const LINES: usize = 20;

/// Lines of a list in the terminal among others: supports, hand formulas.
pub const BRIEF: usize = 6;

/// Entries beside an answer: impacts of a contact, reasons, warnings above a picture.
pub const FEW: usize = 3;

/// Names in a sentence.
pub const NAMES: usize = 6;
