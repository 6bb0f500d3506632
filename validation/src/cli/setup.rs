//! `bagnold show` and `bagnold schema`: parameters of a case, their schema, and a scene as it starts, without a simulation.

use super::arguments::{SchemaArguments, ShowArguments};
use super::error::ProgramError;
use super::terminal::print;
use super::{Exit, Session};
use crate::case::{ParameterError, Request, Tier};
use crate::figure::{FigureError, FigureFormat, render};
use crate::input::nearest;
use crate::output::{FileError, write_whole};
use std::path::Path;

/// Prints the parameters of a case as a file, or a file and settings with all that they leave out; or draws a scene.
pub(super) fn show(show: &ShowArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    match (&show.picture, session.registry.find(&show.case)) {
        (Some(picture), _) => draw(show, picture, session)?,
        (None, Ok(case)) if show.settings.is_empty() => session.say(&case.show(show.tier.unwrap_or(Tier::Quick))),
        (None, _) => session.say(request(show).prepare(session.registry)?.prepared.parameters_toml()),
    }
    Ok(Exit::Held)
}

/// Prints the schema of a case or a kind of file; a case goes before the file of the same name.
pub(super) fn schema(show: &SchemaArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let schema = match (session.registry.find(&show.case), show.case.as_str()) {
        (Ok(case), _) => case.schema(show.tier),
        (Err(_), "study") => crate::study::schema(),
        (Err(_), "calibration") => crate::calibration::schema().clone(),
        (Err(_), "grains") => crate::grains::schema().clone(),
        (Err(_), "sweep") => crate::sweep::schema().clone(),
        (Err(unknown), name) => {
            let kind = nearest(name, ["study", "calibration", "grains", "sweep"]);
            return Err(if kind.is_some() { ParameterError::unknown_case(name, &kind) } else { unknown }.into());
        }
    };
    print(session.output, &format!("{schema:#}\n"));
    Ok(Exit::Held)
}

fn request(show: &ShowArguments) -> Request<'_> {
    Request { target: &show.case, tier: show.tier, settings: &show.settings, ..Request::default() }
}

/// Draws what the runs of a case start from into a file of that name.
fn draw(show: &ShowArguments, picture: &Path, session: &mut Session<'_>) -> Result<(), ProgramError> {
    let refused = |field: &str, value: String, rule: &str, remedy: &str| {
        ProgramError::from(ParameterError::field(field, format!("\"{value}\""), rule, remedy))
    };
    let ending = picture.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    if !["png", "svg"].contains(&ending.as_str()) {
        let rule = "a file name that ends with .png or .svg";
        return Err(refused("--picture", picture.display().to_string(), rule, "write such as --picture setup.png"));
    }
    let prepared = request(show).prepare(session.registry)?.prepared;
    let Some(figure) = prepared.setup() else {
        let rule = "a scene, or the file of one";
        return Err(refused("--picture", show.case.clone(), rule, "leave it out: other cases build their own start"));
    };
    let format = FigureFormat::SCREEN;
    let drawn = render::svg(&figure, format)
        .and_then(|svg| if ending == "png" { render::png(&svg, format) } else { Ok(svg.into_bytes()) });
    let unwritable = |error: &std::io::Error| FileError::unwritable(picture, error);
    let bytes = drawn.map_err(|error: FigureError| unwritable(&std::io::Error::other(error.to_string())))?;
    // a bare name lies where the program is started
    write_whole(&Path::new(".").join(picture), &bytes).map_err(|error| unwritable(&error))?;
    session.say(&format!("{}\nwritten to {}\n", figure.caption, picture.display()));
    Ok(())
}
