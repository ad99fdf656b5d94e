// Fixed-step Runge-Kutta 4 over points in SIMD lanes until each has settled: what a processor can do on these equations when
// nobody watches the error. All lanes share the phase of the drive; a lane whose point is done takes the next one when a
// period ends. The forces of the plates, which depend on the phase alone, come from tables.
#include "lanes.hpp"
#include "orbit.hpp"
#include "sweep.hpp"

namespace {

using bimorph::State;

// As many steps per sample as keep the error about that of an adaptive solver at this tolerance: 128 per period at 1e-6.
int steps_per_sample(double rtol) { return int(std::ceil(2 * std::pow(1e-6 / rtol, 0.25) - 1e-9)); }

// A point in a lane.
struct Run {
    static constexpr std::size_t NONE = -1;
    std::size_t point = NONE;
    int periods = 0;
    bool measured = false;  // in the period at hand
    State<double> begin{};  // of the period
    std::vector<State<double>> samples;
};

class Ensemble {
    const std::vector<Point>& points_;
    const int every_, steps_;
    std::size_t next_ = 0, running_ = 0;
    Run runs_[LANES];
    alignas(64) Lanes omega_, y_[4] = {};
    std::vector<double> difference_, sum_;  // of the plates' forces: by half step, then lane

    State<double> state(int lane) const { return {y_[0][lane], y_[1][lane], y_[2][lane], y_[3][lane]}; }

    // Begins the next point in a lane. A lane without one marches on with what it has.
    void begin(int lane) {
        if (runs_[lane].point != Run::NONE) --running_;
        runs_[lane] = Run();
        if (next_ == points_.size()) return;
        const Point& point = points_[runs_[lane].point = next_++];
        ++running_;
        omega_[lane] = 2 * bimorph::PI * point.frequency;
        for (int i = 0; i < 4; ++i) y_[i][lane] = 0;
        for (int n = 0; n <= 2 * steps_; ++n) {
            const auto push = bimorph::push<double>(point.amplitude, std::sin(bimorph::PI * n / steps_));
            difference_[n * LANES + lane] = push.difference;
            sum_[n * LANES + lane] = push.sum;
        }
    }

    inline __attribute__((always_inline)) void rates(int half_step, const Lanes* y, Lanes* dy) const {
        const double* difference = &difference_[half_step * LANES];
        const double* sum = &sum_[half_step * LANES];
        EACH_LANE {
            double sine, cosine;
            sin_cos(bimorph::PITCH_SCALE * y[2][lane], sine, cosine);
            const auto rate = bimorph::rates<double>(omega_[lane], {difference[lane], sum[lane]}, y[0][lane], y[1][lane],
                                                     y[2][lane], y[3][lane], sine, cosine);
            dy[0][lane] = rate.x;
            dy[1][lane] = rate.v;
            dy[2][lane] = rate.psi;
            dy[3][lane] = rate.w;
        }
    }

    void period() {
        alignas(64) Lanes k1[4], k2[4], k3[4], k4[4], stage[4];
        const double h = 2 * bimorph::PI / steps_;
        for (int n = 0; n < steps_; ++n) {
            for (int lane = 0; lane < LANES && n % every_ == 0; ++lane)
                if (runs_[lane].measured) runs_[lane].samples.push_back(state(lane));
            rates(2 * n, y_, k1);
            advance(y_, h / 2, k1, stage);
            rates(2 * n + 1, stage, k2);
            advance(y_, h / 2, k2, stage);
            rates(2 * n + 1, stage, k3);
            advance(y_, h, k3, stage);
            rates(2 * n + 2, stage, k4);
            for (int i = 0; i < 4; ++i)
                EACH_LANE y_[i][lane] += h / 6 * (k1[i][lane] + 2 * k2[i][lane] + 2 * k3[i][lane] + k4[i][lane]);
        }
    }

    // What a period's end means for a lane's point.
    void end(int lane, std::vector<Result<4>>& results) {
        Run& run = runs_[lane];
        if (run.point == Run::NONE) return;
        ++run.periods;
        const auto before = run.begin;
        run.begin = state(lane);
        if (run.measured || run.periods == orbit::MOST_PERIODS) {
            results[run.point] = {orbit::measures(run.samples, omega_[lane]), 4L * run.periods * steps_, run.periods};
            begin(lane);
        } else {
            run.measured = orbit::change(before, run.begin) <= orbit::RESIDUAL;
        }
    }

public:
    Ensemble(const std::vector<Point>& points, double rtol)
        : points_(points),
          every_(steps_per_sample(rtol)),
          steps_(orbit::SAMPLES * every_),
          difference_((2 * steps_ + 1) * LANES),
          sum_(difference_.size()) {
        EACH_LANE omega_[lane] = 1;
        for (int lane = 0; lane < LANES; ++lane) begin(lane);
    }

    std::vector<Result<4>> settle() {
        std::vector<Result<4>> results(points_.size());
        while (running_ > 0) {
            period();
            for (int lane = 0; lane < LANES; ++lane) end(lane, results);
        }
        return results;
    }
};

}  // namespace

int main(int count, char** arguments) {
    return sweep(count, arguments, orbit::COLUMNS,
                 [](const std::vector<Point>& points, double rtol) { return Ensemble(points, rtol).settle(); });
}
