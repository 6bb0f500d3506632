//! XML that is parsed only if its elements are nested no deeper than a parser that calls itself can follow.

use roxmltree::{Document, ParsingOptions};

/// Deepest nesting of elements; files of VTK have 5.
const DEEPEST: usize = 64;
/// Most attributes of an element.
const MOST_ATTRIBUTES: usize = 64;
/// Most nodes of a document: 10 000 data sets of a collection have 20 000 with the text between them.
const MOST_NODES: u32 = 1_000_000;

/// Parses a document.
///
/// # Errors
/// Text that is no XML, is nested too deep, or declares a document type, as what completes "`file` is …".
pub(super) fn parse(text: &str) -> Result<Document<'_>, String> {
    check_nesting(text.as_bytes())?;
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| format!("damaged ({error})"))
}

/// Checks tags without building anything; what is no XML is left to the parser.
fn check_nesting(text: &[u8]) -> Result<(), String> {
    let mut rest = text;
    let mut depth = 0_usize;
    while let Some(start) = rest.iter().position(|byte| *byte == b'<') {
        rest = &rest[start..];
        let passed = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .into_iter()
            .find_map(|(opening, closing)| rest.strip_prefix(opening.as_bytes()).map(|inner| (inner, closing)));
        if let Some((inner, closing)) = passed {
            let Some(end) = find(inner, closing.as_bytes()) else { return Ok(()) };
            rest = &inner[end + closing.len()..];
        } else if rest.starts_with(b"<!") {
            return Err("a document with a declaration of its type".to_owned());
        } else {
            let (end, attributes) = tag_end(rest);
            if attributes > MOST_ATTRIBUTES {
                return Err(format!("with more than {MOST_ATTRIBUTES} attributes of an element"));
            }
            let Some(end) = end else { return Ok(()) };
            if rest.starts_with(b"</") {
                depth = depth.saturating_sub(1);
            } else if rest[end - 1] != b'/' {
                depth += 1;
            }
            if depth > DEEPEST {
                return Err(format!("nested deeper than {DEEPEST} elements"));
            }
            rest = &rest[end + 1..];
        }
    }
    Ok(())
}

/// Place of a part.
pub(super) fn find(bytes: &[u8], part: &[u8]) -> Option<usize> {
    bytes.windows(part.len()).position(|window| window == part)
}

/// Place of the `>` that ends the tag at the start, and the number of values in quotes before it.
pub(super) fn tag_end(tag: &[u8]) -> (Option<usize>, usize) {
    let mut quote = None;
    let mut attributes = 0;
    for (place, byte) in tag.iter().enumerate() {
        match quote {
            Some(open) if open == *byte => quote = None,
            Some(_) => {}
            None if *byte == b'"' || *byte == b'\'' => {
                quote = Some(*byte);
                attributes += 1;
            }
            None if *byte == b'>' => return (Some(place), attributes),
            None => {}
        }
    }
    (None, attributes)
}
