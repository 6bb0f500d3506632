//! User input: its fields, the names in it and the places, so that an error can point at them.

mod escape;
mod field;
mod measured_files;
mod mesh;
mod name;
mod packed_triangles;
mod reading;
mod table;
mod text_table;
pub mod unit;

pub use escape::{escaped, escaped_lines, is_control, shown};
pub(crate) use field::before;
pub use field::{FieldError, Origin};
pub use measured_files::{MeasuredFiles, check_stated, renamed};
pub(crate) use mesh::{MOST_TRIANGLES, Triangle, read_mesh};
pub use name::{
    check_name, check_text, did_you_mean, is_same_heading, is_uncertainty, name_and_unit, nearest, parted, unnumbered,
};
pub use packed_triangles::PackedTriangles;
pub(crate) use packed_triangles::packed;
pub use reading::{DOCUMENT, STORED, WRITTEN_BY_HAND, open_file, read_bytes, read_own, read_text};
pub use table::{is_mark, plain_lines, text_fault};
pub use text_table::{TableRows, TextTable, of_repeats};

/// The number of a value of TOML, which may be written without a point; none for another type.
pub fn number_in(value: &toml::Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}
