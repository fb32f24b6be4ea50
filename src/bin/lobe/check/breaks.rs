//! `lobe check --break`: lobes that are wrong on purpose.

use std::error::Error;
use std::process::ExitCode;

use lobe::check::{Options, check, faulty};

use super::parallel::map;
use crate::steps::Steps;
use crate::summary::print;

/// Prints what was planted and what was found. Exit code 1 if a fault was not.
pub fn run(options: &Options, threads: usize) -> Result<ExitCode, Box<dyn Error>> {
    let all = faulty();
    let steps = Steps::new(all.len() as f64, 0.0, false);
    steps.begin("checking".into());
    let reports =
        map(all.len(), threads, &|| steps.done(1.0), &|index| check(&*all[index].lobe, options));
    steps.clear();
    let (mut text, mut missed) = (String::new(), 0);
    for (faulty, report) in all.iter().zip(&reports) {
        let found: Vec<_> = report.findings.iter().map(|finding| finding.contract).collect();
        let is_named = faulty.expected.iter().all(|contract| found.contains(contract));
        missed += usize::from(!is_named);
        let word = if is_named { "named" } else { "missed" };
        let found: Vec<_> = found.iter().map(|contract| contract.name()).collect();
        let found = if found.is_empty() { "nothing".into() } else { found.join(", ") };
        text += &format!("{word:6}  planted: {}; found: {found}\n", faulty.name);
    }
    text +=
        &format!("total   {} planted, {} named, {missed} missed\n", all.len(), all.len() - missed);
    print(&text)?;
    Ok(if missed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
