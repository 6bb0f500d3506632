//! A finished report in a browser. Needs chromium and chromedriver, and a report: `cargo run -- report` first.
//!
//! It stands apart from the other tests, which need no browser; `.ci/run` runs it.

mod driver;
mod pages;

use driver::Browser;
use fantoccini::wd::PrintConfiguration;
use pages::{address, addresses, folder};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Largest number of repeated requests for a document that the driver did not get in its time.
const PRINTING_RETRIES: u32 = 5;
/// Height of the overview on a laptop `[px]`.
const HIGHEST: u64 = 10_000;
/// Height of a case's page `[px]`.
const HIGHEST_CASE: u64 = 12_000;
/// Size of a report of the quick tier `[B]`.
const LARGEST: u64 = 120_000_000;
/// Pages that an overview of two dozen cases may take on paper.
const MOST_PRINTED: usize = 24;

/// The texts of a list.
fn list(value: &Value) -> Vec<String> {
    value.as_array().into_iter().flatten().filter_map(|text| text.as_str().map(str::to_owned)).collect()
}

#[tokio::test]
async fn no_page_complains_and_every_picture_comes_in_its_size() {
    let browser = Browser::open(1280, 720).await;
    let mut pictures = 0;
    for page in addresses() {
        browser.client.goto(&page).await.expect(&page);
        let answer = browser.wait_for(include_str!("scripts/pictures.js"), Vec::new()).await;
        pictures += answer[0].as_u64().unwrap_or(0);
        assert_eq!(list(&answer[1]), [""; 0], "{page}");
        assert_eq!(browser.console().await, [""; 0], "{page}");
    }
    assert!(pictures > 10, "{pictures} pictures");
}

#[tokio::test]
async fn every_link_lands_where_it_says() {
    let browser = Browser::open(1280, 720).await;
    let pages = addresses();
    let mut places: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for page in &pages {
        browser.client.goto(page).await.expect(page);
        let links = browser.ask("return [...new Set([...document.links].map((link) => link.href))]").await;
        for link in list(&links) {
            let (file, place) = link.split_once('#').unwrap_or((&link, ""));
            let path = url::Url::parse(file).ok().and_then(|file| file.to_file_path().ok());
            assert!(path.is_some_and(|path| path.is_file()), "{page} leads to {link}");
            if !place.is_empty() {
                places.entry(file.to_owned()).or_default().insert(place.to_owned());
            }
        }
    }
    let script = include_str!("scripts/landing.js");
    for (page, places) in &places {
        assert!(pages.contains(page), "{page} is no page");
        // first as a link of another page does, with pictures that have not come yet: the farthest place of all
        let last = places.iter().rfind(|place| place.starts_with("figure-")).or(places.last());
        browser.client.goto("about:blank").await.expect("an empty page");
        browser.client.goto(&format!("{page}#{}", last.map_or("", String::as_str))).await.expect(page);
        tokio::time::sleep(std::time::Duration::from_millis(150)).await;
        let at_once = "const box = document.querySelector(':target').getBoundingClientRect();\
                       return box.top >= -1 && box.top < innerHeight";
        assert_eq!(browser.ask(at_once).await, json!(true), "{page}#{last:?} from another page");
        let lost = browser.wait_for(script, vec![json!(places)]).await;
        assert_eq!(list(&lost), [""; 0], "{page}");
    }
    let number: usize = places.values().map(BTreeSet::len).sum();
    assert!(number > 50, "{number} places");
}

/// Rows of the table of gates that are shown: verdict, case and relative margin.
async fn shown(browser: &Browser) -> Vec<(String, String, Option<f64>)> {
    let script = "return [...document.querySelectorAll('#gates-table > tbody:not([hidden])')].map((row) => \
                  [row.querySelector('.verdict').textContent.trim(), row.querySelector('td.case').textContent, row.dataset.margin])";
    let rows = browser.ask(script).await;
    let row = |row: &Value| {
        let text = |place: usize| row[place].as_str().unwrap_or_default().to_owned();
        (text(0), text(1), text(2).parse().ok())
    };
    rows.as_array().expect("rows").iter().map(row).collect()
}

/// Puts a value into a field of the first filter, as a user does.
async fn choose(browser: &Browser, field: &str, value: &str) {
    let script = format!(
        "const field = document.querySelector('form.filter [name={field}]'); field.value = {value:?};\
         for (const name of ['input', 'change']) field.dispatchEvent(new Event(name, {{ bubbles: true }}))"
    );
    browser.ask(&script).await;
}

