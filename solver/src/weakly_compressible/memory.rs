//! Memory that a law keeps of each particle beside its field, an array of a few values per particle.

use crate::lanes::{LANES, Lanes};
use crate::material::rheology::field::{FieldStep, LawField, MOST_MEMORIES, Memory};

/// Initial memory of particles; none for a law without a memory.
pub(crate) fn initial(memories: &[LawField]) -> Option<Memory<f64>> {
    let mut initial = Memory::default();
    for (value, memory) in initial.iter_mut().zip(memories) {
        *value = memory.initial;
    }
    (!memories.is_empty()).then_some(initial)
}

/// Field and memory at a place of their arrays; zero of a law without.
#[inline(always)]
pub(crate) fn kept(field: Option<&[f64]>, memory: Option<&[Memory<f64>]>, index: usize) -> FieldStep<f64> {
    let memory = memory.map_or(Memory::default(), |memory| memory[index]);
    FieldStep::alone(field.map_or(0.0, |field| field[index])).with_memory(memory)
}

/// Memory of eight particles or fewer; zero in the remaining lanes.
#[inline(always)]
pub(crate) fn load<V: Lanes>(memories: &[Memory<f64>]) -> Memory<V> {
    let mut lanes = [[0.0; LANES]; MOST_MEMORIES];
    for (lane, memory) in memories.iter().enumerate() {
        for (place, &value) in memory.iter().enumerate() {
            lanes[place][lane] = value;
        }
    }
    lanes.map(|values| V::load(&values))
}

/// Writes that of as many particles as `out` has.
#[inline(always)]
pub(crate) fn store<V: Lanes>(lanes: &Memory<V>, out: &mut [Memory<f64>]) {
    for (place, values) in lanes.iter().enumerate() {
        for (out, value) in out.iter_mut().zip(values.to_array()) {
            out[place] = value;
        }
    }
}
