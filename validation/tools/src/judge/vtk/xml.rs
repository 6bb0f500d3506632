//! Points of the XML formats `.vtu` and `.vtp`.

use super::array::{ByteOrder, Scalar};
use super::stored::{EncodedArray, Encoding};
use super::{NamedArrays, PLACES, PointArrays, Refusal, centres, nesting, part};
use crate::input::FieldError;
use roxmltree::Node;

/// The section behind the document to which arrays point by offsets.
#[derive(Debug, Clone, Copy)]
struct Appended<'file> {
    bytes: &'file [u8],
    is_raw: bool,
}

/// Most values per byte of a file `[-]`: points differ from each other, so that a point takes some bytes even compressed.
const MOST_VALUES: usize = 16;

/// Source of the arrays.
struct ArraySource<'file> {
    encoding: Encoding,
    appended: Option<Appended<'file>>,
    /// Bytes of the file that arrays may still take: arrays that share their bytes would need more memory than the file has.
    left: usize,
    /// Values that arrays may still hold: zlib makes thousands of zeros of a few bytes.
    values_left: usize,
}

/// Reads the points of all pieces.
///
/// # Errors
/// A document that is no grid of points, is damaged, or is compressed by something else than zlib.
pub(super) fn read(bytes: &[u8]) -> Result<PointArrays, Refusal> {
    let (text, section) = parted(bytes)?;
    let document = nesting::parse(&text)?;
    let root = document.root_element();
    if !root.has_tag_name("VTKFile") {
        return Err("no file of VTK".into());
    }
    let kind = root.attribute("type").unwrap_or_default();
    match kind {
        "UnstructuredGrid" | "PolyData" => {}
        "PUnstructuredGrid" | "PPolyData" => return Err("in several files".into()),
        "vtkMultiBlockDataSet" | "vtkPartitionedDataSet" | "vtkPartitionedDataSetCollection" => {
            return Err(format!("a collection of grids, {kind}").into());
        }
        _ => return Err(format!("a grid of another kind, {kind}").into()),
    }
    let appended = match (section, child(root, "AppendedData")) {
        (Some(bytes), Some(node)) => Some(appended(bytes, node)?),
        _ => None,
    };
    let mut source = ArraySource {
        encoding: encoding(root)?,
        appended,
        left: bytes.len(),
        values_left: bytes.len().saturating_mul(MOST_VALUES),
    };
    let mut points = PointArrays::default();
    let grid = child(root, kind).ok_or_else(|| format!("without `{kind}`"))?;
    for piece in grid.children().filter(|node| node.has_tag_name("Piece")) {
        source.piece(piece, &mut points)?;
    }
    Ok(points)
}

/// The document, and the bytes behind the heading of its appended section, which need not be text.
fn parted(bytes: &[u8]) -> Result<(String, Option<&[u8]>), Refusal> {
    let heading = nesting::find(bytes, b"<AppendedData");
    let start = heading.and_then(|place| nesting::tag_end(&bytes[place..]).0.map(|end| place + end + 1));
    // an empty section ends with its heading
    let start = start.filter(|start| !bytes[..*start].ends_with(b"/>"));
    let (document, section) = bytes.split_at(start.unwrap_or(bytes.len()));
    let mut text = std::str::from_utf8(document).map_err(|_| "damaged (no text)")?.to_owned();
    if start.is_some() {
        text.push_str("</AppendedData></VTKFile>");
    }
    Ok((text, start.map(|_| section)))
}

fn appended<'file>(section: &'file [u8], node: Node<'_, '_>) -> Result<Appended<'file>, Refusal> {
    let start = section.trim_ascii_start().strip_prefix(b"_").ok_or("damaged (appended data without `_`)")?;
    match node.attribute("encoding") {
        Some("raw") => Ok(Appended { bytes: start, is_raw: true }),
        Some("base64") => {
            let end = start.iter().position(|byte| *byte == b'<').unwrap_or(start.len());
            Ok(Appended { bytes: &start[..end], is_raw: false })
        }
        other => Err(format!("with appended data in `{}`", other.unwrap_or_default()).into()),
    }
}

fn encoding(root: Node<'_, '_>) -> Result<Encoding, Refusal> {
    let order = match root.attribute("byte_order") {
        None | Some("LittleEndian") => ByteOrder::LittleEndian,
        Some("BigEndian") => ByteOrder::BigEndian,
        Some(other) => return Err(format!("in the byte order `{other}`").into()),
    };
    let header = match root.attribute("header_type") {
        None | Some("UInt32") => 4,
        Some("UInt64") => 8,
        Some(other) => return Err(format!("with headers of type `{other}`").into()),
    };
    let is_compressed = match root.attribute("compressor") {
        None | Some("") => false,
        Some("vtkZLibDataCompressor") => true,
        Some(other) => {
            let remedy = "write it with SetCompressorTypeToZLib() or SetCompressorTypeToNone(), in ParaView with the \
                          compressor ZLib or None";
            let rule = "uncompressed or compressed by vtkZLibDataCompressor";
            return Err(Refusal(FieldError::new("file", format!("compressed by {other}"), rule, remedy)));
        }
    };
    Ok(Encoding { order, header, is_compressed })
}

fn child<'node, 'text>(node: Node<'node, 'text>, name: &str) -> Option<Node<'node, 'text>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn count(node: Node<'_, '_>, name: &str) -> Result<Option<usize>, Refusal> {
    let wrong = |text: &str| format!("with {name}=\"{text}\"");
    node.attribute(name).map(|text| text.trim().parse().map_err(|_| wrong(text).into())).transpose()
}

