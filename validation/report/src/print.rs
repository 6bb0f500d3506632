//! All pages of a report as one, to be printed or saved as PDF by a browser.

use super::template::fill;
use serde::Serialize;

/// Parts of a page for the screen alone, from beginning to end of each.
const FOR_THE_SCREEN: [(&str, &str); 5] = [
    ("<script", "</script>"),
    ("<nav", "</nav>"),
    ("<p class=\"jumps\">", "</p>"),
    ("<a class=\"skip\"", "</a>"),
    ("<form", "</form>"),
];

/// A page with the name by which links of the others find it, such as `papers` or `case-film`.
#[derive(Serialize)]
pub(super) struct Chapter {
    name: String,
    body: String,
}

impl Chapter {
    /// Printable part of a finished page.
    pub(super) fn of(name: impl Into<String>, page: &str) -> Self {
        Self { name: name.into(), body: relinked(&for_paper(between(page, "<body>", "</body>"))) }
    }
}

/// The pages one after the other, each beginning on a sheet of its own, with links that stay among them.
pub(super) fn render(title: &str, chapters: &[Chapter]) -> Result<String, minijinja::Error> {
    fill("print.html", &serde_json::json!({ "title": title, "chapters": chapters }))
}

fn between<'t>(text: &'t str, start: &str, end: &str) -> &'t str {
    let from = text.find(start).map_or(0, |place| place + start.len());
    let to = text.rfind(end).unwrap_or(text.len()).max(from);
    &text[from..to]
}

/// Without what only a screen has, and with nothing folded.
fn for_paper(body: &str) -> String {
    let mut text = body.replace("<details>", "<details open>");
    for (start, end) in FOR_THE_SCREEN {
        while let Some(from) = text.find(start) {
            let length = text[from..].find(end).map_or(text.len() - from, |place| place + end.len());
            text.replace_range(from..from + length, "");
        }
    }
    text
}

/// With links between the pages as links within one, and files found from its folder.
fn relinked(body: &str) -> String {
    let mut text = String::with_capacity(body.len());
    let mut rest = body;
    while let Some(place) = rest.find("href=\"") {
        let (before, link) = rest.split_at(place + "href=\"".len());
        let end = link.find('"').unwrap_or(link.len());
        text += before;
        text += &target(&link[..end]);
        rest = &link[end..];
    }
    (text + rest).replace("src=\"../../", "src=\"")
}

fn target(link: &str) -> String {
    let link = link.trim_start_matches("../");
    let (page, anchor) = link.split_once('#').unwrap_or((link, ""));
    let own = match page.strip_suffix(".html") {
        None if page.is_empty() => return format!("#{anchor}"),
        None => return link.to_owned(),
        Some(own) => own,
    };
    if !anchor.is_empty() {
        return format!("#{anchor}");
    }
    let case = own.strip_prefix("cases/").and_then(|case| case.strip_suffix("/index"));
    case.map_or_else(|| format!("#{own}"), |case| format!("#case-{case}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_stay_within_the_page_and_files_are_found() {
        for (link, expected) in [
            ("../../index.html", "#index"),
            ("index.html#gates", "#gates"),
            ("cases/film/index.html#metric-film-velocity_l2-", "#metric-film-velocity_l2-"),
            ("cases/film/index.html", "#case-film"),
            ("papers.html", "#papers"),
            ("../../figures/film/profile.svg", "figures/film/profile.svg"),
            ("#verdicts", "#verdicts"),
            ("metrics.json", "metrics.json"),
        ] {
            assert_eq!(target(link), expected, "{link}");
        }
    }

    #[test]
    fn a_chapter_has_what_paper_can_show() {
        let page = "<html><head><title>x</title></head><body>\n<a class=\"skip\" href=\"#x\">skip</a><nav>a</nav><p>kept</p>\
                    <img src=\"../../figures/a.png\"><p class=\"jumps\">b</p><details>d</details><script>c</script></body></html>";
        let text = render("A <report>", &[Chapter::of("index", page), Chapter::of("case-film", page)]).expect("filled");
        assert_eq!((text.matches("<p>kept</p>").count(), text.matches("src=\"figures/a.png\"").count()), (2, 2));
        for gone in ["skip", "<details>", "<nav", "jumps", "<script", "<title>x"] {
            assert!(!between(&text, "<body>", "</body>").contains(gone), "{gone}");
        }
        assert!(text.contains("<title>A &lt;report&gt;: all pages</title>") && text.contains("id=\"case-film\""));
    }
}
