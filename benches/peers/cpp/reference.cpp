// What the peers are compared with: long double at rtol 1e-12, from 2,048 samples per period; and, from the same motion,
// what comes out with as few samples as the peers take. Arguments: POINTS OUT.
#include "odeint.hpp"

constexpr long double RTOL = 1e-12L;
constexpr int FINER = 32;

int main(int count, char** arguments) try {
    if (count != 3) throw std::runtime_error("two arguments are needed: POINTS OUT");
    std::ofstream out(arguments[2]);
    out << "id,max_x,max_psi,lift,sampled_max_x,sampled_max_psi,sampled_lift\n";
    for (const Point& point : read_points(arguments[1])) {
        Sampler fine(FINER * model::SAMPLES_PER_PERIOD), coarse(model::SAMPLES_PER_PERIOD);
        int taken = 0;
        integrate<long double>(point, RTOL, fine, [&](const auto& y) {
            fine.add(y);
            if (taken++ % FINER == 0) coarse.add(y);
        });
        out << point.id << cells(fine.measures()) << cells(coarse.measures()) << '\n';
    }
    return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
