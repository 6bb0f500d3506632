//! `bagnold show FILE.toml --picture setup.png`: a scene as it starts, drawn without a simulation.

use super::arguments::ShowArguments;
use super::error::ProgramError;
use super::terminal::say;
use crate::case::{ParameterError, Registry, Request, Tier};
use crate::figure::{FigureError, FigureFormat, render};
use crate::output::{FileError, write_whole};
use std::io::Write;
use std::path::Path;

/// The parameters of a case as a file, or a file and settings with all that they leave out.
///
/// # Errors
/// An unknown case, or parameters that the case refuses.
pub(super) fn show(show: &ShowArguments, registry: Registry) -> Result<String, ParameterError> {
    match registry.find(&show.case) {
        Ok(case) if show.settings.is_empty() => Ok(case.show(show.tier.unwrap_or(Tier::Quick))),
        _ => Ok(request(show).prepare(registry)?.prepared.parameters_toml().to_owned()),
    }
}

fn request(show: &ShowArguments) -> Request<'_> {
    Request { target: &show.case, tier: show.tier, settings: &show.settings, ..Request::default() }
}

/// Draws what the runs of a case start from into a file of that name.
///
/// # Errors
/// Parameters that the case refuses, a case that draws nothing, a file of another kind, or one that cannot be written.
pub(super) fn draw(
    show: &ShowArguments,
    picture: &Path,
    registry: Registry,
    output: &mut (dyn Write + Send),
) -> Result<(), ProgramError> {
    let refused = |field: &str, value: String, rule: &str, remedy: &str| {
        ProgramError::from(ParameterError::field(field, format!("\"{value}\""), rule, remedy))
    };
    let ending = picture.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    if !["png", "svg"].contains(&ending.as_str()) {
        let rule = "a file name that ends with .png or .svg";
        return Err(refused("--picture", picture.display().to_string(), rule, "such as --picture setup.png"));
    }
    let prepared = request(show).prepare(registry)?.prepared;
    let Some(figure) = prepared.setup() else {
        let rule = "a scene, or the file of one";
        return Err(refused("--picture", show.case.clone(), rule, "other cases make their starts themselves"));
    };
    let format = FigureFormat::SCREEN;
    let drawn = render::svg(&figure, format)
        .and_then(|svg| if ending == "png" { render::png(&svg, format) } else { Ok(svg.into_bytes()) });
    let unwritable = |error: &std::io::Error| FileError::unwritable(picture, error);
    let bytes = drawn.map_err(|error: FigureError| unwritable(&std::io::Error::other(error.to_string())))?;
    // a bare name lies where the program is started
    write_whole(&Path::new(".").join(picture), &bytes).map_err(|error| unwritable(&error))?;
    say(output, &format!("{}\nwritten to {}\n", figure.caption, picture.display()));
    Ok(())
}
