// SPDX-License-Identifier: MIT
// Reference: Ghia, Ghia and Shin, "High-Re solutions for incompressible flow using the Navier-Stokes
// equations and a multigrid method", Journal of Computational Physics 48, 1982. In that paper's table of the
// vertical speed, the entry for Reynolds number 400 at x = 0.9063 is a misprint. It is left out here.
#include "techniques/fluid/cavity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace estampe::fluid {
namespace {

struct Point {
    double place;
    std::array<double, 3> speeds; ///< reference speeds at Reynolds numbers 100, 400 and 1000
};

constexpr double misprint = 1e9;

constexpr std::array<Point, 15> u_along_y{{{0.9766, {0.84123, 0.75837, 0.65928}},
                                           {0.9688, {0.78871, 0.68439, 0.57492}},
                                           {0.9609, {0.73722, 0.61756, 0.51117}},
                                           {0.9531, {0.68717, 0.55892, 0.46604}},
                                           {0.8516, {0.23151, 0.29093, 0.33304}},
                                           {0.7344, {0.00332, 0.16256, 0.18719}},
                                           {0.6172, {-0.13641, 0.02135, 0.05702}},
                                           {0.5000, {-0.20581, -0.11477, -0.06080}},
                                           {0.4531, {-0.21090, -0.17119, -0.10648}},
                                           {0.2813, {-0.15662, -0.32726, -0.27805}},
                                           {0.1719, {-0.10150, -0.24299, -0.38289}},
                                           {0.1016, {-0.06434, -0.14612, -0.29730}},
                                           {0.0703, {-0.04775, -0.10338, -0.22220}},
                                           {0.0625, {-0.04192, -0.09266, -0.20196}},
                                           {0.0547, {-0.03717, -0.08186, -0.18109}}}};

constexpr std::array<Point, 15> v_along_x{{{0.9688, {-0.05906, -0.12146, -0.21388}},
                                           {0.9609, {-0.07391, -0.15663, -0.27669}},
                                           {0.9531, {-0.08864, -0.19254, -0.33714}},
                                           {0.9453, {-0.10313, -0.22847, -0.39188}},
                                           {0.9063, {-0.16914, misprint, -0.51550}},
                                           {0.8594, {-0.22445, -0.44993, -0.42665}},
                                           {0.8047, {-0.24533, -0.38598, -0.31966}},
                                           {0.5000, {0.05454, 0.05186, 0.02526}},
                                           {0.2344, {0.17527, 0.30174, 0.32235}},
                                           {0.2266, {0.17507, 0.30203, 0.33075}},
                                           {0.1563, {0.16077, 0.28124, 0.37095}},
                                           {0.0938, {0.12317, 0.22965, 0.32627}},
                                           {0.0781, {0.10890, 0.20920, 0.30353}},
                                           {0.0703, {0.10091, 0.19713, 0.29012}},
                                           {0.0625, {0.09233, 0.18360, 0.27485}}}};

/// One velocity component along a centre line of the cavity: at both walls and at all nodes between the
/// walls.
struct Profile {
    std::vector<double> places;
    std::vector<double> speeds;

    /// Interpolates the profile with the cubic through the four points around `place`.
    [[nodiscard]] double at(double place) const
    {
        const auto above = std::upper_bound(places.begin(), places.end(), place) - places.begin();
        const auto first = static_cast<size_t>(
            std::clamp<ptrdiff_t>(above - 2, 0, static_cast<ptrdiff_t>(places.size()) - 4));
        double sum = 0.0;
        for (size_t i = first; i < first + 4; ++i) {
            double weight = 1.0;
            for (size_t j = first; j < first + 4; ++j) {
                weight *= j == i ? 1.0 : (place - places[j]) / (places[i] - places[j]);
            }
            sum += weight * speeds[i];
        }
        return sum;
    }
};

Profile profile_of(const Grid& grid, std::span<const float> velocity, uint32_t component)
{
    const uint32_t n = grid.cells.x;
    Profile profile{.places = {0.0}, .speeds = {0.0}};
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t cell = component == 0 ? i * n + n / 2 : n / 2 * n + i;
        profile.places.push_back((i + 0.5) / n);
        profile.speeds.push_back(static_cast<double>(velocity[size_t{component} * n * n + cell]));
    }
    profile.places.push_back(1.0);
    profile.speeds.push_back(component == 0 ? 1.0 : 0.0);
    return profile;
}

double rms(const Profile& profile, std::span<const Point> points, size_t column)
{
    double sum = 0.0;
    int count = 0;
    for (const Point& point : points) {
        if (point.speeds[column] != misprint) {
            const double off = profile.at(point.place) - point.speeds[column];
            sum += off * off;
            ++count;
        }
    }
    return std::sqrt(sum / count);
}

/// Minimum and maximum of a profile, searched on a finer raster than the grid.
std::pair<double, double> range_of(const Profile& profile)
{
    constexpr int parts = 4096;
    std::pair<double, double> range(0.0, 0.0);
    for (int i = 0; i <= parts; ++i) {
        const double speed = profile.at(static_cast<double>(i) / parts);
        range = {std::min(range.first, speed), std::max(range.second, speed)};
    }
    return range;
}

} // namespace

Grid cavity_grid(uint32_t side_cells)
{
    return {.cells = {side_cells, side_cells, 1},
            .cell_m = 1.0F / static_cast<float>(side_cells),
            .lid_m_per_s = {1.0F, 0.0F, 0.0F}};
}

CavityFit cavity_fit(const Grid& grid, std::span<const float> velocity, int reynolds)
{
    constexpr std::array<int, 3> known{100, 400, 1000};
    const auto column = static_cast<size_t>(std::find(known.begin(), known.end(), reynolds) - known.begin());
    if (column == known.size() || grid.cells.x != grid.cells.y || grid.cells.x % 2 != 0) {
        throw std::logic_error("cavities are known at Reynolds numbers 100, 400 and 1000, on even squares");
    }
    const Profile u = profile_of(grid, velocity, 0);
    const Profile v = profile_of(grid, velocity, 1);
    const auto [least_v, most_v] = range_of(v);
    return {.rms_u = rms(u, u_along_y, column),
            .rms_v = rms(v, v_along_x, column),
            .least_u = range_of(u).first,
            .least_v = least_v,
            .most_v = most_v};
}

} // namespace estampe::fluid
