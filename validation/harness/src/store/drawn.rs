//! Drawn figures on disk: what this program has drawn once from the same data is not drawn again.

use super::provenance::simulation_hash;
use super::{DRAWN, Store, StorePolicy, adopt, entry, hexadecimal};
use crate::figure::FigureFormat;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Cache of drawings: its folder, if any, the size of figures, and the number of drawings that had to be made.
#[derive(Debug, Default)]
pub struct Drawings {
    /// Folder of this version of the sources; none where nothing is kept.
    folder: Option<PathBuf>,
    /// Whether drawings that are kept are replaced.
    anew: bool,
    made: AtomicUsize,
    format: FigureFormat,
}

/// Key of a drawing: hash of its data and of the sources of the drawing code.
#[derive(Debug, Clone)]
pub struct DrawingKey(Option<String>);

impl Store {
    /// The drawings of this version of the sources.
    pub fn drawings(&self) -> Drawings {
        let folder = (self.policy != StorePolicy::Bypass).then(|| self.folder.join(DRAWN));
        Drawings { folder, anew: self.policy == StorePolicy::Refresh, ..Drawings::default() }
    }
}

impl Drawings {
    /// Store of drawings in another format.
    pub fn in_format(self, format: FigureFormat) -> Self {
        Self { format, ..self }
    }

    /// Format of the figures: their size.
    pub fn format(&self) -> FigureFormat {
        self.format
    }

    /// The key of what is drawn.
    pub fn key(&self, data: &impl Serialize) -> DrawingKey {
        let of = |bytes: Vec<u8>| {
            let mut hash = Sha256::new();
            hash.update(simulation_hash("drawing", ""));
            hash.update(bytes);
            hexadecimal(&hash.finalize())
        };
        let serialised = || {
            postcard::to_stdvec(data)
                .inspect_err(|error| tracing::warn!("a drawing cannot be kept, its data do not serialise: {error}"))
        };
        DrawingKey(self.folder.as_ref().and_then(|_| serialised().ok()).map(of))
    }

    /// The kept drawing with an ending such as `svg`, or the one that is made now and kept. A kept one that is damaged is made
    /// again, and one that cannot be kept costs time only.
    ///
    /// # Errors
    /// That of `draw`.
    pub fn bytes<E>(
        &self,
        key: &DrawingKey,
        ending: &str,
        draw: impl FnOnce() -> Result<Vec<u8>, E>,
    ) -> Result<Vec<u8>, E> {
        let place = self.folder.as_ref().zip(key.0.as_ref()).map(|(folder, key)| {
            let name = format!("{key}.{ending}");
            (folder.join(&name), name)
        });
        if let Some((path, name)) = place.as_ref().filter(|_| !self.anew) {
            if let Some(version) = self.folder.as_ref().and_then(|folder| folder.parent()) {
                adopt(version, path);
            }
            match entry::read_bytes(path, name) {
                Ok(Some(bytes)) => return Ok(bytes),
                Ok(None) => {}
                Err(damage) => tracing::warn!("kept drawing {}: {damage}; drawn again", path.display()),
            }
        }
        self.made.fetch_add(1, Ordering::Relaxed);
        let bytes = draw()?;
        if let Some((path, name)) = &place
            && let Err(error) = entry::RECORD.write(path, name, &bytes)
        {
            tracing::debug!("drawing {}: not kept: {error}", path.display());
        }
        Ok(bytes)
    }

    /// Number of drawings that had to be made.
    pub fn made(&self) -> usize {
        self.made.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;
    use std::path::Path;

    /// Drawing returned for some data if `fresh` would be drawn, and the number of drawings made for it.
    fn drawn(folder: &Path, policy: StorePolicy, data: f64, fresh: &str) -> (String, usize) {
        let drawings = Store::at(folder, policy).drawings();
        let draw = || Ok::<_, Infallible>(fresh.as_bytes().to_vec());
        let bytes = drawings.bytes(&drawings.key(&data), "svg", draw).expect("drawn");
        (String::from_utf8(bytes).expect("text"), drawings.made())
    }

    #[test]
    fn a_drawing_is_made_once_and_anew_where_its_data_or_the_policy_ask_for_it() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let at = |policy, data, fresh| drawn(folder.path(), policy, data, fresh);
        assert_eq!(at(StorePolicy::Use, 1.0, "first"), ("first".to_owned(), 1));
        assert_eq!(at(StorePolicy::Use, 1.0, "second"), ("first".to_owned(), 0));
        assert_eq!(at(StorePolicy::Use, 2.0, "second"), ("second".to_owned(), 1), "other data");
        assert_eq!(at(StorePolicy::Bypass, 1.0, "third"), ("third".to_owned(), 1));
        assert_eq!(at(StorePolicy::Use, 1.0, "fourth"), ("first".to_owned(), 0), "a bypass keeps nothing");
        assert_eq!(at(StorePolicy::Refresh, 1.0, "fifth"), ("fifth".to_owned(), 1));
        assert_eq!(at(StorePolicy::Use, 1.0, "sixth"), ("fifth".to_owned(), 0));
    }

    #[test]
    fn a_damaged_drawing_is_made_again() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let at = |fresh| drawn(folder.path(), StorePolicy::Use, 1.0, fresh);
        at("first");
        let kept = Store::at(folder.path(), StorePolicy::Use).drawings().folder.expect("a folder");
        let path = std::fs::read_dir(kept).expect("kept").next().expect("one").expect("readable").path();
        let mut bytes = std::fs::read(&path).expect("readable");
        *bytes.last_mut().expect("not empty") ^= 1;
        std::fs::write(&path, &bytes).expect("writable");
        assert_eq!(at("second"), ("second".to_owned(), 1));
        assert_eq!(at("third"), ("second".to_owned(), 0));
    }

    #[test]
    fn a_store_that_cannot_be_written_costs_time_only() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let file = folder.path().join("file");
        std::fs::write(&file, "").expect("writable");
        assert_eq!(drawn(&file, StorePolicy::Use, 1.0, "first"), ("first".to_owned(), 1));
    }
}
