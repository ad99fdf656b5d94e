// Fixed-step Runge-Kutta 4 over points in SIMD lanes, in lockstep: what a processor can do on these equations when nobody
// watches the error. Time is in periods, so that all lanes share the phase of the drive.
#include "lanes.hpp"
#include "measures.hpp"
#include "sweep.hpp"

namespace {

// As many steps per period as keep the error about that of an adaptive solver at this tolerance: a multiple of the
// samples, 128 at 1e-6.
int steps_per_sample(double rtol) { return int(std::ceil(2 * std::pow(1e-6 / rtol, 0.25) - 1e-9)); }

inline __attribute__((always_inline)) void rates(double drive, const Lanes* y, Lanes* dy, const Lanes force,
                                                 const Lanes period) {
    EACH_LANE {
        double sine, cosine;
        sin_cos(y[2][lane], sine, cosine);
        const auto rate = model::rates<double>(force[lane] * drive, y[0][lane], y[1][lane], y[2][lane], y[3][lane],
                                               sine, cosine);
        dy[0][lane] = rate.x * period[lane];
        dy[1][lane] = rate.v * period[lane];
        dy[2][lane] = rate.psi * period[lane];
        dy[3][lane] = rate.w * period[lane];
    }
}

// The points from `first`, of which there are at most LANES; lanes without one repeat the last.
void solve(const std::vector<Point>& points, std::size_t first, int steps, const std::vector<double>& drive,
           std::vector<Result<3>>& results) {
    alignas(64) Lanes force, period, y[4] = {}, k1[4], k2[4], k3[4], k4[4], stage[4];
    for (int lane = 0; lane < LANES; ++lane) {
        const Point& point = points[std::min(first + lane, points.size() - 1)];
        force[lane] = point.amplitude;
        period[lane] = 1 / point.frequency;
    }
    std::vector<Sampler> samplers(LANES, Sampler(model::SAMPLES_PER_PERIOD));
    const auto sample = [&] {
        for (int lane = 0; lane < LANES; ++lane)
            samplers[lane].add(model::State<double>{y[0][lane], y[1][lane], y[2][lane], y[3][lane]});
    };
    const double h = 1.0 / steps;
    const int settled = (model::PERIODS - model::MEASURED) * steps, every = steps / model::SAMPLES_PER_PERIOD;
    for (int n = 0; n < model::PERIODS * steps; ++n) {
        if (n >= settled && n % every == 0) sample();
        const double* now = &drive[2 * (n % steps)];
        rates(now[0], y, k1, force, period);
        advance(y, h / 2, k1, stage);
        rates(now[1], stage, k2, force, period);
        advance(y, h / 2, k2, stage);
        rates(now[1], stage, k3, force, period);
        advance(y, h, k3, stage);
        rates(now[2], stage, k4, force, period);
        for (int i = 0; i < 4; ++i)
            EACH_LANE y[i][lane] += h / 6 * (k1[i][lane] + 2 * k2[i][lane] + 2 * k3[i][lane] + k4[i][lane]);
    }
    sample();
    for (int lane = 0; lane < LANES && first + lane < points.size(); ++lane)
        results[first + lane] = {samplers[lane].measures(), 4L * model::PERIODS * steps};
}

}  // namespace

int main(int count, char** arguments) {
    return sweep(count, arguments, COLUMNS, [](const std::vector<Point>& points, double rtol) {
        const int steps = model::SAMPLES_PER_PERIOD * steps_per_sample(rtol);
        std::vector<double> drive(2 * steps + 1);
        for (int i = 0; i <= 2 * steps; ++i) drive[i] = std::sin(model::PI * i / steps);
        std::vector<Result<3>> results(points.size());
        for (std::size_t first = 0; first < points.size(); first += LANES) solve(points, first, steps, drive, results);
        return results;
    });
}
