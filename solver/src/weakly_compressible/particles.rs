//! The particles as a structure of arrays: flow, walls, images and the sentinel, in this order.

use crate::lanes::algebra::load;
use crate::lanes::{LaneTensors, Lanes};
use crate::material::rheology::Rheology;
use crate::material::rheology::field::{FieldStep, Memory};
use crate::parallel::prelude::*;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::Images;
use crate::weakly_compressible::memory;
use crate::weakly_compressible::wall_fields::{WallFields, resize};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A far place for the sentinel, in units of the smoothing length `[-]`.
const FAR: f64 = 1e9;

/// All particle arrays.
///
/// Arrays of the first group have an entry for every particle (shape `[flow + wall + images + 1]`), arrays of the
/// second for every flow particle (shape `[flow]`). The flow particles are kept sorted by cell. Pressures, corrected stresses,
/// pressure gradients and accelerations are made anew in every step before they are read, so a search uses their arrays as room.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Particles<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`; on walls the extrapolated ones.
    pub velocity: Vec<Vector<D>>,
    /// Velocity gradients `[1/s]`.
    pub velocity_gradient: Vec<Tensor<D>>,
    /// Deviatoric stresses `[Pa]`; on walls the extrapolated ones.
    pub stress: Vec<Tensor<D>>,
    /// Densities `[kg/m³]`.
    pub density: Vec<f64>,
    /// Pressures `[Pa]`; on walls the extrapolated ones.
    pub pressure: Vec<f64>,
    /// Volumes m/ρ `[m^D]`; on walls Δ^D, zero for the sentinel.
    pub volume: Vec<f64>,
    /// Coefficient α of the artificial viscosity `[-]`.
    pub artificial_viscosity: Vec<f64>,
    /// Stress as the momentum equation takes it `[Pa]`: σE on flow particles, σ on walls.
    pub(crate) corrected_stress: Vec<Tensor<D>>,
    /// Corrected pressure gradients `[Pa/m]`.
    pub(crate) pressure_gradient: Vec<Vector<D>>,
    /// Apparent viscosities `[Pa·s]`, for the pairwise operators.
    pub(crate) viscosity: Vec<f64>,
    /// Field of the law for each particle, in the unit of its [`LawField`](crate::material::rheology::field::LawField),
    /// zero on walls; none for a law without a field.
    pub field: Option<Vec<f64>>,
    /// Memory of the law beside its field, zero on walls; none for a law without a memory.
    pub memory: Option<Vec<Memory<f64>>>,
    /// Fields of wall particles alone.
    pub(crate) walls: WallFields<D>,
    /// 0 for all real particles together, then for every image 1 if it is behind a mirror, and the sentinel `[-]`.
    pub(crate) mirrored: Vec<f64>,

    /// Identity of each particle: its place in the scene; particles that inlets feed are counted on from there.
    pub identity: Vec<u32>,
    /// Masses `[kg]` (per metre of depth in 2-D).
    pub mass: Vec<f64>,
    /// Correction L for gradients `[-]`.
    pub(crate) correction: LaneTensors<D>,
    /// Correction E for forces `[-]`.
    pub(crate) force_correction: LaneTensors<D>,
    /// Accelerations `[m/s²]`.
    pub(crate) acceleration: Vec<Vector<D>>,
    /// The part of the accelerations that walls and mirrors cause `[m/s²]`.
    pub(crate) support: Vec<Vector<D>>,
    /// Accelerations by the tractions of walls `[m/s²]`.
    pub(crate) by_walls: Vec<Vector<D>>,
    /// Accelerations by artificial viscosity and hourglass control among the flow `[m/s²]`.
    pub(crate) by_damping: Vec<Vector<D>>,
    /// Accelerations by the hourglass control at walls `[m/s²]`.
    pub(crate) by_wall_control: Vec<Vector<D>>,
    /// Impulse that walls, mirrors and contacts have given each particle since the start `[kg m/s]`.
    pub(crate) support_impulse: Vec<Vector<D>>,

    /// Wall of each wall particle, shape `[wall]`.
    pub(super) wall: Vec<u32>,
    pub(super) flow: usize,
}

/// Applies a statement to every array of the first group.
macro_rules! for_each_shared_array {
    ($particles:ident, $array:ident => $body:expr) => {
        for_each_shared_array!($particles, $array => $body, in &mut)
    };
    ($particles:ident, $array:ident => $body:expr, in $($reference:tt)+) => {
        for_each_shared_array!($particles, $array => $body, of position velocity velocity_gradient stress density
            pressure volume artificial_viscosity corrected_stress pressure_gradient viscosity; $($reference)+)
    };
    ($particles:ident, $array:ident => $body:expr, of $($field:ident)*; &mut) => {
        $({
            let $array = &mut $particles.$field;
            $body;
        })*
    };
    ($particles:ident, $array:ident => $body:expr, of $($field:ident)*; &) => {
        $({
            let $array = &$particles.$field;
            $body;
        })*
    };
}

