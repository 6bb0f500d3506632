//! Steady films of viscous liquids on an incline.

mod eddy_film;
mod exact;
mod law_film;
mod steady_film;

pub use eddy_film::EddyFilm;
pub use exact::{BinghamFilm, HerschelBulkleyFilm, Incline, NewtonianFilm};
pub use law_film::LawFilm;
pub use steady_film::SteadyFilm;
