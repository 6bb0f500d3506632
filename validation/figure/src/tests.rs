//! Whole figures: what is in the SVG, whether the PNG shows it, and data that must not break anything.

use super::*;
use tiny_skia::Pixmap;

fn axis(label: &str, scale: Scale) -> Axis {
    Axis { label: label.to_owned(), scale, limits: None, ratio: None }
}

fn series(label: &str, mark: Mark, colour: usize, points: &[(f64, f64)]) -> Series {
    Series::new(label, mark, colour, points.to_vec())
}

fn panel(series: Vec<Series>) -> Panel {
    Panel {
        title: String::new(),
        x: axis("u [m/s]", Scale::Linear),
        y: axis("y [m]", Scale::Linear),
        bands: Vec::new(),
        series,
        field: None,
        opposite: None,
    }
}

fn figure(panels: Vec<Panel>) -> Figure {
    Figure { name: "velocity-profile".to_owned(), caption: String::new(), panels, columns: 2 }
}

fn raster(figure: &Figure) -> Pixmap {
    let drawn = render::svg(figure, FigureFormat::SCREEN).expect("SVG");
    Pixmap::decode_png(&render::png(&drawn, FigureFormat::SCREEN).expect("PNG")).expect("a PNG")
}

/// Share of pixels of exactly this colour.
fn share(pixels: &Pixmap, red: u8, green: u8, blue: u8) -> f64 {
    let count = pixels.pixels().iter().filter(|pixel| (pixel.red(), pixel.green(), pixel.blue()) == (red, green, blue));
    count.count() as f64 / pixels.pixels().len() as f64
}

#[test]
fn the_svg_holds_labels_legend_and_escaped_text() {
    let line = series("slope <24°> & \"rough\"", Mark::Line, 0, &[(0.0, 0.0), (1.0, 1.0)]);
    let drawn = render::svg(&figure(vec![panel(vec![line])]), FigureFormat::SCREEN).expect("SVG");
    assert!(drawn.contains("u [m/s]") && drawn.contains("y [m]"));
    assert!(drawn.contains("slope &lt;24°&gt; &amp; &quot;rough&quot;"));
    assert!(!drawn.contains("<24°>"));
    assert!(drawn.contains("width=\"1600\""));
    assert!(!drawn.contains("NaN") && !drawn.contains("inf"));
}

#[test]
fn the_png_is_1600_wide_and_shows_the_curve_in_its_colour_and_the_reference_in_black() {
    let curve = [(0.0, 0.0), (1.0, 1.0)];
    let pixels = raster(&figure(vec![panel(vec![series("", Mark::Line, 0, &curve)])]));
    assert_eq!(pixels.width(), 1600);
    assert!(share(&pixels, 0, 114, 178) > 1e-3, "the curve is missing");
    let without = raster(&figure(vec![panel(vec![series("", Mark::Line, 1, &curve)])]));
    assert_eq!(share(&without, 0, 114, 178), 0.0);
    assert!(share(&without, 213, 94, 0) > 1e-3);
    let reference = raster(&figure(vec![panel(vec![series("", Mark::Reference, 0, &curve)])]));
    assert!(share(&reference, 0, 0, 0) > share(&without, 0, 0, 0) + 1e-3);
    assert!(share(&pixels, 255, 255, 255) > 0.8);
}

#[test]
fn text_is_rasterised_with_the_embedded_font() {
    let mut named = panel(Vec::new());
    named.x.label = "M".repeat(40);
    let with = share(&raster(&figure(vec![named])), 0, 0, 0);
    let without = share(&raster(&figure(vec![panel(Vec::new())])), 0, 0, 0);
    assert!(with > without + 1e-3, "{with} against {without}");
}

#[test]
fn the_same_data_give_the_same_bytes() {
    let make = || render::svg(&figure(vec![field_panel(30), panel(vec![])]), FigureFormat::SCREEN).expect("SVG");
    assert_eq!(make(), make());
    assert_eq!(
        render::png(&make(), FigureFormat::SCREEN).expect("PNG"),
        render::png(&make(), FigureFormat::SCREEN).expect("PNG")
    );
}