impl<const D: usize> Particles<D> {
    /// Moves the wall particles with their walls, from `first` on, by displacements `[m]`, to these velocities `[m/s]` by wall and lever
    /// `[m]`; those of other walls stay.
    pub(crate) fn move_walls(
        &mut self,
        first: usize,
        displacements: &[Vector<D>],
        velocity: impl Fn(usize, &Vector<D>) -> Vector<D>,
    ) {
        for (offset, &wall) in self.wall.iter().enumerate() {
            let Some(wall) = (wall as usize).checked_sub(first).filter(|&wall| wall < displacements.len()) else {
                continue;
            };
            self.position[self.flow + offset] += displacements[wall];
            self.walls.velocity[offset] = velocity(wall, &self.walls.lever[offset]);
        }
    }

    /// Field and memory of a particle, by its storage index.
    #[inline(always)]
    pub(crate) fn kept(&self, index: usize) -> FieldStep<f64> {
        memory::kept(self.field.as_deref(), self.memory.as_deref(), index)
    }

    /// Field and memory of eight flow particles.
    #[inline(always)]
    pub(crate) fn kept_by<V: Lanes>(&self, places: Range<usize>) -> FieldStep<V> {
        let field = self.field.as_ref().map_or(V::splat(0.0), |field| load::<V>(&field[places.clone()]));
        let step = FieldStep::alone(field);
        match &self.memory {
            Some(memory) => step.with_memory(memory::load(&memory[places])),
            None => step,
        }
    }

    /// Whether a storage index is that of a wall particle or of its image.
    #[inline(always)]
    pub(crate) fn is_wall(&self, index: usize) -> bool {
        index >= self.flow && self.walls.depth[index - self.flow] > 0.0
    }

    /// Makes room for flow particles behind the others, and returns their places; there are no images now. All their values are zero.
    pub(crate) fn insert(&mut self, count: usize) -> Range<usize> {
        let (flow, end) = (self.flow, self.flow + count);
        for_each_shared_array!(self, array => {
            array.splice(flow..flow, std::iter::repeat_n(nalgebra::zero(), count));
        });
        if let Some(field) = &mut self.field {
            field.splice(flow..flow, std::iter::repeat_n(0.0, count));
        }
        if let Some(memory) = &mut self.memory {
            memory.splice(flow..flow, std::iter::repeat_n(Memory::default(), count));
        }
        self.flow = end;
        self.identity.resize(end, 0);
        self.mass.resize(end, 0.0);
        self.correction.resize(end);
        self.force_correction.resize(end);
        let Self { acceleration, support, by_walls, by_damping, by_wall_control, support_impulse, .. } = self;
        for array in [acceleration, support, by_walls, by_damping, by_wall_control, support_impulse] {
            array.resize(end, Vector::zeros());
        }
        flow..end
    }

    /// Removes flow particles; there must be no images.
    pub(crate) fn remove(&mut self, gone: &[bool]) {
        let flow = self.flow;
        for_each_shared_array!(self, array => retain(array, |index| index >= flow || !gone[index]));
        if let Some(field) = &mut self.field {
            retain(field, |index| index >= flow || !gone[index]);
        }
        if let Some(memory) = &mut self.memory {
            retain(memory, |index| index >= flow || !gone[index]);
        }
        let Self { identity, mass, correction, force_correction, acceleration, support, .. } = self;
        retain(identity, |index| !gone[index]);
        retain(mass, |index| !gone[index]);
        let left = mass.len();
        correction.resize(left);
        force_correction.resize(left);
        let Self { by_walls, by_damping, by_wall_control, support_impulse, .. } = self;
        for array in [acceleration, support, by_walls, by_damping, by_wall_control, support_impulse] {
            retain(array, |index| !gone[index]);
        }
        self.flow -= gone.iter().filter(|&&gone| gone).count();
    }

    /// Number of flow particles.
    #[must_use]
    pub fn flow_count(&self) -> usize {
        self.flow
    }

    /// Number of wall particles.
    #[must_use]
    pub fn wall_count(&self) -> usize {
        self.wall.len()
    }

    /// Number of flow and wall particles.
    #[must_use]
    pub fn real_count(&self) -> usize {
        self.flow + self.wall.len()
    }

    /// Drops images and sentinel.
    pub(crate) fn keep_real(&mut self) {
        let real = self.real_count();
        for_each_shared_array!(self, array => array.truncate(real));
        if let Some(field) = &mut self.field {
            field.truncate(real);
        }
        if let Some(memory) = &mut self.memory {
            memory.truncate(real);
        }
    }

