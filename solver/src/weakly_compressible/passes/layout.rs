//! How many numbers the passes read of a neighbour, in a record of its own for each.

/// Values of the geometry pass: position, volume, pressure.
pub(crate) const fn geometry(dimension: usize) -> usize {
    dimension + 2
}

/// Values of the momentum pass: those of a flow particle, which are more than those of a wall particle.
pub(super) const fn momentum(dimension: usize) -> usize {
    2 * dimension + 3 + 2 * dimension * dimension
}

/// Values of the continuity pass.
pub(super) const fn continuity(dimension: usize) -> usize {
    3 * dimension + 1
}
