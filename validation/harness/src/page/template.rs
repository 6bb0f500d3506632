//! Templates: the values of a page → its text.

/// Fills one of the templates, which may include each other and import `figure.html`, a figure with links to its files. A name that ends in `.html` escapes everything that is inserted,
/// except for `style`, the text of all pages' style sheet.
pub fn fill(
    templates: &[(&'static str, &'static str)],
    name: &str,
    page: &impl serde::Serialize,
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