    /// Makes room for images and sentinel and fills what never changes between two neighbour searches.
    pub(crate) fn append_images(&mut self, images: &Images<D>) {
        let total = self.real_count() + images.len() + 1;
        let real = self.real_count();
        for_each_shared_array!(self, array => resize(array, real, total, nalgebra::zero()));
        if let Some(field) = &mut self.field {
            resize(field, real, total, 0.0);
            images.copy_scalars(field);
        }
        if let Some(memory) = &mut self.memory {
            resize(memory, real, total, Memory::default());
            images.copy_scalars(memory);
        }
        images.copy_positions(&mut self.position);
        images.copy_vectors(&mut self.velocity);
        images.copy_tensors(&mut self.velocity_gradient);
        images.copy_tensors(&mut self.stress);
        images.copy_scalars(&mut self.density);
        images.copy_scalars(&mut self.volume);
        images.copy_scalars(&mut self.artificial_viscosity);
        self.walls.append_images(images, self.wall.len());
        resize(&mut self.mirrored, 0, images.len() + 2, 0.0);
        images.mark_mirrored(&mut self.mirrored[1..]);
        let sentinel = total - 1;
        self.position[sentinel] = Vector::repeat(FAR);
        self.density[sentinel] = 1.0;
        self.viscosity[sentinel] = 1.0;
    }

    /// Sorts the flow particles into the given order: `order[new] = old`. There are no images now.
    pub(crate) fn sort_flow(&mut self, order: &[u32], identities: &mut Vec<u32>, memories: &mut Vec<Memory<f64>>) {
        let Self { position, velocity, velocity_gradient, stress, density, volume, artificial_viscosity, .. } = self;
        let Self { viscosity, corrected_stress, pressure_gradient, pressure, acceleration, field, .. } = self;
        for vectors in [position, velocity] {
            permute(vectors, order, pressure_gradient);
        }
        for tensors in [velocity_gradient, stress] {
            permute(tensors, order, corrected_stress);
        }
        for scalars in [density, volume, artificial_viscosity, viscosity] {
            permute(scalars, order, pressure);
        }
        if let Some(field) = field {
            permute(field, order, pressure);
        }
        if let Some(memory) = &mut self.memory {
            memories.resize(memory.len(), Memory::default());
            permute(memory, order, memories);
        }
        permute(&mut self.support_impulse, order, acceleration);
        gather(&self.mass, order, &mut pressure[..order.len()]);
        self.mass.copy_from_slice(&pressure[..order.len()]);
        identities.resize(order.len(), 0);
        permute(&mut self.identity, order, identities);
    }

    /// Whether every array has its length, with this number of images, and every particle one identity of those that the scene
    /// began with; what is kept of them is what the law keeps.
    pub(crate) fn are_complete(&self, images: usize, begun: usize, law: &Rheology) -> bool {
        let Self { identity, mass, correction, force_correction, acceleration, support, by_walls, by_damping, .. } =
            self;
        let Self { by_wall_control, support_impulse, flow, .. } = self;
        let of_flow = [identity.len(), mass.len(), acceleration.len()];
        let beside = [support.len(), by_walls.len(), by_damping.len(), by_wall_control.len(), support_impulse.len()];
        let mut complete = of_flow.into_iter().chain(beside).all(|length| length == *flow);
        complete &= correction.is_for(*flow) && force_correction.is_for(*flow);
        let total = self.real_count() + images + 1;
        for_each_shared_array!(self, array => complete &= array.len() == total, in &);
        complete &= self.field.as_ref().map(Vec::len) == law.field().is_some().then_some(total);
        complete &= self.memory.as_ref().map(Vec::len) == (!law.memories().is_empty()).then_some(total);
        complete &= self.walls.are_as_long_as(total - flow) && self.mirrored.len() == images + 2;
        let mut seen = vec![false; begun];
        for &identity in identity {
            complete &= seen.get_mut(identity as usize).is_some_and(|seen| !std::mem::replace(seen, true));
        }
        complete
    }

    /// Flow indices in the order of their identity.
    #[must_use]
    pub fn by_identity(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.flow).collect();
        order.sort_unstable_by_key(|&index| self.identity[index]);
        order
    }
}

/// Keeps the entries at some places.
fn retain<T>(array: &mut Vec<T>, keep: impl Fn(usize) -> bool) {
    let mut index = 0;
    array.retain(|_| {
        index += 1;
        keep(index - 1)
    });
}

/// Brings the first values of an array into an order; the others stay. What `room`, an array of the same length, held is lost.
fn permute<T: Copy + Send + Sync>(array: &mut Vec<T>, order: &[u32], room: &mut Vec<T>) {
    gather(array, order, &mut room[..order.len()]);
    room[order.len()..].copy_from_slice(&array[order.len()..]);
    std::mem::swap(array, room);
}

fn gather<T: Copy + Send + Sync>(array: &[T], order: &[u32], out: &mut [T]) {
    (out, order).with_min_len(4096).for_each(|(new, &old)| *new = array[old as usize]);
}
