use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use super::{Cgaft, CliError, terminal};

#[derive(Args, Debug)]
pub struct Arguments {
    pub shell: Shell,
}

/// `cgaft completions SHELL`
pub fn completions(arguments: &Arguments) -> Result<u8, CliError> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut Cgaft::command(), "cgaft", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(0)
}