#[tokio::test]
async fn filters_and_sorting_do_what_they_say() {
    let browser = Browser::open(1280, 720).await;
    browser.client.goto(&address(&folder().join("gates.html"))).await.expect("the gates");
    let all = shown(&browser).await;
    assert!(all.len() > 10, "{} gates", all.len());

    let case = all[all.len() / 2].1.clone();
    choose(&browser, "search", &case).await;
    let found = shown(&browser).await;
    assert!(!found.is_empty() && found.len() <= all.len());
    choose(&browser, "search", "no such thing").await;
    assert!(shown(&browser).await.is_empty());
    let header = browser.ask("return document.querySelector('#gates-table thead').checkVisibility()").await;
    assert_eq!(header, json!(false), "no header without a row");
    choose(&browser, "search", "").await;
    choose(&browser, "case", &case).await;
    let expected = all.iter().filter(|row| row.1 == case).count();
    assert_eq!(shown(&browser).await.len(), expected);
    choose(&browser, "case", "").await;

    choose(&browser, "sort", "6").await;
    let sorted = shown(&browser).await;
    assert_eq!(sorted.len(), all.len(), "sorting loses no row");
    let numbers: Vec<f64> = sorted.iter().filter_map(|row| row.2).collect();
    assert!(numbers.windows(2).all(|pair| pair[0] <= pair[1]), "smallest margin first");
    let head = browser.client.find(fantoccini::Locator::Css("#gates-table th[data-key=margin] button")).await;
    head.expect("a head that sorts").send_keys("\u{e007}").await.expect("it takes the enter key");
    let turned: Vec<f64> = shown(&browser).await.iter().filter_map(|row| row.2).collect();
    assert!(turned.windows(2).all(|pair| pair[0] >= pair[1]), "once more, the largest");
}

#[tokio::test]
async fn a_key_leads_to_the_search_and_another_away() {
    let browser = Browser::open(1280, 720).await;
    let focused = "return document.activeElement.name === 'search'";
    for page in addresses() {
        browser.client.goto(&page).await.expect(&page);
        if browser.ask("return document.querySelector('form.filter:not([hidden])') === null").await == json!(true) {
            continue;
        }
        let body = browser.client.find(fantoccini::Locator::Css("body")).await.expect("a body");
        body.send_keys("/").await.expect("a key");
        assert_eq!(browser.ask(focused).await, json!(true), "{page}");
        let search = browser.client.active_element().await.expect("the search");
        search.send_keys("zzz\u{e00c}").await.expect("keys");
        assert_eq!(browser.ask(focused).await, json!(false), "{page}");
        assert_eq!(browser.ask("return document.querySelector('[name=search]').value").await, json!(""), "{page}");
    }
}

#[tokio::test]
async fn nothing_overflows_on_a_phone_or_a_laptop() {
    let browser = Browser::open(390, 844).await;
    for page in addresses() {
        browser.client.goto(&page).await.expect(&page);
        for (width, height) in [(1280, 720), (390, 844)] {
            browser.of_size(width, height).await;
            let answer = browser.ask(include_str!("scripts/overflow.js")).await;
            assert_eq!(answer[0], json!(width), "{page}");
            assert_eq!(list(&answer[1]), [""; 0], "{page} on {width} px");
        }
    }
}

#[tokio::test]
async fn the_overview_opens_with_the_four_flows() {
    let browser = Browser::open(1280, 720).await;
    browser.client.goto(&address(&folder().join("index.html"))).await.expect("the overview");
    let script = "return [...document.querySelectorAll('.banner, .counts, .flow img')].map((part) => part.getBoundingClientRect().bottom)";
    let bottoms = browser.ask(script).await;
    let bottoms: Vec<f64> = bottoms.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
    assert_eq!(bottoms.len(), 6, "the verdict, the gates by kind and four figures");
    assert!(bottoms.iter().all(|bottom| *bottom > 0.0 && *bottom <= 720.0), "{bottoms:?} px");
    let order = "const at = (part) => document.querySelector(part).getBoundingClientRect().top;\
                 return at('.banner') < at('.counts') && at('.counts') < at('.flows') && at('.flows') < at('.attention') \
                 && at('.attention') < at('table.cases')";
    assert_eq!(browser.ask(order).await, json!(true), "the change, the physics, flows, failures, then cases");
    let height = browser.ask("return document.documentElement.scrollHeight").await;
    assert!(height.as_u64().is_some_and(|height| height <= HIGHEST), "{height} px");
}

