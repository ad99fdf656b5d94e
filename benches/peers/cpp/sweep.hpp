// The command line that all peers share: POINTS RTOL OUT.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "measures.hpp"

struct Point {
    std::string id;
    double force, frequency;  // N, Hz
};

struct Result {
    Measures measures;
    long rhs;  // evaluations of the right-hand side
};

// The points of a file with the columns id,F0,f.
inline std::vector<Point> read_points(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
    std::vector<Point> points;
    while (std::getline(file, line)) {
        const auto first = line.find(','), second = line.find(',', first + 1);
        if (second == std::string::npos) throw std::runtime_error("not a point: " + line);
        const double force = std::stod(line.substr(first + 1)), frequency = std::stod(line.substr(second + 1));
        points.push_back({line.substr(0, first), force, frequency});
    }
    return points;
}

inline std::string cells(const Measures& found) {
    char text[128];
    std::snprintf(text, sizeof text, ",%.17g,%.17g,%.17g", found.tip, found.psi, found.lift);
    return text;
}

// Runs `solve`, which makes the results of all points; says how long that took.
template <class Solve> int sweep(int count, char** arguments, Solve solve) try {
    if (count != 4) throw std::runtime_error("three arguments are needed: POINTS RTOL OUT");
    const auto points = read_points(arguments[1]);
    const double rtol = std::stod(arguments[2]);

    const std::clock_t begin = std::clock();
    const std::vector<Result> results = solve(points, rtol);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;

    std::ofstream out(arguments[3]);
    out << "id,max_x,max_psi,lift\n";
    double rhs = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        out << points[i].id << cells(results[i].measures) << '\n';
        rhs += double(results[i].rhs);
    }
    std::printf("{\"cpu_s\":%.9f,\"rhs_per_point\":%.1f}\n", seconds, rhs / double(points.size()));
    return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
