// The command line that all peers share: POINTS RTOL OUT.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

// A drive.
struct Point {
    std::string id;
    double amplitude, frequency;  // N or V, Hz
};

template <std::size_t N> struct Result {
    std::array<double, N> measures;
    long rhs;          // evaluations of the right-hand side
    long periods = 0;  // drive periods of the point; 0 where all points have the same
};

// The points of a file with the columns id, amplitude, frequency.
inline std::vector<Point> read_points(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
    std::vector<Point> points;
    while (std::getline(file, line)) {
        const auto first = line.find(','), second = line.find(',', first + 1);
        if (second == std::string::npos) throw std::runtime_error("not a point: " + line);
        const double amplitude = std::stod(line.substr(first + 1)), frequency = std::stod(line.substr(second + 1));
        points.push_back({line.substr(0, first), amplitude, frequency});
    }
    return points;
}

template <std::size_t N> std::string cells(const std::array<double, N>& measures) {
    std::string text;
    char cell[32];
    for (const double measure : measures) {
        std::snprintf(cell, sizeof cell, ",%.17g", measure);
        text += cell;
    }
    return text;
}

inline void print_mean(const char* name, double sum, std::size_t points, const char* after) {
    if (sum > 0)
        std::printf("\"%s\":%.2f%s", name, sum / double(points), after);
    else
        std::printf("\"%s\":null%s", name, after);
}

// Runs `solve`, which makes the results of all points, with the measures `columns`; says how long that took.
template <class Solve> int sweep(int count, char** arguments, const char* columns, Solve solve) try {
    if (count != 4) throw std::runtime_error("three arguments are needed: POINTS RTOL OUT");
    const auto points = read_points(arguments[1]);
    const double rtol = std::stod(arguments[2]);

    const std::clock_t begin = std::clock();
    const auto results = solve(points, rtol);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;

    std::ofstream out(arguments[3]);
    out << "id," << columns << '\n';
    double rhs = 0, periods = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        out << points[i].id << cells(results[i].measures) << '\n';
        rhs += double(results[i].rhs);
        periods += double(results[i].periods);
    }
    std::printf("{\"cpu_s\":%.9f,", seconds);
    print_mean("rhs_per_point", rhs, points.size(), ",");
    print_mean("periods_per_point", periods, points.size(), "}\n");
    return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
