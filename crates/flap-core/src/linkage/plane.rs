//! Vectors in the plane of a linkage.

use crate::num::Real;

/// a + b.
#[inline(always)]
pub(super) fn add<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// a − b.
#[inline(always)]
pub(super) fn sub<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// k a.
#[inline(always)]
pub(super) fn scale<R: Real>(k: R, a: [R; 2]) -> [R; 2] {
    [k * a[0], k * a[1]]
}

/// k a + b.
#[inline(always)]
pub(super) fn scale_add<R: Real>(k: R, a: [R; 2], b: [R; 2]) -> [R; 2] {
    [k.mul_add(a[0], b[0]), k.mul_add(a[1], b[1])]
}

/// a · b.
#[inline(always)]
pub(super) fn dot<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0].mul_add(b[0], a[1] * b[1])
}

/// a × b, the component out of the plane.
#[inline(always)]
pub(super) fn cross<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0].mul_add(b[1], -(a[1] * b[0]))
}

/// a turned by 90° to the left.
#[inline(always)]
pub(super) fn turn<R: Real>(a: [R; 2]) -> [R; 2] {
    [-a[1], a[0]]
}
