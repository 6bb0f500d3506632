//! `bagnold new`: a crate with a law or a case of a user's own, which builds and runs as it is.

mod name;

use super::arguments::{NewArguments, NewCrate};
use super::error::ProgramError;
use super::{Exit, Session};
use crate::case::ParameterError;
use crate::input::FieldError;
use crate::output::FileError;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A file of a crate: its path, and its text with places for the name.
type Template = (&'static str, &'static str);

const LAW: &[Template] = &[
    ("Cargo.toml", include_str!("template/law/Cargo.toml.template")),
    ("src/main.rs", include_str!("template/law/main.rs.template")),
    ("film.toml", include_str!("template/law/film.toml.template")),
    ("mu-i.toml", include_str!("template/law/mu-i.toml.template")),
    ("README.md", include_str!("template/law/README.md.template")),
    (".gitignore", include_str!("template/gitignore.template")),
];

const CASE: &[Template] = &[
    ("Cargo.toml", include_str!("template/case/Cargo.toml.template")),
    ("src/main.rs", include_str!("template/case/main.rs.template")),
    ("case.toml", include_str!("template/case/case.toml.template")),
    ("README.md", include_str!("template/case/README.md.template")),
    (".gitignore", include_str!("template/gitignore.template")),
];

/// Optimisation profile of the crate and its dependencies.
const PROFILE: &str = include_str!("template/profile.template");

/// Writes the crate.
pub(super) fn new(command: &NewArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let (asked, templates) = match &command.what {
        NewCrate::Law(asked) => (asked, LAW),
        NewCrate::Case(asked) => (asked, CASE),
        NewCrate::Scene { .. } => {
            let remedy = "write one with `bagnold show scene > scene.toml` and run it with `bagnold run scene.toml`";
            return Err(ParameterError::from(FieldError::finding("scene", "a scene needs no crate", remedy)).into());
        }
    };
    name::check(&asked.name, &command.what).map_err(ParameterError::from)?;
    let folder = asked.out.clone().unwrap_or_else(|| PathBuf::from(&asked.name));
    let checkout = checkout();
    write(&folder, &asked.name, templates, checkout)?;
    for (path, _) in templates {
        session.say(&format!("{}\n", folder.join(path).display()));
    }
    session.say(&format!("`cargo run -- list` in {} builds it; README.md there has the rest\n", folder.display()));
    if let Some(checkout) = checkout {
        session.say(&format!(
            "it uses the sources in {}; to use others, change the paths in Cargo.toml\n",
            checkout.display()
        ));
    }
    Ok(Exit::Held)
}

/// The checkout that this program was built in, if it is still there.
fn checkout() -> Option<&'static Path> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?;
    ["solver", "validation"].iter().all(|package| root.join(package).join("Cargo.toml").is_file()).then_some(root)
}

fn write(folder: &Path, name: &str, templates: &[Template], checkout: Option<&Path>) -> Result<(), ProgramError> {
    let unwritable = |error: std::io::Error| FileError::unwritable(folder, &error);
    if let Some(parent) = folder.parent() {
        std::fs::create_dir_all(parent).map_err(unwritable)?;
    }
    match std::fs::create_dir(folder) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            let remedy = "name another one with --out, or remove this one";
            return Err(ParameterError::field("--out", folder.display(), "a new folder", remedy).into());
        }
        made => made.map_err(unwritable)?,
    }
    std::fs::create_dir(folder.join("src")).map_err(unwritable)?;
    let dependencies = dependencies(checkout, templates);
    for (path, text) in templates {
        let text = text.replace("{{profile}}\n", PROFILE).replace("{{dependencies}}", &dependencies);
        std::fs::write(folder.join(path), text.replace("{{name}}", name)).map_err(unwritable)?;
    }
    // the versions that this program was built with, so that nothing newer is fetched; Cargo adds the crate itself
    let locked = checkout.map(|root| root.join("Cargo.lock")).filter(|file| file.is_file());
    if let Some(locked) = locked {
        std::fs::copy(locked, folder.join("Cargo.lock")).map_err(unwritable)?;
    }
    Ok(())
}

/// Packages of Bagnold, with their folders.
const PACKAGES: [(&str, &str); 3] =
    [("solver", "solver"), ("harness", "validation/harness"), ("validation", "validation")];

/// The packages of Bagnold that the templates name: in the checkout if there is one, else by this program's version.
fn dependencies(checkout: Option<&Path>, templates: &[Template]) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let is_used = |package: &str| templates.iter().any(|(_, text)| text.contains(&format!("bagnold_{package}::")));
    let line = |(package, folder): (&str, &str)| {
        let source = match checkout {
            // a path is a string with escapes of its own in TOML
            Some(root) => format!("path = {}", toml::Value::from(root.join(folder).display().to_string())),
            None => format!("version = \"={version}\""),
        };
        format!("bagnold-{package} = {{ {source} }}")
    };
    let used = PACKAGES.into_iter().filter(|(package, _)| is_used(package));
    used.map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_filled_and_the_files_of_a_crate_can_be_read() {
        for (templates, checkout) in [(LAW, None), (CASE, None), (LAW, Some(Path::new("/a \"checkout\"")))] {
            let root = tempfile::tempdir().expect("a folder");
            let folder = root.path().join("below/my-own");
            write(&folder, "my-own", templates, checkout).expect("writable");
            for (path, _) in templates {
                let text = std::fs::read_to_string(folder.join(path)).expect("written");
                assert!(!text.contains("{{") && !text.contains("}}"), "{path}: {text}");
                if Path::new(path).extension().is_some_and(|ending| ending == "toml") {
                    toml::from_str::<toml::Table>(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
                }
            }
            let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).expect("written");
            let manifest: toml::Table = toml::from_str(&manifest).expect("readable");
            assert_eq!(manifest["package"]["name"].as_str(), Some("my-own"));
            let solver = &manifest["dependencies"]["bagnold-solver"];
            match checkout {
                Some(root) => assert_eq!(solver["path"].as_str(), root.join("solver").to_str()),
                None => assert_eq!(solver["version"].as_str(), Some(concat!("=", env!("CARGO_PKG_VERSION")))),
            }
        }
    }

    #[test]
    fn a_folder_that_is_there_is_left_as_it_is() {
        let root = tempfile::tempdir().expect("a folder");
        let refused = write(root.path(), "my-own", LAW, None).expect_err("it exists");
        assert!(refused.to_string().contains("but must be a new folder"), "{refused}");
        assert_eq!(std::fs::read_dir(root.path()).expect("readable").count(), 0);
    }
}
