//! That eight lanes of every instruction set give a law with a field the bits of one value.

use super::field::FieldStep;
use super::{ElasticModuli, Rheology};
use crate::lanes::algebra::{load_tensor, store_tensor};
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes};
use crate::vector::Tensor;

/// A law sheared under one pressure `[Pa]` per lane, which decreases as the law dilates.
pub(super) struct ShearedLaw {
    pub(super) law: Rheology,
    pub(super) pressure: [f64; LANES],
    pub(super) moduli: ElasticModuli,
    /// `[s]`
    pub(super) time_step: f64,
    pub(super) steps: usize,
    pub(super) initial_field: f64,
    /// Gain and loss of the field by its neighbours.
    pub(super) exchange: (f64, f64),
}

struct Update<'a> {
    sheared: &'a ShearedLaw,
    stress: &'a mut [Tensor<3>; LANES],
    field: &'a mut [f64; LANES],
}

impl LanePass for Update<'_> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let ShearedLaw { law, pressure, moduli, time_step, steps, exchange: (gain, loss), .. } = self.sheared;
        let gradient = load_tensor::<V, 3>(&[gradient(); LANES]);
        for _ in 0..*steps {
            let stress = load_tensor::<V, 3>(self.stress);
            let field = FieldStep::new(V::load(self.field), V::splat(*gain), V::splat(*loss));
            let pressure = V::load(pressure) * law.loosening(field.value);
            let end = law.updated_states(&stress, &gradient, pressure, &field, *moduli, *time_step);
            store_tensor(&end.stress, self.stress);
            *self.field = end.field.to_array();
        }
    }
}

fn gradient() -> Tensor<3> {
    Tensor::<3>::new(0.5, 3.0, -1.0, 0.2, -0.4, 0.0, 1.0, 2.0, 0.1)
}

impl ShearedLaw {
    /// Stress `[Pa]` and field of every lane in the end, the same for one value and for all instruction sets.
    pub(super) fn check(&self) -> ([Tensor<3>; LANES], [f64; LANES]) {
        let (mut expected, mut fields) = ([Tensor::<3>::zeros(); LANES], [self.initial_field; LANES]);
        for lane in 0..LANES {
            for _ in 0..self.steps {
                let field = FieldStep::new(fields[lane], self.exchange.0, self.exchange.1);
                let loosening: f64 = self.law.loosening(fields[lane]);
                let (pressure, stress) = (self.pressure[lane] * loosening, expected[lane]);
                let (moduli, step) = (self.moduli, self.time_step);
                let end = self.law.updated_state_of_volume(&stress, &gradient(), pressure, &field, moduli, step);
                (expected[lane], fields[lane]) = end.stress_and_field();
            }
        }
        for set in InstructionSet::available() {
            let (mut stress, mut field) = ([Tensor::<3>::zeros(); LANES], [self.initial_field; LANES]);
            set.run(Update { sheared: self, stress: &mut stress, field: &mut field });
            assert_eq!(stress, expected, "{}", set.name());
            assert_eq!(field.map(f64::to_bits), fields.map(f64::to_bits), "{}", set.name());
        }
        (expected, fields)
    }
}
