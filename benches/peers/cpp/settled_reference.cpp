// What settled motions are compared with: long double at rtol 1e-12, closed by Newton's iteration to a residual of 1e-10, from
// 2,048 samples; and, from the same motion, what comes out with as few samples as the peers take. Arguments: POINTS OUT.
#include "settled.hpp"

namespace {

using State = bimorph::State<long double>;

constexpr long double RTOL = 1e-12L, NEAR = 1e-4L, RESIDUAL = 1e-10L;
constexpr long double CHANGE = 1e-6L;  // of a state, for the derivative of the period map
constexpr int ITERATIONS = 20;
constexpr int FINER = 32;

// Solves four linear equations, with the right-hand side in the last column, by elimination with pivots.
State solve(std::array<std::array<long double, 5>, 4> rows) {
    for (int i = 0; i < 4; ++i) {
        const auto larger = [i](const auto& a, const auto& b) { return std::abs(a[i]) < std::abs(b[i]); };
        std::swap(rows[i], *std::max_element(rows.begin() + i, rows.end(), larger));
        for (int j = 0; j < 4; ++j) {
            if (j == i) continue;
            const long double factor = rows[j][i] / rows[i][i];
            for (int k = i; k < 5; ++k) rows[j][k] -= factor * rows[i][k];
        }
    }
    State x;
    for (int i = 0; i < 4; ++i) x[i] = rows[i][4] / rows[i][i];
    return x;
}

// The orbit near a motion that has almost settled: that which a march would come to after many more periods.
orbit::Found<long double> close(Settling<long double>& settling, orbit::Found<long double> found) {
    for (int iteration = 0; found.periods > 0 && iteration < ITERATIONS; ++iteration) {
        State end = found.y;
        settling.period(end, RTOL);
        if (orbit::change(found.y, end) <= RESIDUAL) return found;
        // (I - M) step = P(y) - y, with the derivative M of the period map P.
        std::array<std::array<long double, 5>, 4> rows;
        for (int j = 0; j < 4; ++j) {
            State changed = found.y;
            changed[j] += CHANGE;
            settling.period(changed, RTOL);
            for (int i = 0; i < 4; ++i) rows[i][j] = (i == j ? 1 : 0) - (changed[i] - end[i]) / CHANGE;
            rows[j][4] = end[j] - found.y[j];
        }
        const State step = solve(rows);
        for (int i = 0; i < 4; ++i) found.y[i] += step[i];
    }
    found.periods = 0;
    return found;
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 3) throw std::runtime_error("two arguments are needed: POINTS OUT");
    std::ofstream out(arguments[2]);
    out << "id," << orbit::COLUMNS << ",sampled_stroke_pp_deg,sampled_pitch_pp_deg,sampled_lift_mean_mn,sampled_power_mean_mw\n";
    for (const Point& point : read_points(arguments[1])) {
        Settling<long double> settling(point);
        const auto fine = settling.samples(close(settling, settling.settle(RTOL, NEAR)), FINER * orbit::SAMPLES);
        if (fine.empty()) throw std::runtime_error("point " + point.id + " does not settle");
        std::vector<State> coarse;
        for (std::size_t i = 0; i < fine.size(); i += FINER) coarse.push_back(fine[i]);
        out << point.id << cells(orbit::measures(fine, settling.omega()))
            << cells(orbit::measures(coarse, settling.omega())) << '\n';
    }
    return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
