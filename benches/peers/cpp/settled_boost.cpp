// Boost.Odeint: Dormand-Prince 5(4) until the motion has settled, with dense output in the measured period; point by point.
#include "settled.hpp"

int main(int count, char** arguments) {
    return sweep(count, arguments, orbit::COLUMNS, [](const std::vector<Point>& points, double rtol) {
        std::vector<Result<4>> results;
        results.reserve(points.size());
        for (const Point& point : points) {
            Settling<double> settling(point);
            const auto samples = settling.samples(settling.settle(rtol, orbit::RESIDUAL), orbit::SAMPLES);
            results.push_back({orbit::measures(samples, settling.omega()), settling.rhs, settling.periods});
        }
        return results;
    });
}
