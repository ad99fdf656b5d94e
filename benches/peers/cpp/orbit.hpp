// A settled motion: the search for it by marching, and what is measured of one of its periods.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "bimorph.hpp"

namespace orbit {

constexpr double RESIDUAL = 1e-6;     // largest change of a state over a period of a settled motion
constexpr int PATIENCE = 32;          // periods in which the residual is to fall
constexpr int MOST_PERIODS = 1000;
constexpr int SAMPLES = 64;           // per period

using Measures = std::array<double, 4>;
constexpr const char* COLUMNS = "stroke_pp_deg,pitch_pp_deg,lift_mean_mn,power_mean_mw";

template <class Real> Real change(const bimorph::State<Real>& before, const bimorph::State<Real>& after) {
    Real largest = 0;
    for (int i = 0; i < 4; ++i) largest = std::max(largest, std::abs(after[i] - before[i]));
    return largest;
}

// The state at the beginning of a period of the settled motion, and how it was found.
template <class Real> struct Found {
    bimorph::State<Real> y;
    Real rtol;
    int periods;  // 0 if the motion did not settle
};

// Marches from rest until a period changes the state by `residual` at most. `period` integrates one at a tolerance. A
// period map that jumps by the error of integration may never come to rest: where the residual has stopped falling, the
// march goes on at a tenth of the tolerance.
template <class Real, class Period> Found<Real> settle(Real rtol, Real residual, Period period) {
    bimorph::State<Real> y{};
    Real least = std::numeric_limits<Real>::infinity(), last_least = least;
    for (int periods = 1; periods <= MOST_PERIODS; ++periods) {
        const auto before = y;
        period(y, rtol);
        const Real changed = change(before, y);
        if (changed <= residual) return {y, rtol, periods};
        least = std::min(least, changed);
        if (periods % PATIENCE == 0) {
            if (least > last_least * Real(0.9)) rtol = std::max(rtol / 10, 100 * std::numeric_limits<Real>::epsilon());
            last_least = least;
            least = std::numeric_limits<Real>::infinity();
        }
    }
    return {y, rtol, 0};
}

// The largest of equally spaced values of a period, with a parabola through the three samples around it.
inline double peak(const std::vector<double>& values) {
    const std::size_t count = values.size();
    double highest = values[0];
    for (std::size_t i = 0; i < count; ++i) {
        const double before = values[(i + count - 1) % count], here = values[i], next = values[(i + 1) % count];
        const double bend = before - 2 * here + next, slope = before - next;
        const bool turns = here >= before && here >= next && bend < 0;
        highest = std::max(highest, turns ? here - slope * slope / (8 * bend) : here);
    }
    return highest;
}

inline double peak_to_peak(std::vector<double> values) {
    const double highest = peak(values);
    for (double& value : values) value = -value;
    return highest + peak(values);
}

// Of the states at equally spaced phases of one period. Not numbers where there are none.
template <class Real> Measures measures(const std::vector<bimorph::State<Real>>& samples, double omega) {
    using namespace bimorph;
    if (samples.empty()) {
        Measures none;
        none.fill(std::numeric_limits<double>::quiet_NaN());
        return none;
    }
    std::vector<double> tip, pitch;
    double lift = 0, power = 0;
    for (const auto& y : samples) {
        tip.push_back(double(y[0]) * TIP_SCALE);
        pitch.push_back(double(y[2]) * PITCH_SCALE);
        const double speed = double(y[1]) * TIP_SCALE * omega, flow = speed * std::abs(speed);
        lift += PRESSURE * LIFT * flow * std::sin(2 * pitch.back());
        power += TIP_DRAG * (DRAG_MEAN + DRAG_SWING * std::cos(2 * pitch.back())) * flow * speed;
    }
    const double degrees = 180 / PI, milli = 1e3 / double(samples.size());
    return {peak_to_peak(tip) * TRANSMISSION * degrees, peak_to_peak(pitch) * degrees, lift * milli, power * milli};
}

}  // namespace orbit
