// Settled motions by Boost.Odeint's Dormand-Prince 5(4), in the arithmetic of `Real`.
#pragma once

#include <boost/numeric/odeint.hpp>

#include "orbit.hpp"
#include "sweep.hpp"

// Marches a point from rest until it has settled, and takes samples of one more period. Every period begins with the same
// step: the state at its end is then a function of that at its beginning, which converges.
template <class Real> class Settling {
    using State = bimorph::State<Real>;
    using Method = boost::numeric::odeint::runge_kutta_dopri5<State, Real, State, Real>;

    const Real turn_ = 2 * std::acos(Real(-1));
    const Real volts_, omega_;

    auto equations() {
        return [this](const State& y, State& dy, Real phase) {
            using std::cos;
            using std::sin;
            ++rhs;
            const Real pitch = Real(bimorph::PITCH_SCALE) * y[2];
            const auto push = bimorph::push<Real>(volts_, sin(phase));
            const auto rate = bimorph::rates<Real>(omega_, push, y[0], y[1], y[2], y[3], sin(pitch), cos(pitch));
            dy = {rate.x, rate.v, rate.psi, rate.w};
        };
    }

public:
    long rhs = 0, periods = 0;

    explicit Settling(const Point& point) : volts_(point.amplitude), omega_(turn_ * Real(point.frequency)) {}

    double omega() const { return double(omega_); }

    // One period.
    void period(State& y, Real rtol) {
        namespace odeint = boost::numeric::odeint;
        ++periods;
        auto stepper = odeint::make_controlled(rtol / 10, rtol, Method());
        odeint::integrate_adaptive(stepper, equations(), y, Real(0), turn_, turn_ / orbit::SAMPLES);
    }

    // The state at the beginning of a period of the settled motion.
    orbit::Found<Real> settle(Real rtol, Real residual) {
        return orbit::settle<Real>(rtol, residual, [this](State& y, Real tolerance) { period(y, tolerance); });
    }

    // States at `count` equally spaced phases of one more period: none if the motion has not settled.
    std::vector<State> samples(orbit::Found<Real> found, int count) {
        namespace odeint = boost::numeric::odeint;
        std::vector<State> taken;
        if (found.periods == 0) return taken;
        ++periods;
        std::vector<Real> phases;
        for (int i = 0; i < count; ++i) phases.push_back(turn_ * Real(i) / Real(count));
        auto stepper = odeint::make_dense_output(found.rtol / 10, found.rtol, Method());
        odeint::integrate_times(stepper, equations(), found.y, phases, turn_ / orbit::SAMPLES,
                                [&](const State& y, Real) { taken.push_back(y); });
        return taken;
    }
};
