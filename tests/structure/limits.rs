//! One place for a limit: the metrics of a case, of a family of cases, or of all (`shared`).

use crate::structure::source::sources;

#[test]
fn limits_stand_beside_their_metrics() {
    let mut found = Vec::new();
    for source in sources("validation/cases/src").iter().filter(|source| !source.module.contains(&"metrics".to_owned()))
    {
        let lines = source.code.lines().enumerate();
        let is_limit = |line: &str| ["Limit::", ".gated(", ".gated_by("].iter().any(|mark| line.contains(mark));
        let Some((line, _)) = lines.into_iter().find(|(_, line)| is_limit(line)) else { continue };
        found.push(format!("{}:{}", source.path, line + 1));
    }
    assert!(
        found.is_empty(),
        "a limit stands with its reason and reference in `metrics.rs` or `metrics/QUANTITY.rs` of its case, of the family's folder or of \
         `shared`; move those of\n{}",
        found.join("\n")
    );
}
