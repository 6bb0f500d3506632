//! Panels of figures as figures of their own: `bagnold run --panel FIGURE:LETTER`.

use crate::case::ParameterError;
use crate::figure::{Figure, Panel, Series};

/// Adds the panels that were asked for, `deposit:b` as `deposit-panel-b`, to the figures that hold them.
///
/// # Errors
/// A panel that no figure has.
pub(super) fn add_panels(figures: &mut Vec<Figure>, wanted: &[String]) -> Result<(), ParameterError> {
    let alone: Vec<(String, Figure)> = figures.iter().flat_map(alone).collect();
    for name in wanted {
        let Some((_, figure)) = alone.iter().find(|(own, _)| own == name) else {
            let titled = |(own, figure): &(String, Figure)| format!("{own} ({})", title(&figure.panels[0]));
            let names: Vec<String> = alone.iter().map(titled).collect();
            let (rule, remedy) = match names[..] {
                [] => ("left out, because each figure has one panel".to_owned(), "leave it out: all figures are drawn"),
                _ => (format!("one of {}", names.join(", ")), "name a panel; figures of one panel are always drawn"),
            };
            return Err(ParameterError::field("--panel", name, &rule, remedy));
        };
        if !figures.iter().any(|other| other.name == figure.name) {
            figures.push(figure.clone());
        }
    }
    Ok(())
}

/// The panels of a figure that has several, each with its name for the option.
fn alone(figure: &Figure) -> Vec<(String, Figure)> {
    let several = Some(&figure.panels).filter(|panels| panels.len() > 1).into_iter().flatten();
    // a curve is often named in one panel only
    let all = || figure.panels.iter().flat_map(|panel| &panel.series);
    let named = |series: &Series| {
        let is_same =
            |other: &&Series| (other.mark, other.colour) == (series.mark, series.colour) && !other.label.is_empty();
        all().find(is_same).map(|other| other.label.clone())
    };
    let of_panel = |(letter, panel): (char, &Panel)| {
        let mut panel = panel.clone();
        for place in 0..panel.series.len() {
            let label = named(&panel.series[place]).unwrap_or_default();
            if panel.series[place].label.is_empty() && panel.series.iter().all(|other| other.label != label) {
                panel.series[place].label = label;
            }
        }
        let caption = format!("Panel ({letter}) of `{}`: {}. {}", figure.name, title(&panel), figure.caption);
        let own = Figure::new(&format!("{}-panel-{letter}", figure.name), &caption, vec![panel]);
        (format!("{}:{letter}", figure.name), own)
    };
    ('a'..='z').zip(several).map(of_panel).collect()
}

/// Title of a panel, such as a time or the name of a gauge, or what its vertical axis shows.
fn title(panel: &Panel) -> &str {
    if panel.title.is_empty() { &panel.y.label } else { &panel.title }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Axis;

    #[test]
    fn a_panel_is_a_figure_of_its_own_and_an_unknown_one_is_refused_with_the_names() {
        let panel = |title: &str| Panel::new(title, Axis::linear("x [m]"), Axis::linear("y [m]"));
        let mut whole = Figure::new("deposit", "Heaps.", vec![panel("low"), panel("high")]);
        for (place, label) in ["sand", ""].into_iter().enumerate() {
            whole.panels[place].line(label, 0, [(0.0, 1.0)]);
            whole.panels[place].line("", 1, [(0.0, 1.0)]);
        }
        let mut figures = vec![whole.clone(), Figure::new("single", "", vec![panel("")])];
        add_panels(&mut figures, &["deposit:b".to_owned(), "deposit:b".to_owned()]).expect("a panel");
        assert_eq!(figures.len(), 3);
        let alone = &figures[2];
        assert_eq!((alone.name.as_str(), alone.panels.len()), ("deposit-panel-b", 1));
        assert_eq!((alone.panels[0].title.as_str(), alone.panels[0].series.len()), ("high", 2));
        assert_eq!(alone.caption, "Panel (b) of `deposit`: high. Heaps.");
        let labels: Vec<&str> = alone.panels[0].series.iter().map(|series| series.label.as_str()).collect();
        assert_eq!(labels, ["sand", ""], "a curve keeps the name that another panel gives it");
        let message = add_panels(&mut figures, &["deposit:c".to_owned()]).expect_err("unknown").to_string();
        assert_eq!(
            message,
            "`--panel` is deposit:c, but must be one of deposit:a (low), deposit:b (high); name a panel; figures of one panel are always drawn"
        );
        let message = add_panels(&mut figures[1..2].to_vec(), &["single:a".to_owned()]).expect_err("one").to_string();
        assert!(message.contains("left out, because each figure has one panel"), "{message}");
    }
}
