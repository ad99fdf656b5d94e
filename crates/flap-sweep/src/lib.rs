//! Grid files, plans and sweeps.
