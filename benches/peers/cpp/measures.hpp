// What is measured of a motion: from equally spaced samples, as users of the libraries do.
#pragma once

#include <algorithm>

#include "model.hpp"

using Measures = std::array<double, 3>;  // max |x| (m), max |ψ| (rad), mean lift (N)
constexpr const char* COLUMNS = "max_x,max_psi,lift";

// The largest magnitude of what is sampled, with a parabola through the three samples around it.
class Peak {
    double last_ = 0, before_ = 0;
    int taken_ = 0;

public:
    double highest = 0;

    void add(double value) {
        const double next = std::abs(value);
        const double bend = before_ - 2 * last_ + next;
        if (taken_ >= 2 && last_ >= before_ && last_ >= next && bend < 0) {
            const double slope = before_ - next;
            highest = std::max(highest, last_ - slope * slope / (8 * bend));
        }
        highest = std::max(highest, next);
        before_ = last_;
        last_ = next;
        ++taken_;
    }
};

// Collects the samples of the measured periods, of which the first and the last bound them.
class Sampler {
    Peak tip_, psi_;
    double lift_ = 0;
    int taken_ = 0;
    const int intervals_;

public:
    explicit Sampler(int per_period) : intervals_(model::MEASURED * per_period) {}

    bool full() const { return taken_ > intervals_; }

    // When the next sample is due, in periods.
    template <class Real> Real due() const {
        return model::PERIODS - model::MEASURED + Real(taken_) * model::MEASURED / intervals_;
    }

    template <class Real> void add(const model::State<Real>& y) {
        const double v = double(y[1]) * model::V_SCALE, psi = double(y[2]);
        tip_.add(double(y[0]));
        psi_.add(psi);
        const double ends = taken_ == 0 || taken_ == intervals_ ? 0.5 : 1;  // trapezoidal rule
        lift_ += ends * v * std::abs(v) * std::sin(2 * psi);
        ++taken_;
    }

    Measures measures() const {
        return {tip_.highest * model::X_SCALE, psi_.highest, model::LIFT * model::PRESSURE * lift_ / intervals_};
    }
};
