//! The program `bagnold`.

fn main() -> std::process::ExitCode {
    bagnold_validation::cli::main()
}
