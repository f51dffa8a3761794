//! The `laneweave` command: what its program does, and what other programs that bring it along do.

mod command;

use std::ffi::OsString;
use std::time::Instant;

use clap::error::Error;
use command::{Call, Cli, SUCCESS, complain, refuse_large_files, say, with_tip};
use laneweave::{Fault, FaultKind};

/// Exit code for a mistake in the input, the same as for a wrong option.
const MISTAKE: u8 = 2;
/// Exit code for a standard output that cannot be written.
const UNWRITTEN: u8 = 1;

/// Does what the command line `arguments` asks for, and returns the exit code. The first argument is the name of the
/// program. Signals end a command as they end the program, from its first call on. `program` is how another process of
/// the same command begins: a program, and its first arguments.
pub fn command(arguments: &[OsString], program: Vec<OsString>) -> u8 {
    let call = Call::new(Instant::now(), arguments, program);
    refuse_large_files();
    let done = Cli::read(arguments).map_or_else(|error| help(error, arguments), |cli| cli.execute(&call));
    done.unwrap_or_else(|fault| {
        // A reader that closes standard output, such as `head`, is no error.
        if fault.kind != FaultKind::Closed {
            complain(format_args!("error: {fault}"));
        }
        match fault.kind {
            FaultKind::Output | FaultKind::Closed => UNWRITTEN,
            _ => MISTAKE,
        }
    })
}

/// Prints a help text or the version, or what is wrong with a command line.
fn help(error: Error, arguments: &[OsString]) -> Result<u8, Fault> {
    if error.use_stderr() {
        // Where standard error is closed, nobody wants to know.
        let _ = with_tip(error, arguments).print();
        return Ok(MISTAKE);
    }
    say(&error.render().to_string()).map(|()| SUCCESS)
}
