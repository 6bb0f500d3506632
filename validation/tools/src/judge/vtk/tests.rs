//! Files as VTK writes them, and files that something has damaged.

use super::foreign_tests::readable;
use super::*;
use proptest::collection::vec;
use proptest::prelude::{Strategy, any, prop_oneof, proptest};
use proptest::prop_assert;
use proptest::sample::select;
use std::io::Read;
use std::path::PathBuf;
use std::sync::LazyLock;

/// Two points with masses, as text and in base 64.
const TEXT: &str = "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\
    <UnstructuredGrid><Piece NumberOfPoints=\"2\" NumberOfCells=\"2\"><PointData><DataArray type=\"Float64\" Name=\"mass\" \
    NumberOfComponents=\"1\" format=\"ascii\">0.5 0.25</DataArray></PointData><Points><DataArray type=\"Float32\" \
    NumberOfComponents=\"3\" format=\"ascii\">0 1 0 2 3 0</DataArray></Points><Cells><DataArray type=\"Int64\" \
    Name=\"connectivity\" format=\"ascii\">0 1</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">1 2\
    </DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">1 1</DataArray></Cells></Piece></UnstructuredGrid>\
    </VTKFile>";
const BINARY: [(&str, &str); 2] = [
    ("\"ascii\">0.5 0.25<", "\"binary\">EAAAAAAAAAAAAAAAAADgPwAAAAAAANA/<"),
    ("\"ascii\">0 1 0 2 3 0<", "\"binary\">GAAAAAAAAAAAAAAAAACAPwAAAAAAAABAAABAQAAAAAA=<"),
];

fn binary() -> String {
    BINARY.iter().fold(TEXT.to_owned(), |text, (ascii, binary)| text.replace(ascii, binary))
}

const LEGACY: &str = "# vtk DataFile Version 3.0\nparticles\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n0 1 0\n2 3 0\n\
    CELLS 2 4\n1 0\n1 1\nCELL_TYPES 2\n1\n1\nPOINT_DATA 2\nSCALARS mass float 1\nLOOKUP_TABLE default\n0.5 0.25\n\
    VECTORS velocity float\n1 0 0\n0 1 0\n";

#[test]
fn a_legacy_file_gives_its_arrays() {
    let points = PointArrays::parse(LEGACY.as_bytes(), Path::new("a.vtk")).expect("a grid");
    assert_eq!(points.arrays["Points:1"], [1.0, 3.0]);
    assert_eq!(points.arrays["mass"], [0.5, 0.25]);
    assert_eq!(points.arrays["velocity:1"], [0.0, 1.0]);
}

/// A square and a triangle beside it, with data at cells alone.
const CELLS: &str = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\
    <CellData><DataArray type=\"Float64\" Name=\"alpha.water\" format=\"ascii\">0.5 1</DataArray></CellData>\
    <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 2 0 0 2 2 0 0 2 0 5 1 0</DataArray></Points>\
    <Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 1 4 2</DataArray>\
    <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 7</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
const LEGACY_CELLS: &str = "# vtk DataFile Version 3.0\ncells\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n0 0 0 2 0 0 2 2 0 0 2 0 5 1 0\n\
    POLYGONS 2 9\n4 0 1 2 3\n3 1 4 2\nCELL_DATA 2\nSCALARS alpha.water double 1\nLOOKUP_TABLE default\n0.5 1\n";

