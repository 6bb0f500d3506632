//! Templates: the values of a page → its text.

/// All templates. A name that ends in `.html` escapes everything that is inserted.
const TEMPLATES: [(&str, &str); 9] = [
    ("head.html", include_str!("template/head.html")),
    ("index.html", include_str!("template/index.html")),
    ("drift.html", include_str!("template/drift.html")),
    ("scatter.html", include_str!("template/scatter.html")),
    ("gates.html", include_str!("template/gates.html")),
    ("case.html", include_str!("template/case.html")),
    ("metrics.html", include_str!("template/metrics.html")),
    ("width.html", include_str!("template/width.html")),
    ("papers.html", include_str!("template/papers.html")),
];

/// Fills a template, which may include others.
pub(super) fn fill(name: &'static str, page: &impl serde::Serialize) -> Result<String, minijinja::Error> {
    let mut environment = minijinja::Environment::new();
    for (own, text) in TEMPLATES {
        environment.add_template(own, text)?;
    }
    environment.get_template(name)?.render(template_value(page)?)
}

/// The page as the template engine's own value, by way of JSON: the engine is built without serde.
pub(crate) fn template_value(page: &impl serde::Serialize) -> Result<minijinja::Value, minijinja::Error> {
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
