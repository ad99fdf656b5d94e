// Boost.Odeint's Dormand-Prince 5(4) with dense output, in the arithmetic of `Real`.
#pragma once

#include <boost/numeric/odeint.hpp>

#include "measures.hpp"
#include "sweep.hpp"

// Integrates a point and gives `take` the states that are due until `sampler` is full. Returns how often the right-hand
// side was evaluated.
template <class Real, class Take>
long integrate(const Point& point, Real rtol, const Sampler& sampler, Take take) {
    namespace odeint = boost::numeric::odeint;
    using State = model::State<Real>;
    const Real force = point.amplitude, period = 1 / Real(point.frequency);
    const Real omega = 2 * std::acos(Real(-1)) * Real(point.frequency);
    long evaluations = 0;
    const auto system = [&](const State& y, State& dy, Real t) {
        using std::cos;
        using std::sin;
        ++evaluations;
        const Real drive = force * sin(omega * t);
        const auto rate = model::rates<Real>(drive, y[0], y[1], y[2], y[3], sin(y[2]), cos(y[2]));
        dy = {rate.x, rate.v, rate.psi, rate.w};
    };
    auto stepper =
        odeint::make_dense_output(rtol / 10, rtol, odeint::runge_kutta_dopri5<State, Real, State, Real>());
    stepper.initialize(State{}, Real(0), period / 1000);
    State y;
    while (!sampler.full()) {
        stepper.do_step(system);
        while (!sampler.full() && sampler.template due<Real>() * period <= stepper.current_time()) {
            stepper.calc_state(sampler.template due<Real>() * period, y);
            take(y);
        }
    }
    return evaluations;
}
