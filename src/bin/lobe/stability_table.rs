//! `lobe stability`: the stability sweeps as tables.

use std::error::Error;
use std::time::Instant;

use clap::Args;

use crate::stability::{Sweep, all};

/// Measures where methods fail, and prints tables; exit code 1 if ours exceeds a stored bound
#[derive(Args)]
pub struct Arguments {
    /// So many times the usual number of trials
    #[arg(default_value_t = 1.0)]
    effort: f64,
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut begun: Vec<Instant> = Vec::new();
    let sweeps = all(arguments.effort, &mut |name| {
        eprintln!("{name}");
        begun.push(Instant::now());
    });
    begun.push(Instant::now());
    let mut broken = 0;
    for (sweep, times) in sweeps.iter().zip(begun.windows(2)) {
        print(sweep);
        println!("  {:.2} s\n", (times[1] - times[0]).as_secs_f64());
        broken += sweep.broken().len();
    }
    println!("{:.1} s in all", (begun[begun.len() - 1] - begun[0]).as_secs_f64());
    if broken > 0 { Err(format!("{broken} bounds are broken").into()) } else { Ok(()) }
}

fn print(sweep: &Sweep) {
    let Sweep { name, title, about, parameter, measure, fails_from, .. } = sweep;
    let scale = if sweep.log_parameter { "log" } else { "linear" };
    println!(
        "== {name}: {title}\n  {about}\n  {measure} by {parameter} ({scale}), fails from {fails_from}"
    );
    let names: Vec<_> = sweep.methods.iter().map(|m| m.name).collect();
    println!("  parameter,{},bound", names.join(","));
    for (i, parameter) in sweep.parameters.iter().enumerate() {
        print!("  {parameter:.4e}");
        sweep.methods.iter().for_each(|m| print!(",{:.3e}", m.values[i]));
        println!(",{:.1e}", sweep.bounds[i]);
    }
    println!("  won: {:?}\n  broken: {:?}", sweep.won(), sweep.broken());
}