#[test]
fn data_at_cells_stand_at_the_means_of_their_points() {
    let since_5_1 = LEGACY_CELLS.replace(
        "POLYGONS 2 9\n4 0 1 2 3\n3 1 4 2",
        "POLYGONS 3 7\nOFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY vtktypeint64\n0 1 2 3 1 4 2",
    );
    for (text, name) in [(CELLS, "a.vtu"), (LEGACY_CELLS, "a.vtk"), (&since_5_1, "b.vtk")] {
        let points = PointArrays::parse(text.as_bytes(), Path::new(name)).expect("a grid");
        assert_eq!(points.arrays.len(), 3, "{name}: places alone");
        assert_eq!(points.cells["alpha.water"], [0.5, 1.0], "{name}");
        assert_eq!((&points.cells["Points:0"][..], &points.cells["Points:1"][..]), (&[1.0, 3.0][..], &[1.0, 1.0][..]));
    }
    for (text, name) in
        [(CELLS.replace("1 4 2<", "1 5 2<"), "a.vtu"), (LEGACY_CELLS.replace("3 1 4 2", "3 1 5 2"), "a.vtk")]
    {
        let message = PointArrays::parse(text.as_bytes(), Path::new(name)).expect_err("a point too many").to_string();
        assert!(message.contains("with cells of points that it lacks"), "{message}");
    }
    let image = "<VTKFile type=\"ImageData\"><ImageData/></VTKFile>";
    let message = PointArrays::parse(image.as_bytes(), Path::new("a.vti")).expect_err("an image").to_string();
    assert!(message.contains("a grid of another kind, ImageData"), "{message}");
}

