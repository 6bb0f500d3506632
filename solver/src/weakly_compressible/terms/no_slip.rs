//! Viscous traction of a rough wall, from the velocity that vanishes at its surface.
//!
//! A stress that a wall particle takes from the flow around it is right where it grows with the pressure, as friction does. A
//! viscous stress does not: scaled by a pressure that falls towards the wall it lets a liquid slip, and constant or as a fitted line
//! it leaves the row at the wall without a bond to it, for a gradient over many rows does not feel a zigzag. So the part of a law's
//! stress that needs no pressure follows from the velocity itself: between a flow particle and a wall particle, on the line
//! through zero at the surface, the shear rate is v_t/d_a, whatever the law (Morris, Fox & Zhu 1997; Adami, Hu & Adams 2012). In plane
//! Couette flow this is the traction of the exact stress to rounding.

use crate::lanes::Real;
use crate::lanes::algebra::{difference, dot, product, scaled};

/// Replacement of the slip β (v_a − v_wall) `[m/s]` where the shear rate changes with the distance: β (v_a − v_wall) is
/// right in the middle between a and the surface, a's own gradient at a, and the line through both gives the shear rate
/// in the middle between a and w, min(1, d_w/d_a) times their difference further on, along the wall: across it the
/// velocity has no slope at the surface. Without it the surface of a curved profile lies 0.05 Δ too far back.
#[inline(always)]
pub fn slip_at_middle<V: Real, const D: usize>(
    slip: &[V; D],
    beta: V,
    velocity_gradient: &[[V; D]; D],
    normal: &[V; D],
    r: &[V; D],
) -> [V; D] {
    let height = dot(normal, r);
    let further = (beta - V::splat(1.0)).min(V::splat(1.0));
    let change = difference(slip, &scaled(height, &product(velocity_gradient, normal)));
    let across = dot(&change, normal);
    let mut lanes = *slip;
    for i in 0..D {
        lanes[i] = slip[i] + further * (change[i] - across * normal[i]);
    }
    lanes
}

/// By how much what [`slip_at_middle`] gives changes with the velocity of a particle whose gradient stays `[-]`.
#[inline(always)]
pub fn response<V: Real>(beta: V) -> V {
    beta * beta.min(V::splat(2.0))
}

/// Δt 2 (η/ρ) Σ_w (−V F) β min(β, 2) up to which all of the resistance is left to an explicit step `[-]`; beyond 2 it would overshoot.
const MOST: f64 = 1.6;

/// Part of the resistance Σ_w (−V F) β min(β, 2) `[1/m²]` of all wall partners that an explicit step of the viscous bound bears, `bound` its
/// C h² `[m²]` `[-]`: all of it on a lattice before a plane, less in edges and close to the surface, where nearly nothing flows.
#[inline(always)]
pub fn borne<V: Real>(resistance: V, bound: f64) -> V {
    let taken = V::splat(2.0 * bound) * resistance;
    (V::splat(MOST) / taken).if_less(V::splat(MOST), taken, V::splat(1.0))
}

/// (n·E r)/(n·r) `[-]`, kept between 0 and 2: where few neighbours make E large, a wall would push a particle on otherwise. Beside an edge a
/// wall particle may stand in front of its own surface: there the correction does not matter.
#[inline(always)]
pub fn stretch<V: Real, const D: usize>(normal: &[V; D], r: &[V; D], corrected: &[V; D]) -> V {
    let height = dot(normal, r);
    let within = (dot(normal, corrected) / height).max(V::splat(0.0)).min(V::splat(2.0));
    within.if_less(V::splat(0.0), height, V::splat(1.0))
}

/// 2 η (v_t/d_a) (n·E r) `[Pa m]`: `slip` is β (v_a − v_wall) `[m/s]`, which is v_t (n·r)/d_a, `normal` n that of the wall into
/// the flow, `r` r_aw `[m]` and `corrected` E r `[m]`.
#[inline(always)]
pub fn traction<V: Real, const D: usize>(
    twice_viscosity: V,
    slip: &[V; D],
    normal: &[V; D],
    r: &[V; D],
    corrected: &[V; D],
) -> [V; D] {
    scaled(twice_viscosity * stretch(normal, r, corrected), slip)
}
