// Boost.Odeint: Dormand-Prince 5(4) with dense output, point by point.
#include "odeint.hpp"

int main(int count, char** arguments) {
    return sweep(count, arguments, COLUMNS, [](const std::vector<Point>& points, double rtol) {
        std::vector<Result<3>> results;
        results.reserve(points.size());
        for (const Point& point : points) {
            Sampler sampler(model::SAMPLES_PER_PERIOD);
            const long rhs = integrate<double>(point, rtol, sampler, [&](const auto& y) { sampler.add(y); });
            results.push_back({sampler.measures(), rhs});
        }
        return results;
    });
}
