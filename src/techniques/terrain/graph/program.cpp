// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "techniques/terrain/whole_cells.hpp"

namespace estampe::terrain {
namespace {

/// A coordinate at the origin: how many whole cells, and the rest.
struct Split {
    int32_t cell = 0;
    double rest = 0.0;
};

Split split_at(const Linear& coordinate, const glm::dvec2& origin_m, double time_s)
{
    const double value =
        coordinate.x * origin_m.x + coordinate.z * origin_m.y + coordinate.t * time_s + coordinate.constant;
    const double whole = std::floor(value);
    return {static_cast<int32_t>(wrapped_cells(whole)), value - whole};
}

} // namespace

bool Program::has_form_of(const Program& other) const
{
    const auto same = [](const Instruction& a, const Instruction& b) {
        return std::memcmp(&a, &b, sizeof(Instruction)) == 0;
    };
    return std::ranges::equal(instructions, other.instructions, same) &&
           parameters.size() == other.parameters.size() && places.size() == other.places.size();
}

std::vector<PlaceWords> place_words(const Program& program, const glm::dvec2& origin_m, double time_s)
{
    std::vector<PlaceWords> result;
    result.reserve(program.places.size());
    for (const PlaceSource& place : program.places) {
        const Split u = split_at(place.u, origin_m, time_s);
        const Split v = split_at(place.v, origin_m, time_s);
        PlaceWords words;
        words.numbers = {place.u.x,      place.u.z,           place.v.x,          place.v.z, u.rest,
                         v.rest,         place.u.t,           place.v.t,          0.0,       0.0,
                         place.period_m, place.units_per_m.x, place.units_per_m.y};
        words.cells = {u.cell, v.cell};
        result.push_back(words);
    }
    return result;
}

} // namespace estampe::terrain
