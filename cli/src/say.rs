//! Lines on standard output that may fail.

use std::fmt::Arguments;
use std::io::{self, Write};

use anyhow::Context;

/// Writes a line to standard output; that its reader has seen enough is no error.
pub fn line(text: Arguments) -> anyhow::Result<()> {
    match writeln!(io::stdout(), "{text}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to standard output")
        }
        _ => Ok(()),
    }
}

/// `println!` that returns from the function with an error where there is no room, instead of a panic.
macro_rules! say {
    ($($text:tt)*) => { $crate::say::line(format_args!($($text)*))? };
}

pub(crate) use say;
