//! The search of candidate pairs, when one is due.

use super::super::neighbours::Layers;
use super::super::{Periods, Phase, Phases};
use super::drag_exchange::DragExchange;
use crate::domain::Domain;
use crate::run::ForeignState;

/// Schedule of the neighbour searches, and their number.
#[derive(Debug)]
pub struct Search<const D: usize> {
    /// Periods of the domain.
    pub periods: Periods<D>,
    /// Skin over the reach of the fluid's kernel `[-]`.
    skin: f64,
    /// Layers of the last search.
    pub(crate) layers: Layers<D>,
    pub(crate) searches: u64,
}

impl<const D: usize> Search<D> {
    pub(crate) fn new(domain: &Domain<D>, skin: f64) -> Self {
        Self { periods: Periods::of(domain), skin, layers: Layers::default(), searches: 0 }
    }

    /// Continues from the layers of a saved search, given the numbers of particles and searches.
    pub(crate) fn restore(&mut self, saved: Layers<D>, particles: usize, searches: u64) -> Result<(), ForeignState> {
        self.searches = searches;
        self.layers.restore(saved, particles)
    }

    /// Searches the candidates anew if a pair may be missing.
    pub(crate) fn search_if_due(&mut self, domain: &Domain<D>, phases: &mut Phases<D>, exchange: &mut DragExchange<D>) {
        let skin = self.skin * phases.fluid.kernel.support();
        if self.layers.moved_apart(phases.all().map(Phase::places), skin) {
            self.search(domain, phases, exchange);
        }
    }

    /// Searches the candidates.
    pub(crate) fn search(&mut self, domain: &Domain<D>, phases: &mut Phases<D>, exchange: &mut DragExchange<D>) {
        let skin = self.skin * phases.fluid.kernel.support();
        // cells are those of the period
        phases.wrap(domain);
        phases.fluid.search(domain, &self.periods, skin);
        let mut reach = phases.fluid.kernel.support();
        if let Some(sediment) = &mut phases.sediment {
            sediment.search(domain, &self.periods, skin);
            exchange.search(&phases.fluid, sediment, domain, &self.periods, skin);
            reach = reach.max(sediment.kernel.support()).max(exchange.reach());
        }
        self.layers.sort(phases.all().map(Phase::places), domain, reach + 2.0 * skin);
        self.searches += 1;
    }
}
