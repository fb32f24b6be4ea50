//! What holds for any text that is read as a line of `runs.csv`: an error of one line, or a run that is printed as it is read.

use lobe::metrics::convergence::Run;

pub fn run(bytes: &[u8]) {
    let Ok(line) = std::str::from_utf8(bytes) else { return };
    match line.parse::<Run>() {
        Ok(run) => {
            assert!(run.spp > 0 && run.mean.is_finite());
            let numbers = [run.set_up, run.seconds, run.rel_mse, run.mse];
            assert!(numbers.iter().all(|number| number.is_finite() && *number >= 0.0));
            assert_eq!(run.to_string().parse(), Ok(run));
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.starts_with('`') && message.chars().count() < 3000, "{message}");
            assert!(!message.contains('\n'), "{message}");
        }
    }
}
