// Points in SIMD lanes, for loops that GCC makes vectors of.
#pragma once

#include <cmath>

#define EACH_LANE _Pragma("omp simd") for (int lane = 0; lane < LANES; ++lane)

constexpr int LANES = 16;
using Lanes = double[LANES];

// Sine and cosine by polynomials, for the few turns that a hinge makes.
inline __attribute__((always_inline)) void sin_cos(double x, double& sine, double& cosine) {
    const double quadrant = std::rint(x * 0.63661977236758134308);
    double r = x - quadrant * 1.5707963267341256142;
    r -= quadrant * 6.0771005065061922e-11;
    const double z = r * r;
    const double s =
        r + r * z *
                (-1.66666666666666324348e-01 +
                 z * (8.33333333332248946124e-03 +
                      z * (-1.98412698298579493134e-04 +
                           z * (2.75573137070700676789e-06 +
                                z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
    const double c =
        1 - 0.5 * z +
        z * z *
            (4.16666666666666019037e-02 +
             z * (-1.38888888888741095749e-03 +
                  z * (2.48015872894767294178e-05 +
                       z * (-2.75573143513906633035e-07 +
                            z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    const double odd = quadrant - 2 * std::floor(quadrant * 0.5), turn = quadrant - 4 * std::floor(quadrant * 0.25);
    const bool swapped = odd > 0.5;
    const double of_sine = swapped ? c : s, of_cosine = swapped ? s : c;
    sine = turn > 1.5 ? -of_sine : of_sine;
    cosine = turn > 0.5 && turn < 2.5 ? -of_cosine : of_cosine;
}

// result = y + h dy
inline __attribute__((always_inline)) void advance(const Lanes* y, double h, const Lanes* dy, Lanes* result) {
    for (int i = 0; i < 4; ++i) EACH_LANE result[i][lane] = y[i][lane] + h * dy[i][lane];
}
