//! The program `bagnold-dev`.

fn main() -> std::process::ExitCode {
    bagnold_dev::main()
}
