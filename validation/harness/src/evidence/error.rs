//! Errors of a reference: a data file, or parameters that have no reference solution.

/// A reference that cannot be read or computed. Data errors name file, line and column, each counted from 1.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// The file cannot be read.
    #[error("read the reference data {file}: {source}")]
    Unreadable {
        /// File as the caller named it.
        file: String,
        /// The operating system's reason.
        source: std::io::Error,
    },
    /// No table of this name belongs to the program.
    #[error("read the reference data {name}: the program carries no such table")]
    NotShipped {
        /// The name asked for.
        name: String,
    },
    /// A metadata line is not `# key: value` with a known key and an allowed value.
    #[error("read the reference data {file}, line {line}: `{text}` {rule}")]
    Metadata {
        /// File as the caller named it.
        file: String,
        /// Line of the file.
        line: u64,
        /// Offending text of the line.
        text: String,
        /// Rule that the text breaks, and its replacement.
        rule: String,
    },
    /// A required metadata line is absent.
    #[error("read the reference data {file}: the line `# {key}: …` is missing; add it above the table")]
    MissingMetadata {
        /// File as the caller named it.
        file: String,
        /// The absent key.
        key: &'static str,
    },
    /// The table's shape or text is wrong.
    #[error("read the reference data {file}, line {line}, column {column}: {rule}")]
    Table {
        /// File as the caller named it.
        file: String,
        /// Line of the file.
        line: u64,
        /// Column of the table.
        column: usize,
        /// Rule that the table breaks, and the remedy.
        rule: String,
    },
    /// A number column holds something else.
    #[error(
        "read the reference data {file}, line {line}, column {column} (`{name}`): `{text}` is not a finite measured value; \
         write one with a decimal point, or drop the row"
    )]
    Number {
        /// File as the caller named it.
        file: String,
        /// Line of the file.
        line: u64,
        /// Column of the table.
        column: usize,
        /// Name of the column.
        name: String,
        /// Offending text of the cell.
        text: String,
    },
    /// The table has no such column.
    #[error("read the reference data {file}: there is no {kind} column `{name}`; its columns are {known}")]
    NoColumn {
        /// File as the caller named it.
        file: String,
        /// "number" or "label".
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// The table has no such row.
    #[error("read the reference data {file}: no row has `{label}` in the column `{column}`; there are {known}")]
    NoRow {
        /// File as the caller named it.
        file: String,
        /// The column of labels.
        column: String,
        /// The label asked for.
        label: String,
        /// The labels there are.
        known: String,
    },
    /// A label is none of those that its column may hold.
    #[error("read the reference data {file}: `{label}` in the column `{column}` is not one of {allowed}")]
    Label {
        /// File as the caller named it.
        file: String,
        /// The column of labels.
        column: String,
        /// Offending label.
        label: String,
        /// Labels that are allowed in the column.
        allowed: &'static str,
    },
}
