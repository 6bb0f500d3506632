//! Points of the legacy format `.vtk`: keywords with counts, each followed by values as text or in big-endian order.

use super::array::{ByteOrder, Scalar};
use super::{PLACES, PointArrays, Refusal, centres, part};

/// Remainder of a file.
struct Legacy<'file> {
    rest: &'file [u8],
    is_binary: bool,
    /// Places of the points, three values each.
    places: Vec<f64>,
    /// Centres of the cells, three values each.
    centres: Vec<f64>,
}

/// Number of points or cells that own attributes, and whether they are cells; none for those of the dataset.
type Owner = Option<(usize, bool)>;

/// Reads the points.
///
/// # Errors
/// A file that is none of points, is damaged, or announces more values than it has.
pub(super) fn read(bytes: &[u8]) -> Result<PointArrays, Refusal> {
    let mut file = Legacy { rest: bytes, is_binary: false, places: Vec::new(), centres: Vec::new() };
    if !file.line().to_ascii_lowercase().starts_with(b"# vtk datafile version") {
        return Err("no file of VTK".into());
    }
    file.line();
    file.is_binary = match file.word()?.to_ascii_uppercase().as_str() {
        "ASCII" => false,
        "BINARY" => true,
        _ => return Err("neither ASCII nor BINARY".into()),
    };
    let dataset = [file.word()?, file.word()?].map(str::to_ascii_uppercase);
    if dataset[0] != "DATASET" || !["UNSTRUCTURED_GRID", "POLYDATA"].contains(&dataset[1].as_str()) {
        return Err(format!("a grid of another kind, {}", shortened(&dataset[1])).into());
    }
    let mut points = PointArrays::default();
    let mut owner = None;
    while let Some(keyword) = file.next_word()? {
        file.section(&keyword.to_ascii_uppercase(), &mut owner, &mut points)?;
    }
    Ok(points)
}

impl<'file> Legacy<'file> {
    fn section(&mut self, keyword: &str, owner: &mut Owner, points: &mut PointArrays) -> Result<(), Refusal> {
        match keyword {
            "POINTS" => {
                let count = self.count()?;
                if !points.arrays.is_empty() {
                    return Err("with points twice".into());
                }
                let scalar = self.scalar()?;
                let values = self.values(scalar, count, 3)?;
                part(&mut points.arrays, PLACES, 3, &values);
                self.places = values;
            }
            "CELLS" | "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS" => self.cells()?,
            "CELL_TYPES" => {
                let count = self.count()?;
                self.values(Scalar::Int32, count, 1)?;
            }
            "POINT_DATA" => {
                let count = self.count()?;
                let given = points.arrays.get(&format!("{PLACES}:0")).map_or(0, Vec::len);
                if count != given {
                    return Err(format!("of {given} points, but with data of {count}").into());
                }
                *owner = Some((count, false));
            }
            "CELL_DATA" => {
                let (count, given) = (self.count()?, self.centres.len() / 3);
                if count != given {
                    return Err(format!("of {given} cells, but with data of {count}").into());
                }
                if points.cells.is_empty() {
                    part(&mut points.cells, PLACES, 3, &self.centres);
                }
                *owner = Some((count, true));
            }
            "METADATA" => self.metadata(),
            "FIELD" => {
                self.word()?;
                for _ in 0..self.count()? {
                    let name = self.array_name()?;
                    let (components, tuples) = (self.count()?, self.count()?);
                    let scalar = self.scalar()?;
                    let values = self.values(scalar, tuples, components)?;
                    if let Some((_, at_cells)) = *owner {
                        part(points.at(at_cells), &name, components, &values);
                    }
                }
            }
            "LOOKUP_TABLE" => {
                self.word()?;
                let count = self.count()?;
                self.values(self.colour(), count, 4)?;
            }
            _ => {
                let (count, at_cells) = owner.ok_or_else(|| unknown(keyword))?;
                let (name, components, values) = self.attribute(keyword, count)?;
                part(points.at(at_cells), &name, components, &values);
            }
        }
        Ok(())
    }

    /// An array with its name and number of components.
    fn attribute(&mut self, keyword: &str, count: usize) -> Result<(String, usize, Vec<f64>), Refusal> {
        let components = match keyword {
            "SCALARS" | "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => 1,
            "VECTORS" | "NORMALS" => 3,
            "TENSORS6" => 6,
            "TENSORS" => 9,
            "TEXTURE_COORDINATES" | "COLOR_SCALARS" => 0,
            _ => return Err(unknown(keyword)),
        };
        let name = self.array_name()?;
        let mut components = if components == 0 { self.count()? } else { components };
        let scalar = if keyword == "COLOR_SCALARS" { self.colour() } else { self.scalar()? };
        if keyword == "SCALARS" {
            // the number of components may stand on the same line
            let end = self.rest.iter().position(|byte| *byte == b'\n').unwrap_or(self.rest.len());
            if !self.rest[..end].trim_ascii().is_empty() {
                components = self.count()?;
            }
            if self.next_is("LOOKUP_TABLE") {
                self.word()?;
                self.word()?;
            }
        }
        Ok((name, components, self.values(scalar, count, components)?))
    }

