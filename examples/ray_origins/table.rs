//! The counts as comma-separated values.

use std::fmt::Write;

use crate::measure::{Failure, Row};

/// A line for each row; the gap, relative to the scale, is empty for self-hits.
pub fn csv(rows: &[Row]) -> String {
    let mut text =
        String::from("failure,gap,scale,distance,method,trials,failures,failures_plain_test\n");
    for row in rows {
        let (failure, gap) = match row.failure {
            Failure::SelfHit => ("self-hit", String::new()),
            Failure::LostContact(gap) => ("lost-contact", format!("{gap:e}")),
        };
        let (scale, distance) = (row.place.scale, row.place.distance);
        let (method, trials, [bounded, plain]) = (row.method.name(), row.trials, row.failures);
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "{failure},{gap},{scale:e},{distance:e},{method},{trials},{bounded},{plain}"
        );
    }
    text
}