fn field_panel(count: usize) -> Panel {
    let points: Vec<(f64, f64)> =
        (0..count * 10).map(|index| ((index % count) as f64 * 0.1, (index / count) as f64 * 0.1)).collect();
    let values = points.iter().map(|&(_, y)| 100.0 * (1.0 - y)).collect();
    let field = Field { points, values, label: "p [Pa]".to_owned(), diameter: 0.1, limits: None };
    Panel { field: Some(field), ..panel(Vec::new()) }
}

/// Centres and radii of the dots of a path of a round pen.
fn dots(line: &str) -> Option<Vec<(f64, f64, f64)>> {
    let (steps, pen) = line.strip_prefix("<path d=\"")?.split_once('"')?;
    let width: f64 = pen.split_once("stroke-width=\"")?.1.split_once('"')?.0.parse().ok()?;
    let mut at = (0.0, 0.0);
    let mut found = Vec::new();
    for step in steps.split("h0").filter(|step| !step.is_empty()) {
        let second = 2 + step[2..].find([' ', '-'])?;
        let (right, down): (f64, f64) = (step[1..second].parse().ok()?, step[second..].trim().parse().ok()?);
        at = if step.starts_with('M') { (right, down) } else { (at.0 + right, at.1 + down) };
        found.push((at.0, at.1, 0.5 * width));
    }
    Some(found)
}

#[test]
fn particles_are_circles_of_their_true_diameter_that_touch() {
    let drawn = render::svg(&figure(vec![field_panel(20)]), FigureFormat::SCREEN).expect("SVG");
    let circles: Vec<(f64, f64, f64)> = drawn.lines().filter_map(dots).flatten().collect();
    assert_eq!(circles.len(), 200);
    let horizontal = circles[1].0 - circles[0].0;
    let vertical = circles[0].1 - circles[20].1;
    assert!((horizontal - vertical).abs() <= 1.0, "unequal scales: {horizontal} and {vertical}");
    assert!((2.0 * circles[0].2 - horizontal).abs() <= 2.0, "diameter {} in {horizontal}", 2.0 * circles[0].2);
}

#[test]
fn two_fields_have_a_bar_each_and_a_field_without_a_label_none() {
    let mut both = field_panel(20);
    let mut pressure = both.field.clone().expect("a field");
    pressure.label = "|v| [m/s]".to_owned();
    both.opposite = Some(pressure);
    let drawn = render::svg(&figure(vec![both.clone()]), FigureFormat::SCREEN).expect("SVG");
    assert!(drawn.contains("p [Pa]") && drawn.contains("|v| [m/s]"));
    for field in both.field.iter_mut().chain(&mut both.opposite) {
        field.label.clear();
    }
    let plain = render::svg(&figure(vec![both]), FigureFormat::SCREEN).expect("SVG");
    assert!(!plain.contains("p [Pa]") && plain.matches("<rect").count() < drawn.matches("<rect").count());
}

#[test]
fn one_scale_of_colours_has_one_bar_and_one_range_one_axis() {
    // a bar, labels of both axes and a number of the horizontal one, of two pictures below each other
    let counts = |alter: fn(&mut Panel)| {
        let mut panels = vec![field_panel(20), field_panel(20)];
        alter(&mut panels[1]);
        let drawn = render::svg(&figure(panels).in_columns(1), FigureFormat::SCREEN).expect("SVG");
        ["p [Pa]", "u [m/s]", "y [m]", "1.2"].map(|text| drawn.matches(&format!(">\n{text}\n<")).count())
    };
    assert_eq!(counts(|_| ()), [1, 1, 2, 1]);
    assert_eq!(counts(|panel| panel.field.as_mut().expect("a field").limits = Some((0.0, 7.0))), [2, 1, 2, 1]);
    assert_eq!(counts(|panel| panel.x.limits = Some((0.0, 1.9))), [1, 2, 2, 2]);
}

#[test]
fn a_legend_under_a_narrow_plot_is_on_the_sheet() {
    let entry = |slot: usize| series(&format!("entry number {slot} of a legend"), Mark::Points, slot, &[(0.0, 1.0)]);
    let narrow = panel((0..6).map(entry).collect());
    let drawn = render::svg(&figure(vec![narrow]), FigureFormat::SMALL).expect("SVG");
    let number = |text: &str| text.split('"').next().and_then(|digits| digits.parse::<f64>().ok()).expect("a number");
    let after = |text: &str, mark: &str| number(text.split(mark).nth(1).expect("an attribute"));
    let height = after(&drawn, "viewBox=\"0 0 2560 ");
    let lowest = drawn.split("<text ").skip(1).map(|text| after(text, " y=\"")).fold(0.0, f64::max);
    assert!(lowest < height, "{lowest} below {height}");
}