#[tokio::test]
async fn readme_page_and_numbers_have_one_tally() {
    let read = |path: &std::path::Path| std::fs::read_to_string(path).expect("a file");
    let numbers: Value = serde_json::from_str(&read(&folder().join("metrics.json"))).expect("JSON");
    let readme = read(std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md")));
    let browser = Browser::open(1280, 720).await;
    browser.client.goto(&address(&folder().join("index.html"))).await.expect("the overview");
    let cards =
        list(&browser.ask("return [...document.querySelectorAll('.count')].map((own) => own.textContent)").await);
    for (kind, counts) in numbers["gates"].as_object().expect("kinds") {
        let of = |word: &str| counts[word].as_u64().expect("a number");
        let words = ["pass", "inconclusive", "expected failure"].map(of);
        let [pass, inconclusive, expected] = words;
        let named = if kind == "all" { format!("all {}", words.iter().sum::<u64>()) } else { kind.clone() };
        let row = format!("| {named} | {pass} | {inconclusive} | {expected} |");
        assert!(readme.contains(&row), "README.md needs the row {row}");
        let card = cards.iter().find(|card| card.contains(kind.as_str()));
        assert!(kind == "all" || card.is_some_and(|card| card.contains(&format!("{pass} pass"))), "{kind}: {cards:?}");
    }
}

/// Files below a folder by their paths from it.
fn files(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let (mut found, mut open) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(here) = open.pop() {
        for path in std::fs::read_dir(here).expect("a folder").flatten().map(|entry| entry.path()) {
            if path.is_dir() { open.push(path) } else { found.push(path) }
        }
    }
    found.iter().map(|path| path.strip_prefix(folder).expect("below").to_owned()).collect()
}

#[test]
fn pictures_of_readme_are_those_of_the_report() {
    let workspace = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = std::fs::read_to_string(workspace.join("README.md")).expect("README.md");
    let gallery = files(&workspace.join("reports/gallery"));
    assert_eq!(gallery.len(), 2, "a flow and a verdict: {gallery:?}");
    for name in &gallery {
        let read = |path: std::path::PathBuf| std::fs::read(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        let [shown, current] =
            [workspace.join("reports/gallery"), folder().join("figures")].map(|all| read(all.join(name)));
        assert!(shown == current, "copy figures/{0} of the report to reports/gallery/{0}", name.display());
        assert!(readme.contains(&format!("src=\"reports/gallery/{}\"", name.display())), "{name:?}");
    }
}

#[test]
fn a_quick_report_is_small() {
    let bytes = |name: &std::path::PathBuf| std::fs::metadata(folder().join(name)).expect("a file").len();
    let own = |name: &std::path::PathBuf| {
        ["figures", "cases"].iter().any(|part| name.starts_with(part))
            || name.extension().is_some_and(|own| own == "html")
    };
    let all: u64 = files(&folder()).iter().filter(|name| own(name)).map(bytes).sum();
    assert!(all <= LARGEST, "{all} bytes of the report");
}

#[tokio::test]
async fn pages_of_cases_have_a_flow_and_are_not_too_long() {
    let browser = Browser::open(1280, 720).await;
    let mut flows = 0;
    for page in addresses().into_iter().filter(|page| page.contains("/cases/")) {
        browser.client.goto(&page).await.expect(&page);
        let height = browser.ask("return document.documentElement.scrollHeight").await;
        assert!(height.as_u64().is_some_and(|height| height <= HIGHEST_CASE), "{page}: {height} px");
        let first = browser.ask("return document.querySelector('figure img')?.currentSrc ?? ''").await;
        flows += usize::from(first.as_str().is_some_and(|own| own.ends_with(".gif") || own.ends_with("snapshot.png")));
        let still = "return [...document.querySelectorAll('img[src$=\".gif\"]')].every((own) => \
                     own.parentElement.querySelector('source')?.media.includes('prefers-reduced-motion'))";
        assert_eq!(browser.ask(still).await, json!(true), "{page}: an animation that cannot be stopped");
    }
    assert!(flows > 30, "{flows} pages begin with a flow");
}

#[tokio::test]
async fn figures_of_a_case_lie_above_its_tables() {
    let browser = Browser::open(1280, 720).await;
    let script = "const top = (part) => document.querySelector(part)?.getBoundingClientRect().top;\
                  return [top('figure') ?? null, top('table') ?? null]";
    let mut compared = 0;
    for page in addresses().into_iter().filter(|page| page.contains("/cases/")) {
        browser.client.goto(&page).await.expect(&page);
        let tops = browser.ask(script).await;
        if let (Some(figure), Some(table)) = (tops[0].as_f64(), tops[1].as_f64()) {
            assert!(figure < table, "{page}: a figure at {figure} px, a table at {table} px");
            compared += 1;
        }
    }
    assert!(compared > 10, "{compared} pages");
}

#[tokio::test]
async fn every_figure_leads_to_its_files() {
    let browser = Browser::open(1280, 720).await;
    let script = "return [...document.querySelectorAll('.files, .flow')].map((own) => [...own.querySelectorAll('a')].map((link) => link.href))";
    let mut figures = 0;
    for page in addresses() {
        browser.client.goto(&page).await.expect(&page);
        let all = browser.ask(script).await;
        for links in all.as_array().into_iter().flatten().map(list) {
            // animations and pictures of flows have no other files
            if !links.iter().any(|link| link.ends_with(".svg")) {
                continue;
            }
            for ending in [".svg", ".png", ".pdf", ".csv"] {
                let link = links.iter().find(|link| link.ends_with(ending));
                let link = link.unwrap_or_else(|| panic!("{page}: a figure without {ending}: {links:?}"));
                let path = url::Url::parse(link).ok().and_then(|link| link.to_file_path().ok()).expect("a file");
                assert!(std::fs::metadata(&path).is_ok_and(|file| file.len() > 100), "{link}");
            }
            figures += 1;
        }
    }
    assert!(figures > 50, "{figures} figures");
}

#[test]
fn no_axis_counts_rows_of_a_table() {
    let mut folders = vec![folder().join("figures")];
    let mut read = 0;
    while let Some(here) = folders.pop() {
        for path in std::fs::read_dir(here).expect("a folder").flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "svg") {
                let text = std::fs::read_to_string(&path).expect("an SVG");
                assert!(!text.contains("row of the table"), "{}", path.display());
                read += 1;
            }
        }
    }
    assert!(read > 50, "{read} figures");
}

