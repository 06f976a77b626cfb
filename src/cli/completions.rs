use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use super::{Cgaft, CliError, solve, terminal};

#[derive(Args, Debug)]
pub struct Arguments {
    pub shell: Shell,
}

/// `cgaft completions SHELL`: those of both programs.
pub fn completions(arguments: &Arguments) -> Result<u8, CliError> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut Cgaft::command(), "cgaft", &mut script);
    generate(arguments.shell, &mut solve::command(), "cgaft-solve", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(0)
}
