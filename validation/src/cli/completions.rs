//! `bagnold completions`: what shells and `man` want to know of the program.

use super::arguments::{Arguments, CompletionsArguments};
use super::{Exit, Session};
use crate::case::Registry;
use clap::builder::PossibleValuesParser;
use clap::{Arg, Command, CommandFactory};
use clap_complete::{Shell, generate};

/// Prints a shell's completions, or the manual page with all commands.
pub(super) fn completions(command: &CompletionsArguments, session: &mut Session<'_>) -> Exit {
    let mut text = Vec::new();
    match command.of.parse::<Shell>() {
        Ok(shell) => generate(shell, &mut with_cases(Arguments::command(), session.registry), "bagnold", &mut text),
        Err(_) => text = manual(Arguments::command()),
    }
    session.say(&String::from_utf8_lossy(&text));
    Exit::Held
}

/// The program with the names of cases as values of the arguments that name one; files complete beside them.
fn with_cases(program: Command, registry: Registry) -> Command {
    let names: Vec<&'static str> = registry.iter().map(|case| case.name()).collect();
    let is_case = |argument: &Arg| {
        let of = argument.get_value_names().unwrap_or_default();
        of.iter().any(|name| name.split('|').any(|part| part == "CASE"))
    };
    program.mut_subcommands(|command| {
        command.mut_args(|argument| {
            if is_case(&argument) { argument.value_parser(PossibleValuesParser::new(names.clone())) } else { argument }
        })
    })
}

/// The manual page: sections of the program, and the help of each command as one more section.
fn manual(mut program: Command) -> Vec<u8> {
    program.build();
    let (page, mut text) = (clap_mangen::Man::new(program.clone()), Vec::new());
    let sections = [
        clap_mangen::Man::render_title,
        clap_mangen::Man::render_name_section,
        clap_mangen::Man::render_synopsis_section,
        clap_mangen::Man::render_options_section,
    ];
    for section in sections {
        section(&page, &mut text).expect("a vector takes all that is written");
    }
    for command in program.get_subcommands_mut() {
        let help = command.render_long_help().to_string().replace('\\', "\\e").replace('-', "\\-");
        // a point or an apostrophe at the start of a line would be a request
        let lines = help.lines().map(|line| format!("\\&{line}\n"));
        let head = format!(".SH \"bagnold {}\"\n.nf\n", command.get_name());
        text.extend([head, lines.collect(), ".fi\n".to_owned()].concat().into_bytes());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_completed_and_in_the_manual() {
        for of in ["bash", "zsh", "fish", "man"] {
            let mut output = Vec::new();
            let mut session = Session { registry: *crate::REGISTRY, quiet: true, output: &mut output };
            completions(&CompletionsArguments { of: of.to_owned() }, &mut session);
            let text = String::from_utf8(output).expect("text");
            for command in Arguments::command().get_subcommands() {
                assert!(text.contains(command.get_name()), "{of}: {}", command.get_name());
            }
            let has_part = if of == "man" { "Change one parameter" } else { "water\\-column" };
            assert!(text.replace("water-column", "water\\-column").contains(has_part), "{of}");
            assert!(!text.contains("bagnold\\-run(1)"), "{of} names a page that does not exist");
        }
    }
}