/// `$BAGNOLD_PROGRAM`, else what the checkout's `cargo build` makes.
#[test]
fn figures_are_drawn_in_the_size_of_a_paper() {
    let target = std::env::var("CARGO_TARGET_DIR")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/../../target").to_owned());
    let program = std::env::var("BAGNOLD_PROGRAM").unwrap_or_else(|_| format!("{target}/debug/bagnold"));
    let place = std::env::temp_dir().join(format!("bagnold-paper-{}", std::process::id()));
    let command = ["run", "film", "--figure", "85mm,9pt,300dpi", "--out"];
    let made = std::process::Command::new(&program).args(command).arg(&place).output();
    let made = made.unwrap_or_else(|error| panic!("{program}: {error}; `cargo build` makes it"));
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let mut pictures = 0;
    for path in std::fs::read_dir(place.join("figures")).expect("figures").flatten().map(|entry| entry.path()) {
        if path.extension().is_some_and(|ending| ending == "png") {
            let bytes = std::fs::read(&path).expect("a PNG");
            // 85 mm/25.4 mm · 300
            assert_eq!(bytes[16..20], 1004_u32.to_be_bytes(), "{}", path.display());
            let vectors = std::fs::read_to_string(path.with_extension("svg")).expect("an SVG");
            assert!(vectors.contains("width=\"85.00mm\""), "{}", path.display());
            pictures += 1;
        }
    }
    std::fs::remove_dir_all(&place).expect("removed");
    assert!(pictures > 0);
}

#[tokio::test]
async fn texts_can_be_read_by_day_and_by_night() {
    let browser = Browser::open(1280, 720).await;
    for page in addresses() {
        browser.client.goto(&page).await.expect(&page);
        for (scheme, paper) in [("light", 0.9..=1.0), ("dark", 0.0..=0.1)] {
            browser.with_media("screen", scheme).await;
            let answer = browser.ask(include_str!("scripts/contrast.js")).await;
            let light = answer[0].as_f64().unwrap_or(f64::NAN);
            assert!(paper.contains(&light), "{page}, {scheme}: {light}");
            assert_eq!(list(&answer[1]), [""; 0], "{page}, {scheme}");
        }
    }
}

#[tokio::test]
async fn paper_is_not_wasted() {
    let browser = Browser::open(1280, 720).await;
    browser.client.goto(&address(&folder().join("index.html"))).await.expect("the overview");
    // the driver waits ten seconds for a document, which a busy machine may miss
    let mut printed = browser.client.print(PrintConfiguration::default()).await;
    for _ in 0..PRINTING_RETRIES {
        if printed.is_ok() {
            break;
        }
        printed = browser.client.print(PrintConfiguration::default()).await;
    }
    let printed = printed.expect("a document");
    // a page's object names its type; "/Pages" is the tree of them
    let text = String::from_utf8_lossy(&printed);
    let number = text.matches("/Type /Page").count() - text.matches("/Type /Pages").count();
    assert!((1..=MOST_PRINTED).contains(&number), "{number} pages");
}
