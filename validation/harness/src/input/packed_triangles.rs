//! Triangles of a large mesh as one text of a case file, a third as long as their numbers and read as a whole.
//!
//! In base64, least byte first: the number of corners in 4 bytes, each corner once by x, y, z in 8 bytes, then the three
//! corners of every triangle by their places in 4 bytes. So the text says the triangles to the last bit.

use super::mesh::{MOST_TRIANGLES, Triangle};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::Arc;

/// Triangles `[m]` and their text encoding, shared by all copies of the parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(from = "String", into = "String")]
#[schemars(with = "String", inline)]
pub struct PackedTriangles {
    text: Arc<str>,
    triangles: Arc<[Triangle]>,
    /// Lower and upper corner of the bounding box `[m]`; `None` without triangles.
    bounds: Option<[[f64; 3]; 2]>,
    /// `[m²]`
    area: f64,
}

impl PackedTriangles {
    /// Whether there is no text.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// The beginning of a text that says no triangles, if it is such a one.
    pub fn damage(&self) -> Option<String> {
        let is_damaged = !self.is_empty() && self.triangles.is_empty();
        is_damaged.then(|| format!("\"{}\"", self.text.chars().take(12).collect::<String>()))
    }

    /// The triangles, each by its corners `[m]`.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// Lower and upper corner of the bounding box `[m]`; `None` without triangles.
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        self.bounds
    }

    /// Sum of their areas `[m²]`.
    pub fn area(&self) -> f64 {
        self.area
    }
}

fn bounds_of(triangles: &[Triangle]) -> Option<[[f64; 3]; 2]> {
    let first = *triangles.as_flattened().first()?;
    let mut bounds = [first, first];
    for corner in triangles.as_flattened() {
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(corner[axis]);
            bounds[1][axis] = bounds[1][axis].max(corner[axis]);
        }
    }
    Some(bounds)
}

/// `[m²]`
fn area_of([a, b, c]: &Triangle) -> f64 {
    let edge = |to: &[f64; 3]| nalgebra::Vector3::new(to[0] - a[0], to[1] - a[1], to[2] - a[2]);
    0.5 * edge(b).cross(&edge(c)).norm()
}

/// The text of some triangles.
pub(crate) fn packed(triangles: &[Triangle]) -> String {
    let mut places: HashMap<[u64; 3], u32> = HashMap::with_capacity(triangles.len());
    let (mut corners, mut of_triangles) = (Vec::new(), Vec::with_capacity(12 * triangles.len()));
    for corner in triangles.iter().flatten() {
        let next = places.len() as u32;
        let place = *places.entry(corner.map(f64::to_bits)).or_insert_with(|| {
            corner.iter().for_each(|coordinate| corners.extend(coordinate.to_le_bytes()));
            next
        });
        of_triangles.extend(place.to_le_bytes());
    }
    STANDARD.encode([&(places.len() as u32).to_le_bytes()[..], &corners, &of_triangles].concat())
}

/// The triangles of a text; none where it says none.
fn unpacked(text: &str) -> Option<Vec<Triangle>> {
    let bytes = STANDARD.decode(text).ok()?;
    let (number, rest) = bytes.split_first_chunk()?;
    let (corners, of_triangles) = rest.split_at_checked((u32::from_le_bytes(*number) as usize).checked_mul(24)?)?;
    let (numbers, []) = corners.as_chunks::<8>() else { return None };
    let (corners, _) = numbers.as_chunks::<3>();
    let (places, []) = of_triangles.as_chunks::<4>() else { return None };
    let (of_triangles, []) = places.as_chunks::<3>() else { return None };
    let corner = |place: [u8; 4]| {
        let corner = corners.get(u32::from_le_bytes(place) as usize)?.map(f64::from_le_bytes);
        corner.iter().all(|coordinate| coordinate.is_finite()).then_some(corner)
    };
    let triangle = |&[a, b, c]: &[[u8; 4]; 3]| Some([corner(a)?, corner(b)?, corner(c)?]);
    (of_triangles.len() <= MOST_TRIANGLES).then(|| of_triangles.iter().map(triangle).collect())?
}

impl From<String> for PackedTriangles {
    fn from(text: String) -> Self {
        let triangles = unpacked(&text).unwrap_or_default();
        let (bounds, area) = (bounds_of(&triangles), triangles.iter().map(area_of).sum());
        Self { text: text.into(), triangles: triangles.into(), bounds, area }
    }
}

impl From<PackedTriangles> for String {
    fn from(packed: PackedTriangles) -> Self {
        packed.text.as_ref().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn triangles_return_to_the_last_bit_and_a_corner_is_written_once() {
        let [a, b, c, d] = [[0.1, -0.0, 1e-300], [1.0 / 3.0, 2.0, 3.0], [4.0, 5.5, -6.0], [7.0, 8.0, 9.0]];
        let triangles = vec![[a, b, c], [c, b, d]];
        let text = packed(&triangles);
        assert_eq!(text.len(), (4_usize + 4 * 24 + 6 * 4).div_ceil(3) * 4);
        let found = unpacked(&text).expect("triangles");
        let bits = |triangles: &[Triangle]| -> Vec<u64> {
            triangles.as_flattened().as_flattened().iter().map(|x| x.to_bits()).collect()
        };
        assert_eq!(bits(&found), bits(&triangles));
        let whole: PackedTriangles = serde_json::from_value(serde_json::json!(text)).expect("read");
        assert_eq!(serde_json::to_value(&whole).expect("written"), serde_json::json!(text));
        assert_eq!((whole.damage(), PackedTriangles::default().damage()), (None, None));
        let damaged: PackedTriangles = serde_json::from_value(serde_json::json!(text[4..])).expect("read");
        assert_eq!(damaged.damage(), Some(format!("\"{}\"", &text[4..16])));
        for wrong in ["A", "AAAA", &packed(&[[[f64::NAN; 3]; 3]]), &text[4..]] {
            assert_eq!(unpacked(wrong), None, "{wrong}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn any_bytes_are_triangles_or_none(bytes in prop::collection::vec(any::<u8>(), 0..200), corners in 0_u8..4) {
            let bytes = [&[corners, 0, 0, 0][..], &bytes].concat();
            if let Some(triangles) = unpacked(&STANDARD.encode(&bytes)) {
                prop_assert!(12 * triangles.len() <= bytes.len());
            }
        }
    }
}
