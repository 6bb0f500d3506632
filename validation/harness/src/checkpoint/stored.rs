//! States in files, from which scenes start that need not be the scene that has left them.

use super::STATE;
use sha2::{Digest, Sha256};
use std::path::Path;

/// Properties that a state and a scene that starts from it share: paths of fields with their values.
pub type Likeness = Vec<(String, String)>;

/// Name of the bulk modulus `[Pa]` among the properties of a scene that leaves a state.
pub const BULK_MODULUS: &str = "from.bulk_modulus";

/// A state in a file.
#[derive(Debug)]
pub struct StoredState {
    /// The state as a checkpoint holds it.
    pub contents: Vec<u8>,
    /// SHA-256 of the contents.
    pub digest: String,
}

impl StoredState {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that holds no whole state, in words.
    pub fn read(path: &Path) -> Result<Self, String> {
        let contents = STATE.read(path, None).map_err(|refused| format!("it {refused}"))?;
        let digest = Sha256::digest(&contents).iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { contents, digest })
    }

    /// A property of the scene that has left it, by its name; none where the state has no such property.
    pub fn property(&self, name: &str) -> Option<String> {
        let (likeness, _): (Likeness, _) = postcard::take_from_bytes(&self.contents).ok()?;
        likeness.into_iter().find_map(|(own, value)| (own == name).then_some(value))
    }

    /// The first property in which a scene of a likeness differs, with the scene's value and the state's.
    ///
    /// # Errors
    /// A state without a likeness: it is none of a scene.
    pub fn difference(&self, scene: &Likeness) -> Result<Option<[String; 3]>, String> {
        let read: Option<Likeness> = postcard::take_from_bytes(&self.contents).ok().map(|(likeness, _)| likeness);
        // the first property of every scene
        let same_kind = |own: &Likeness| own.first().map(|first| &first.0) == scene.first().map(|first| &first.0);
        let own = read.filter(same_kind).ok_or("it does not hold the state of a scene")?;
        let value = |of: &Likeness, path: &str| {
            of.iter().find(|(own, _)| own == path).map_or_else(|| "absent".to_owned(), |(_, value)| value.clone())
        };
        let paths = scene.iter().chain(&own).map(|(path, _)| path);
        let mut compared = paths.map(|path| [path.clone(), value(scene, path), value(&own, path)]);
        Ok(compared.find(|[_, scene, own]| scene != own))
    }
}
