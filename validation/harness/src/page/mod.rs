//! Common parts of the pages of reports, judgements, comparisons and calibrations: the style, the templates' filling,
//! and figures that are drawn beside them.

use crate::figure::{self, Figure, FigureError, FigureFormat};
use serde::Serialize;
use std::path::Path;

/// A figure that was drawn, as a page shows it.
#[derive(Debug, Serialize)]
pub struct PageFigure {
    name: String,
    caption: String,
    /// Width and height in pixels, where they are known.
    size: Option<(u32, u32)>,
}

/// Draws figures in a format into a folder. One that cannot be drawn is said in the log and left out: it is no reason to lose the numbers.
///
/// # Errors
/// Files that cannot be written.
pub fn draw<'f>(
    figures: impl IntoIterator<Item = &'f Figure>,
    folder: &Path,
    format: FigureFormat,
) -> Result<Vec<PageFigure>, FigureError> {
    let mut drawn = Vec::new();
    for figure in figures {
        match figure::write(figure, folder, format) {
            Ok(written) => drawn.push(PageFigure {
                name: figure.name.clone(),
                caption: figure.caption.clone(),
                size: figure::size_of(&written),
            }),
            Err(error @ FigureError::Write { .. }) => return Err(error),
            Err(error) => tracing::error!("figure {}: failed to {error}", figure.name),
        }
    }
    Ok(drawn)
}

/// Fills one of the templates, which may include each other and import `figure.html`, a figure with links to its files. A name that ends in `.html` escapes everything that is inserted,
/// except for `style`, the text of all pages' style sheet.
pub fn fill(
    templates: &[(&'static str, &'static str)],
    name: &str,
    page: &impl Serialize,
) -> Result<String, minijinja::Error> {
    let mut environment = minijinja::Environment::new();
    // a name that the values do not have is an error where it is printed
    environment.set_undefined_behavior(minijinja::UndefinedBehavior::SemiStrict);
    environment.add_global("style", include_str!("style.css"));
    environment.add_template("figure.html", include_str!("figure.html"))?;
    for (own, text) in templates {
        environment.add_template(own, text)?;
    }
    // by way of JSON, which has nothing for a number that is not finite
    let page = serde_json::to_value(page)
        .map_err(|error| minijinja::Error::new(minijinja::ErrorKind::InvalidOperation, error.to_string()))?;
    environment.get_template(name)?.render(minijinja::value::Serde(page))
}
