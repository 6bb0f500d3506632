//! `bagnold show FILE.toml --picture setup.png`: a scene as it starts, drawn without a simulation.

use super::arguments::ShowArguments;
use super::error::ProgramError;
use super::terminal::say;
use crate::case::{Limits, ParameterError, Registry, Request};
use crate::figure::{FigureError, FigureFormat, render};
use crate::output::{FileError, write_whole};
use std::io::Write;
use std::path::Path;

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
    let request = Request { target: &show.case, tier: show.tier, limits: Limits::default(), ..Request::default() };
    let prepared = request.prepare(registry)?.prepared;
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
