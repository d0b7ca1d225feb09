//! Numbers on the command line.

use std::ffi::OsStr;

use clap::builder::TypedValueParser;
use clap::error::{Error, ErrorKind};
use clap::{Arg, Command};

/// Reads a whole number of a range.
#[derive(Clone, Copy, Debug)]
pub struct Whole {
    pub least: u32,
    pub most: u32,
}

impl TypedValueParser for Whole {
    type Value = u32;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<u32, Error> {
        let Self { least, most } = *self;
        let number = value.to_str().and_then(|text| text.parse().ok());
        number.filter(|number| (least..=most).contains(number)).ok_or_else(|| {
            let name = argument.and_then(Arg::get_long).unwrap_or_default();
            let reason = format!(
                "--{name} is {}, but must be a whole number from {least} to {most}",
                value.to_string_lossy()
            );
            Error::raw(ErrorKind::ValueValidation, reason).with_cmd(command)
        })
    }
}