impl ArraySource<'_> {
    fn piece(&mut self, piece: Node<'_, '_>, points: &mut PointArrays) -> Result<(), Refusal> {
        let number = count(piece, "NumberOfPoints")?.unwrap_or(0);
        if number == 0 {
            return Ok(());
        }
        let is_array = |node: &Node<'_, '_>| node.has_tag_name("DataArray");
        let places = child(piece, "Points").and_then(|places| places.children().find(is_array));
        let places = places.ok_or("without places of its points")?;
        if count(places, "NumberOfComponents")?.is_some_and(|components| components != 3) {
            return Err("with places of points that have not 3 components".into());
        }
        let values = self.values(places, PLACES, number, 3)?;
        part(&mut points.arrays, PLACES, 3, &values);
        self.data(piece, "PointData", number, &mut points.arrays)?;
        let has_arrays = |data: Node<'_, '_>| data.children().any(|node| is_array(&node));
        if child(piece, "CellData").is_some_and(has_arrays) {
            let centres = self.centres(piece, &values)?;
            part(&mut points.cells, PLACES, 3, &centres);
            self.data(piece, "CellData", centres.len() / 3, &mut points.cells)?;
        }
        Ok(())
    }

    /// Arrays at points or at cells.
    fn data(&mut self, piece: Node<'_, '_>, at: &str, tuples: usize, arrays: &mut NamedArrays) -> Result<(), Refusal> {
        let data = child(piece, at).into_iter().flat_map(|data| data.children());
        let is_number = |array: &Node<'_, '_>| array.attribute("type") != Some("String");
        for array in data.filter(|node| node.has_tag_name("DataArray")).filter(is_number) {
            let name = array.attribute("Name").ok_or("with an array without a name")?;
            let components = count(array, "NumberOfComponents")?.unwrap_or(1).max(1);
            let values = self.values(array, name, tuples, components)?;
            part(arrays, name, components, &values);
        }
        Ok(())
    }

    /// Centres of the cells, in the order of their data.
    fn centres(&mut self, piece: Node<'_, '_>, points: &[f64]) -> Result<Vec<f64>, Refusal> {
        let mut all = Vec::new();
        for kind in ["Cells", "Verts", "Lines", "Strips", "Polys"] {
            let number = count(piece, &format!("NumberOf{kind}"))?.unwrap_or(0);
            if number == 0 {
                continue;
            }
            let array = |name: &'static str| {
                let mut arrays = child(piece, kind).into_iter().flat_map(|cells| cells.children());
                let found = arrays.find(|node| node.attribute("Name") == Some(name));
                found.ok_or_else(|| format!("without `{name}` of its cells"))
            };
            let ends = self.values(array("offsets")?, "offsets", number, 1)?;
            let size = ends.last().map_or(0, |end| *end as usize);
            let connectivity = self.values(array("connectivity")?, "connectivity", size, 1)?;
            all.extend(centres(points, &connectivity, &ends)?);
        }
        Ok(all)
    }

    /// All values of an array.
    fn values(
        &mut self,
        array: Node<'_, '_>,
        name: &str,
        tuples: usize,
        components: usize,
    ) -> Result<Vec<f64>, Refusal> {
        let of_array = |reason: String| Refusal::from(format!("{reason} in the array `{name}`"));
        let scalar = array.attribute("type").unwrap_or_default();
        let scalar = Scalar::of_xml(scalar).ok_or_else(|| of_array(format!("with values of type `{scalar}`")))?;
        let endless = || of_array(format!("with {tuples} times {components} values"));
        let count = tuples.checked_mul(components).ok_or_else(endless)?;
        self.values_left = self.values_left.checked_sub(count).ok_or_else(|| {
            of_array(format!("with {tuples} points, more than {MOST_VALUES} values per byte of the file,"))
        })?;
        let texts = || array.children().filter(|node| node.is_text()).filter_map(|node| node.text());
        let format = array.attribute("format").unwrap_or("ascii");
        let inline: String;
        let stored = match format {
            "ascii" => {
                let mut words = texts().flat_map(str::split_ascii_whitespace);
                let values = scalar.parse(&mut words, count).map_err(of_array)?;
                return match words.next() {
                    None => Ok(values),
                    Some(_) => Err(of_array(format!("with more than {count} values"))),
                };
            }
            "binary" => {
                inline = texts().collect();
                EncodedArray::base64(inline.as_bytes())
            }
            "appended" => {
                let appended = self.appended.ok_or("without the appended data of its arrays")?;
                let offset = self::count(array, "offset")?.ok_or("with an appended array without `offset`")?;
                let bytes = appended.bytes.get(offset..).ok_or("damaged (an array begins behind the end)")?;
                if appended.is_raw { EncodedArray::Raw(bytes) } else { EncodedArray::base64(bytes) }
            }
            other => return Err(of_array(format!("with the format `{other}`"))),
        };
        let expected = scalar.bytes_of(count).ok_or_else(endless)?;
        let bytes = self.bytes(stored, expected).map_err(of_array)?;
        Ok(scalar.decode(&bytes, count, self.encoding.order))
    }

    fn bytes(&mut self, mut stored: EncodedArray<'_>, expected: usize) -> Result<Vec<u8>, String> {
        let before = stored.left();
        let bytes = stored.array(expected, self.encoding)?;
        let taken = before - stored.left();
        self.left = self.left.checked_sub(taken).ok_or("damaged (arrays share their bytes)")?;
        Ok(bytes)
    }
}
