//! Relative displacement of neighbouring particles since the last search, judged by layers along the bed.
//!
//! The motion of a layer as a whole does not count, which saves most searches of a shear flow. The layers are those of
//! the search, thicker than the reach by two skins: particles whose layers are not next to each other stay out of reach
//! as long as no two successive layers move apart by a skin. Layers without particles are left out of the succession,
//! so that a drop above the surface is compared with the surface.

use super::super::height_axis;
use crate::domain::{AxisBoundary, Domain};
use crate::run::ForeignState;
use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// More layers than this are one: a stray particle far away must not buy memory.
const MOST_LAYERS: usize = 65_536;

/// Positions of the particles of a phase, and displacements of its free ones since the last search `[m]`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places<'a, const D: usize> {
    pub(crate) free: &'a [Vector<D>],
    pub(crate) fixed: &'a [Vector<D>],
    pub(crate) travel: &'a [Vector<D>],
}

/// The layers of a search.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Layers<const D: usize> {
    /// Layer of every free particle, phase after phase.
    layer: Vec<u32>,
    /// Whether fixed particles lie in a layer.
    held: Vec<bool>,
    /// Smallest and largest travel of a layer's particles `[m]`, not in order where there is none.
    #[serde(skip)]
    travels: Vec<(Vector<D>, Vector<D>)>,
    periodic: bool,
}

impl<const D: usize> Layers<D> {
    /// Restores saved layers, given the number of free particles.
    pub(crate) fn restore(&mut self, saved: Self, particles: usize) -> Result<(), ForeignState> {
        ForeignState::check("particles in layers", saved.layer.len(), particles)?;
        let inside = saved.layer.iter().filter(|&&layer| (layer as usize) < saved.held.len()).count();
        ForeignState::check("particles in known layers", inside, particles)?;
        let travels = vec![(Vector::zeros(), Vector::zeros()); saved.held.len()];
        *self = Self { travels, ..saved };
        Ok(())
    }

    /// Sorts the particles of all phases into layers at least as thick as the longest reach and two skins `[m]`.
    pub(crate) fn sort<'a>(
        &mut self,
        phases: impl Iterator<Item = Places<'a, D>> + Clone,
        domain: &Domain<D>,
        thickness: f64,
    ) {
        let normal = height_axis(D);
        let heights = phases.clone().flat_map(|phase| phase.free.iter().chain(phase.fixed)).map(|x| x[normal]);
        let (lower, upper) = domain.extent(normal, heights);
        self.periodic = matches!(domain.axes[normal], AxisBoundary::Periodic { .. });
        let count = (((upper - lower) / thickness) as usize).clamp(1, MOST_LAYERS);
        let per_height = count as f64 / (upper - lower).max(thickness);
        // a NaN goes to layer 0
        let layer = |x: &Vector<D>| (((x[normal] - lower) * per_height).max(0.0) as usize).min(count - 1);
        self.held.clear();
        if self.held.capacity() < count {
            // room for more: the highest particle may rise
            self.held.reserve(2 * count);
            self.travels.reserve(2 * count);
        }
        self.held.resize(count, false);
        self.travels.resize(count, (Vector::zeros(), Vector::zeros()));
        self.layer.clear();
        for phase in phases {
            self.layer.extend(phase.free.iter().map(|x| layer(x) as u32));
            for x in phase.fixed {
                self.held[layer(x)] = true;
            }
        }
    }

    /// Whether particles of the same layer or of successive ones have moved by `skin` `[m]` against each other.
    pub(crate) fn moved_apart<'a>(&mut self, phases: impl Iterator<Item = Places<'a, D>>, skin: f64) -> bool {
        let none = (Vector::repeat(f64::INFINITY), Vector::repeat(f64::NEG_INFINITY));
        for (travel, &held) in self.travels.iter_mut().zip(&self.held) {
            *travel = if held { (Vector::zeros(), Vector::zeros()) } else { none };
        }
        for (travel, &layer) in phases.flat_map(|phase| phase.travel).zip(&self.layer) {
            let (low, high) = &mut self.travels[layer as usize];
            for axis in 0..D {
                low[axis] = low[axis].min(travel[axis]);
                high[axis] = high[axis].max(travel[axis]);
            }
        }
        let mut filled = self.travels.iter().filter(|(low, high)| low[0] <= high[0]);
        let Some(&first) = filled.next() else { return false };
        let mut before = first;
        let mut apart = |travel: &(Vector<D>, Vector<D>)| {
            let (low, high) = (travel.0.inf(&before.0), travel.1.sup(&before.1));
            before = *travel;
            (high - low).norm_squared() >= skin * skin
        };
        let mut due = apart(&first);
        for travel in filled {
            due |= apart(travel);
        }
        due || (self.periodic && apart(&first))
    }
}
