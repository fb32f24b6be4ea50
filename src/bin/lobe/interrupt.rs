//! Ctrl-C, SIGTERM and a closed terminal: the first asks for an end, the second ends at once.

use std::io;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

/// Exit code of an interrupted command: 128 and the number of SIGINT, as shells have it.
const CODE: u8 = 130;

/// Exit code of a command that ended early because it was asked to.
pub fn exit_code() -> ExitCode {
    CODE.into()
}

/// From now on, the first signal sets the flag, and any further one ends the process.
pub fn listen() -> io::Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM, SIGHUP] {
        // In this order: the shutdown looks at the flag as it was before the signal.
        register_conditional_shutdown(signal, CODE.into(), flag.clone())?;
        register(signal, flag.clone())?;
    }
    Ok(flag)
}
