// What settled motions are compared with: long double at rtol 1e-12 to a residual of 1e-10, from 2,048 samples; and, from
// the same motion, what comes out with as few samples as the peers take. Arguments: POINTS OUT.
#include "settled.hpp"

constexpr long double RTOL = 1e-12L, RESIDUAL = 1e-10L;
constexpr int FINER = 32;

int main(int count, char** arguments) try {
    if (count != 3) throw std::runtime_error("two arguments are needed: POINTS OUT");
    std::ofstream out(arguments[2]);
    out << "id," << orbit::COLUMNS << ",sampled_stroke_pp_deg,sampled_pitch_pp_deg,sampled_lift_mean_mn,sampled_power_mean_mw\n";
    for (const Point& point : read_points(arguments[1])) {
        Settling<long double> settling(point);
        const auto fine = settling.samples(RTOL, RESIDUAL, FINER * orbit::SAMPLES);
        if (fine.empty()) throw std::runtime_error("point " + point.id + " does not settle");
        std::vector<bimorph::State<long double>> coarse;
        for (std::size_t i = 0; i < fine.size(); i += FINER) coarse.push_back(fine[i]);
        out << point.id << cells(orbit::measures(fine, settling.omega()))
            << cells(orbit::measures(coarse, settling.omega())) << '\n';
    }
    return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
