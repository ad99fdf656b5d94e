//! Grid files and plans, end to end.