#[test]
fn invalid_vtk_is_refused_without_a_panic() {
    for text in
        ["", "x,y\n1,2\n", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece/></UnstructuredGrid></VTKFile>"]
    {
        for name in ["a.vtu", "a.vtk"] {
            let message = PointArrays::parse(text.as_bytes(), Path::new(name)).expect_err("no grid").to_string();
            assert!(message.starts_with(&format!("{name}: `file`: not an ")), "{message}");
        }
    }
}

#[test]
fn a_collection_names_files_beside_itself() {
    let text =
        "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0.5\" file=\"a/1.vtu\"/></Collection></VTKFile>";
    let sets = collection(text, Path::new("out/all.pvd")).expect("a collection");
    assert_eq!(sets, [(0.5, PathBuf::from("out/a/1.vtu"))]);
    assert!(collection("<VTKFile/>", Path::new("all.pvd")).is_err());
    assert!(collection("no", Path::new("all.pvd")).is_err());
}

#[test]
fn a_collection_as_codes_write_it_is_put_in_order() {
    let set =
        |time: &str, part: &str, file: &str| format!("<DataSet timestep=\"{time}\" part=\"{part}\" file=\"{file}\"/>");
    // out of order, in parts, by Windows, and written again by a restart
    let sets =
        [set("1", "0", "b.vtu"), set("0", "0", "a\\0.vtu"), set("0", "1", "a\\1.vtu"), set("1", "0", "c.vtu")].concat();
    let text = format!("<VTKFile><Collection>{sets}</Collection></VTKFile>");
    let files = |text: &str, name: &str| collection(text, Path::new(name)).expect("a collection");
    let expected = [(0.0, "a/0.vtu"), (0.0, "a/1.vtu"), (1.0, "c.vtu")].map(|(time, name)| (time, PathBuf::from(name)));
    assert_eq!(files(&text, "all.pvd"), expected);
    // parts without a number follow each other
    let unnumbered = text.replace("part=\"0\"", "").replace("part=\"1\"", "");
    assert_eq!(files(&unnumbered, "all.pvd"), expected);
    let series = "{\"file-series-version\": \"1.0\", \"files\": [{\"name\": \"a.vtm\", \"time\": 0.5}]}";
    assert_eq!(files(series, "out/a.vtm.series"), [(0.5, PathBuf::from("out/a.vtm"))]);
    assert!(collection("{\"files\": [{\"name\": \"a.vtm\"}]}", Path::new("a.series")).is_err());
    let parallel = "<VTKFile><PUnstructuredGrid><Piece Source=\"a_0.vtu\"/><Piece Source=\"a_1.vtu\"/></PUnstructuredGrid></VTKFile>";
    let named = pieces(parallel, Path::new("out/a.pvtu")).expect("pieces");
    assert_eq!(named, [PathBuf::from("out/a_0.vtu"), PathBuf::from("out/a_1.vtu")]);
    let blocks = "<VTKFile><vtkMultiBlockDataSet><DataSet name=\"internal\" file=\"i.vtu\"/><Block name=\"boundary\">\
        <DataSet name=\"inlet\" file=\"b.vtp\"/></Block></vtkMultiBlockDataSet></VTKFile>";
    assert_eq!(pieces(blocks, Path::new("a.vtm")).expect("cells"), [PathBuf::from("i.vtu")]);
    assert!(pieces("<VTKFile/>", Path::new("a.pvtu")).is_err() && pieces("no", Path::new("a.vtm")).is_err());
}

#[test]
fn text_and_base_64_give_the_same_points() {
    let points = PointArrays::parse(TEXT.as_bytes(), Path::new("a.vtu")).expect("a grid");
    assert_eq!(points.arrays["Points:1"], [1.0, 3.0]);
    assert_eq!(points.arrays["mass"], [0.5, 0.25]);
    assert_eq!(PointArrays::parse(binary().as_bytes(), Path::new("a.vtu")).expect("a grid"), points);
}

#[test]
fn documents_nested_too_deep_are_refused_before_they_are_parsed() {
    let nested = |depth: usize| format!("{}{}", "<a b='>'>".repeat(depth), "</a>".repeat(depth));
    assert!(nesting::parse(&nested(64)).is_ok());
    assert_eq!(nesting::parse(&nested(65)).expect_err("too deep"), "nested deeper than 64 elements");
    let beside = format!("<a>{}</a>", "<b/><!-- <c> --><![CDATA[<c>]]>".repeat(100));
    assert!(nesting::parse(&beside).is_ok());
    for text in [nested(100_000), "<a>".repeat(100_000)] {
        assert!(collection(&text, Path::new("all.pvd")).is_err());
        assert!(PointArrays::parse(text.as_bytes(), Path::new("a.vtu")).is_err());
    }
}

#[test]
fn a_count_beyond_the_file_is_refused_before_memory_is_asked_for() {
    let legacy = LEGACY.replace("POINTS 2", "POINTS 999999999999");
    let binary_legacy = legacy.replace("ASCII", "BINARY");
    let text = TEXT.replace("NumberOfPoints=\"2\"", "NumberOfPoints=\"999999999999\"");
    let encoded = binary().replace("NumberOfPoints=\"2\"", "NumberOfPoints=\"999999999999\"");
    // one block of zlib that claims 16 GB
    let block = "\"binary\">AQAAAAAAAAAAAAAABAAAAAAAAAAEAAAACAAAAAAAAAB4nAMAAAAAAQ==<";
    let compressed = TEXT
        .replace("<VTKFile ", "<VTKFile compressor=\"vtkZLibDataCompressor\" ")
        .replace("NumberOfPoints=\"2\"", "NumberOfPoints=\"1431655766\"")
        .replace(BINARY[1].0, block);
    for (text, name) in
        [(legacy, "a.vtk"), (binary_legacy, "a.vtk"), (text, "a.vtu"), (encoded, "a.vtu"), (compressed, "a.vtu")]
    {
        let message = PointArrays::parse(text.as_bytes(), Path::new(name)).expect_err("no such count").to_string();
        assert!(message.starts_with(&format!("{name}: `file`: not an ")), "{message}");
    }
}

#[test]
fn points_without_places_of_their_own_are_refused_before_memory_is_asked_for() {
    let points = 10_000_000_u32;
    let mut zeros = flate2::read::ZlibEncoder::new(std::io::repeat(0).take(3 * u64::from(points)), Default::default());
    let mut block = Vec::new();
    zeros.read_to_end(&mut block).expect("compressed");
    let header = [1, 3 * points, 0, block.len() as u32].map(u32::to_le_bytes).concat();
    let text = format!(
        "<VTKFile type=\"PolyData\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece NumberOfPoints=\"{points}\"><Points>\
         <DataArray type=\"Int8\" format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>\
         <AppendedData encoding=\"raw\">_"
    );
    let bytes = [text.as_bytes(), &header, &block].concat();
    let message = PointArrays::parse(&bytes, Path::new("a.vtp")).expect_err("too many").to_string();
    assert!(message.contains("with 10000000 points, more than 16 values per byte of the file"), "{message}");
}

#[test]
fn empty_appended_section_is_ignored() {
    let text = TEXT.replace("</VTKFile>", "<AppendedData encoding=\"raw\"/></VTKFile>");
    let points = PointArrays::parse(text.as_bytes(), Path::new("a.vtu")).expect("a grid");
    assert_eq!(points.arrays["mass"], [0.5, 0.25]);
}

#[test]
fn appended_arrays_that_share_their_bytes_are_refused() {
    let array = "<DataArray type=\"Float32\" NumberOfComponents=\"3\" Name=\"NAME\" format=\"appended\" offset=\"0\"/>";
    let many: String = (0..1000).map(|number| array.replace("NAME", &format!("a{number}"))).collect();
    let text = format!(
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1000\"><Points>{array}</Points><PointData>{many}\
         </PointData></Piece></PolyData><AppendedData encoding=\"raw\">_"
    );
    let bytes = [text.as_bytes(), &12_000_u32.to_le_bytes(), &[0; 12_000]].concat();
    let message = PointArrays::parse(&bytes, Path::new("a.vtp")).expect_err("shared").to_string();
    assert!(message.contains("arrays share their bytes"), "{message}");
}

/// Damage to a file.
#[derive(Debug, Clone)]
enum Damage {
    /// Another byte at a place.
    Byte(usize, u8),
    /// Another number in place of one.
    Number(usize, &'static str),
    /// Nothing after a place.
    End(usize),
    /// A piece twice.
    Twice(usize, usize),
}

/// Numbers that ask for memory, for time, or for an end that is not there.
const NUMBERS: [&str; 10] =
    ["0", "-1", "7", "65536", "2147483647", "4294967295", "99999999999", "18446744073709551615", "1e308", "nan"];

impl Damage {
    fn strategy() -> impl Strategy<Value = Self> {
        let place = 0..10_000_usize;
        prop_oneof![
            (place.clone(), any::<u8>()).prop_map(|(place, byte)| Self::Byte(place, byte)),
            (place.clone(), select(&NUMBERS[..])).prop_map(|(place, number)| Self::Number(place, number)),
            place.clone().prop_map(Self::End),
            (place, 1..60_usize).prop_map(|(place, length)| Self::Twice(place, length)),
        ]
    }

    fn to(&self, bytes: &mut Vec<u8>) {
        let length = bytes.len().max(1);
        match *self {
            Self::Byte(place, byte) => {
                if let Some(old) = bytes.get_mut(place % length) {
                    *old = byte;
                }
            }
            Self::Number(place, number) => {
                let digit = |byte: &u8| byte.is_ascii_digit();
                let Some(from) = bytes.iter().skip(place % length).position(digit) else { return };
                let from = from + place % length;
                let count = bytes[from..].iter().take_while(|byte| digit(byte)).count();
                bytes.splice(from..from + count, number.bytes());
            }
            Self::End(place) => bytes.truncate(place % length),
            Self::Twice(place, count) => {
                let from = place % length;
                let piece = bytes[from..(from + count).min(bytes.len())].to_vec();
                bytes.splice(from..from, piece);
            }
        }
    }
}

/// Files that VTK and meshio wrote in their encodings.
static FOREIGN: LazyLock<Vec<(PathBuf, Vec<u8>)>> = LazyLock::new(readable);

proptest! {
    #[test]
    fn a_damaged_file_is_read_or_refused(damages in vec(Damage::strategy(), 1..4), kind in any::<usize>()) {
        let (mut bytes, name) = match kind % (5 + FOREIGN.len()) {
            0 => (LEGACY.as_bytes().to_vec(), Path::new("a.vtk")),
            1 => (TEXT.as_bytes().to_vec(), Path::new("a.vtu")),
            2 => (binary().into_bytes(), Path::new("a.vtu")),
            3 => (CELLS.as_bytes().to_vec(), Path::new("a.vtu")),
            4 => (LEGACY_CELLS.as_bytes().to_vec(), Path::new("a.vtk")),
            kind => (FOREIGN[kind - 5].1.clone(), FOREIGN[kind - 5].0.as_path()),
        };
        for damage in &damages {
            damage.to(&mut bytes);
        }
        if let Ok(points) = PointArrays::parse(&bytes, name) {
            let count = points.arrays["Points:0"].len();
            prop_assert!(points.arrays.values().all(|values| values.len() == count));
        }
    }
}
