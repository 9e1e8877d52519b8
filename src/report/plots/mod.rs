//! Which pictures belong to a report?
