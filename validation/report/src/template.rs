//! The templates of the report's pages.

use crate::pages;
use serde::Serialize;

const TEMPLATES: [(&str, &str); 15] = [
    ("head.html", include_str!("template/head.html")),
    ("index.html", include_str!("template/index.html")),
    ("moved.html", include_str!("template/moved.html")),
    ("scatter.html", include_str!("template/scatter.html")),
    ("failures.html", include_str!("template/failures.html")),
    ("gates.html", include_str!("template/gates.html")),
    ("case.html", include_str!("template/case.html")),
    ("controls.html", include_str!("template/controls.html")),
    ("metrics.html", include_str!("template/metrics.html")),
    ("width.html", include_str!("template/width.html")),
    ("coverage.html", include_str!("template/coverage.html")),
    ("comparisons.html", include_str!("template/comparisons.html")),
    ("validated.html", include_str!("template/validated.html")),
    ("print.html", include_str!("template/print.html")),
    ("papers.html", include_str!("template/papers.html")),
];

/// Fills one template.
pub(super) fn fill(name: &str, values: &impl Serialize) -> Result<String, minijinja::Error> {
    pages::fill(&TEMPLATES, name, values)
}
