//! The program as a user meets it: messages, exit codes, files.

mod bad;
mod bad_input;
mod bad_parameters;
mod calibrate;
mod exit_codes;
mod files;
mod installed;
mod interrupted;
mod judge;
mod killed;
mod long;
mod mutate;
mod nonlocal;
mod overlay;
mod own_crate;
mod permission;
mod program;
mod published;
mod restart;
mod scene;
mod simultaneous;
mod states;
mod study;
mod sweep;
mod terminal;
mod vanished;