#[test]
fn open_marks_are_hollow() {
    let blue = |mark: Mark| share(&raster(&figure(vec![panel(vec![series("", mark, 0, &[(0.5, 0.5)])])])), 0, 114, 178);
    assert!(blue(Mark::OpenPoints) > 0.0 && blue(Mark::OpenPoints) < 0.8 * blue(Mark::Points));
}

#[test]
fn degenerate_data_draw_something() {
    let odd: [&[(f64, f64)]; 7] = [
        &[],
        &[(1.0, 1.0)],
        &[(1.0, 2.0), (1.0, 2.0)],
        &[(f64::NAN, 1.0), (1.0, f64::NAN)],
        &[(f64::INFINITY, 1.0), (f64::NEG_INFINITY, -1.0), (0.0, 0.0)],
        &[(1e300, -1e300), (-1e300, 1e300), (1e-300, 5e-324)],
        &[(-1.0, -1.0), (0.0, 0.0)],
    ];
    for points in odd {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            for mark in [Mark::Line, Mark::Reference, Mark::Points, Mark::LinePoints, Mark::OpenPoints] {
                let mut odd = panel(vec![series("odd", mark, usize::MAX, points)]);
                odd.series[0].error = vec![f64::NAN, -1.0, f64::INFINITY];
                odd.bands
                    .push(Band { label: "band".to_owned(), points: points.iter().map(|&(x, y)| (x, y, -y)).collect() });
                odd.x.scale = scale;
                odd.y.scale = scale;
                odd.x.limits = Some((f64::NAN, 0.0));
                let drawn = render::svg(&figure(vec![odd]), FigureFormat::SCREEN).expect("SVG");
                assert!(!drawn.contains("NaN"));
            }
        }
    }
    for (points, values, diameter) in [
        (vec![], vec![], 0.0),
        (vec![(0.0, 0.0)], vec![1.0], f64::NAN),
        (vec![(0.0, 0.0), (1.0, f64::NAN)], vec![f64::INFINITY], -1.0),
        (vec![(0.0, 0.0), (1e-9, 1e9)], vec![2.0, 2.0], 1e-9),
        (vec![(0.0, 0.0), (1e9, 1e-9)], vec![f64::NAN, f64::NAN], 0.0),
    ] {
        let field = Field { points, values, label: "p [Pa]".to_owned(), diameter, limits: Some((1.0, 1.0)) };
        let drawn = render::svg(&figure(vec![Panel { field: Some(field), ..panel(Vec::new()) }]), FigureFormat::SCREEN)
            .expect("SVG");
        render::png(&drawn, FigureFormat::SCREEN).expect("PNG");
    }
    render::png(&render::svg(&figure(Vec::new()), FigureFormat::SCREEN).expect("SVG"), FigureFormat::SCREEN)
        .expect("PNG");
    let none = Figure { columns: 0, ..figure(vec![panel(Vec::new()); 9]) };
    render::png(&render::svg(&none, FigureFormat::SCREEN).expect("SVG"), FigureFormat::SCREEN).expect("PNG");
}

#[test]
fn files_get_the_figure_s_name_and_a_name_stays_in_its_folder() {
    let folder = tempfile::tempdir().expect("folder");
    let written =
        write(&figure(vec![panel(Vec::new())]), &folder.path().join("figures"), FigureFormat::SCREEN).expect("written");
    assert!(written.ends_with("figures/velocity-profile.png") && written.with_extension("svg").exists());
    assert!(std::fs::read(&written).expect("PNG").starts_with(b"\x89PNG"));
    for name in ["", "../escape", "a/b", ".hidden", "a b"] {
        let named = Figure { name: name.to_owned(), ..figure(Vec::new()) };
        assert!(
            matches!(write(&named, folder.path(), FigureFormat::SCREEN), Err(FigureError::Name { .. })),
            "{name:?}"
        );
    }
}
