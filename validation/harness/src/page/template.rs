//! Templates: the values of a page → its text.

/// Fills one of some templates, which may include each other and import `figure.html`, a figure with links to its files. A name that ends in `.html` escapes everything that is inserted,
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
    environment.get_template(name)?.render(template_value(page)?)
}

/// The page as the template engine's own value, by way of JSON: the engine is built without serde.
fn template_value(page: &impl serde::Serialize) -> Result<minijinja::Value, minijinja::Error> {
    use minijinja::{Error, ErrorKind, Value};
    use serde_json::Value as Json;
    fn convert(json: Json) -> Value {
        match json {
            Json::Null => Value::from(()),
            Json::Bool(flag) => Value::from(flag),
            Json::Number(number) => number.as_u64().map_or_else(|| Value::from(number.as_f64()), Value::from),
            Json::String(text) => Value::from(text),
            Json::Array(items) => Value::from(items.into_iter().map(convert).collect::<Vec<Value>>()),
            Json::Object(fields) => Value::from_pairs(fields.into_iter().map(|(key, value)| (key, convert(value)))),
        }
    }
    let json =
        serde_json::to_value(page).map_err(|error| Error::new(ErrorKind::InvalidOperation, error.to_string()))?;
    Ok(convert(json))
}