    /// Centres of cells, which are numbers of points with points, or since version 5.1 two arrays.
    fn cells(&mut self) -> Result<(), Refusal> {
        let (first, second) = (self.count()?, self.count()?);
        let (mut connectivity, mut ends) = (Vec::new(), Vec::new());
        if self.next_is("OFFSETS") {
            for (heading, count, array) in [("OFFSETS", first, &mut ends), ("CONNECTIVITY", second, &mut connectivity)]
            {
                if !self.word()?.eq_ignore_ascii_case(heading) {
                    return Err(format!("damaged (no {heading} of cells)").into());
                }
                let scalar = self.scalar()?;
                *array = self.values(scalar, count, 1)?;
            }
            // the first offset is where the first cell begins
            ends = ends.split_off(first.min(1));
        } else {
            let values = self.values(Scalar::Int32, second, 1)?;
            let mut rest = &values[..];
            while let Some((size, points)) = rest.split_first() {
                let (cell, after) =
                    points.split_at_checked(*size as usize).ok_or("with cells of points that it lacks")?;
                connectivity.extend(cell);
                ends.push(connectivity.len() as f64);
                rest = after;
            }
        }
        self.centres.extend(centres(&self.places, &connectivity, &ends)?);
        Ok(())
    }

    /// Passes what is said about an array, which ends with an empty line.
    fn metadata(&mut self) {
        self.line();
        while !self.rest.is_empty() && !self.line().trim_ascii().is_empty() {}
    }

    fn values(&mut self, scalar: Scalar, tuples: usize, components: usize) -> Result<Vec<f64>, Refusal> {
        let endless = || format!("announcing {tuples} times {components} values in {} bytes", self.rest.len());
        let count = tuples.checked_mul(components).ok_or_else(endless)?;
        if !self.is_binary {
            // a value and what parts it from the next take two bytes
            if count > self.rest.len().div_ceil(2) {
                return Err(endless().into());
            }
            let mut values = Vec::new();
            for _ in 0..count {
                values.extend(scalar.parse(&mut std::iter::once(self.word()?), 1)?);
            }
            return Ok(values);
        }
        let size = scalar.bytes_of(count).ok_or_else(endless)?;
        let from = self.rest.iter().position(|byte| *byte == b'\n').map_or(self.rest.len(), |end| end + 1);
        let (values, rest) = self.rest[from..].split_at_checked(size).ok_or_else(endless)?;
        self.rest = rest;
        Ok(scalar.decode(values, count, ByteOrder::BigEndian))
    }

    fn count(&mut self) -> Result<usize, Refusal> {
        let word = self.word()?;
        word.parse().map_err(|_| format!("with `{}` for a count", shortened(word)).into())
    }

    /// Type of the parts of a colour.
    fn colour(&self) -> Scalar {
        if self.is_binary { Scalar::UInt8 } else { Scalar::Float64 }
    }

    fn scalar(&mut self) -> Result<Scalar, Refusal> {
        let word = self.word()?;
        Scalar::of_legacy(word).ok_or_else(|| format!("with values of type `{}`", shortened(word)).into())
    }

    /// The name of an array, whose blanks and percent signs are written as `%20` and `%25`. What is said about the array
    /// before is passed.
    fn array_name(&mut self) -> Result<String, Refusal> {
        while self.next_is("METADATA") {
            self.metadata();
        }
        let mut bytes = Vec::new();
        let mut rest = self.word()?.as_bytes();
        while let Some((byte, after)) = rest.split_first() {
            let digits = after.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
            let code = digits.filter(|_| *byte == b'%').and_then(|digits| u8::from_str_radix(digits, 16).ok());
            bytes.push(code.unwrap_or(*byte));
            rest = if code.is_some() { &after[2..] } else { after };
        }
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    fn next_is(&self, keyword: &str) -> bool {
        let rest = self.rest.trim_ascii_start();
        rest.get(..keyword.len()).is_some_and(|start| start.eq_ignore_ascii_case(keyword.as_bytes()))
    }

    fn word(&mut self) -> Result<&'file str, Refusal> {
        self.next_word()?.ok_or_else(|| "damaged (the file ends early)".into())
    }

    fn next_word(&mut self) -> Result<Option<&'file str>, Refusal> {
        let start = self.rest.trim_ascii_start();
        let end = start.iter().position(u8::is_ascii_whitespace).unwrap_or(start.len());
        let (word, rest) = start.split_at(end);
        self.rest = rest;
        let word = std::str::from_utf8(word).map_err(|_| "damaged (no text where a word is expected)")?;
        Ok(Some(word).filter(|word| !word.is_empty()))
    }

    /// The rest of the line.
    fn line(&mut self) -> &'file [u8] {
        let end = self.rest.iter().position(|byte| *byte == b'\n').unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest.get(1..).unwrap_or_default();
        line
    }
}

fn shortened(word: &str) -> String {
    word.chars().take(40).collect()
}

fn unknown(keyword: &str) -> Refusal {
    format!("with the section `{}`", shortened(keyword)).into()
}
