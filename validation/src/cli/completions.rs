//! `bagnold completions`: what shells and `man` want to know of the program.

use super::arguments::{Arguments, CompletionsArguments, CompletionsOf};
use super::{Exit, say};
use clap::CommandFactory;
use clap_complete::{Shell, generate};
use std::io::Write;

/// Prints a shell's completions, or the manual page.
pub(super) fn completions(command: &CompletionsArguments, output: &mut (dyn Write + Send)) -> Exit {
    let mut program = Arguments::command();
    let mut text = Vec::new();
    let shell = match command.of {
        CompletionsOf::Bash => Some(Shell::Bash),
        CompletionsOf::Zsh => Some(Shell::Zsh),
        CompletionsOf::Fish => Some(Shell::Fish),
        CompletionsOf::Man => None,
    };
    match shell {
        Some(shell) => generate(shell, &mut program, "bagnold", &mut text),
        None => clap_mangen::Man::new(program).render(&mut text).expect("a vector takes all that is written"),
    }
    say(output, &String::from_utf8_lossy(&text));
    Exit::Held
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_completed_and_in_the_manual() {
        for of in [CompletionsOf::Bash, CompletionsOf::Zsh, CompletionsOf::Fish, CompletionsOf::Man] {
            let mut output = Vec::new();
            completions(&CompletionsArguments { of }, &mut output);
            let text = String::from_utf8(output).expect("text");
            for command in Arguments::command().get_subcommands() {
                assert!(text.contains(command.get_name()), "{of:?}: {}", command.get_name());
            }
        }
    }
}
