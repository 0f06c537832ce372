// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>
#include <estampe/terrain.hpp>
#include <fmt/format.h>

#include "techniques/terrain/graph/compile.hpp"
#include "techniques/terrain/graph/evaluate.hpp"

namespace estampe {
namespace {

/// A graph may divide by what is 0 somewhere; that cannot be seen from its text.
void check_heights(const Terrain& terrain)
{
    for (int i = 0; i < 256; ++i) {
        // Spread evenly over a square of 2 km, by the fractions of a plastic number.
        const double x = 2000.0 * (std::fmod(0.5 + i * 0.7548776662466927, 1.0) - 0.5);
        const double z = 2000.0 * (std::fmod(0.5 + i * 0.5698402909980532, 1.0) - 0.5);
        const double height = terrain.sample(x, z, 0.1 * i).height_m;
        if (!std::isfinite(height) || std::abs(height) > 1e5) {
            const auto& nodes = terrain.description().nodes;
            const auto node = std::ranges::find(nodes, "height", &HeightNode::name);
            throw Error(fmt::format("node \"height\" is {} at x = {:.3f}, z = {:.3f}",
                                    std::isfinite(height) ? fmt::format("{:.3g} m", height) : "no number", x,
                                    z),
                        node->where, "look for a division by what may be 0, or heights beyond 100 km");
        }
    }
}

} // namespace

glm::dvec3 HeightSample::normal() const
{
    return glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
}

Terrain::Terrain(TerrainDescription description)
    : description_(std::make_shared<const TerrainDescription>(std::move(description))),
      program_(std::make_shared<const terrain::Program>(terrain::compile_program(*description_)))
{
    check_heights(*this);
}

HeightSample Terrain::sample(double x_m, double z_m, double time_s) const
{
    const auto places = terrain::place_words(*program_, {x_m, z_m}, time_s);
    const glm::dvec4 dual = terrain::evaluate(*program_, places, glm::dvec2(0.0));
    return {.height_m = dual.x, .slope = {dual.y, dual.z}, .rate_m_per_s = dual.w};
}

std::optional<glm::dvec3> Terrain::hit(const glm::dvec3& from, const glm::dvec3& towards, double reach_m,
                                       double time_s) const
{
    const auto above = [&](double way_m) {
        const glm::dvec3 at = from + way_m * towards;
        return at.y - sample(at.x, at.z, time_s).height_m;
    };
    if (above(0.0) < 0.0) {
        return std::nullopt;
    }
    constexpr int steps = 500;
    double last_m = 0.0;
    for (int step = 1; step <= steps; ++step) {
        // Finer near the eye, where more is seen of the ground.
        const double share = static_cast<double>(step) / steps;
        const double way_m = reach_m * share * share;
        if (above(way_m) > 0.0) {
            last_m = way_m;
            continue;
        }
        double far_m = way_m;
        for (int halving = 0; halving < 50; ++halving) {
            const double middle_m = 0.5 * (last_m + far_m);
            (above(middle_m) > 0.0 ? last_m : far_m) = middle_m;
        }
        return from + far_m * towards;
    }
    return std::nullopt;
}

void Terrain::paint_mask(std::string_view mask, const std::vector<float>& heights)
{
    const auto found = std::ranges::find_if(program_->textures, [&](const terrain::HeightTexture& texture) {
        return texture.is_mask && texture.name == mask;
    });
    if (found == program_->textures.end()) {
        throw Error(fmt::format("the terrain has no mask \"{}\"", mask), description_->name);
    }
    if (heights.size() != size_t{found->columns} * found->rows) {
        throw Error(fmt::format("the mask \"{}\" has {} x {} texels", mask, found->columns, found->rows),
                    description_->name);
    }
    auto painted = std::make_shared<terrain::Program>(*program_);
    std::ranges::copy(heights, painted->texels.begin() + found->first_texel);
    program_ = std::move(painted);
}

} // namespace estampe
