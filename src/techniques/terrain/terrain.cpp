// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>
#include <estampe/terrain.hpp>

#include "techniques/terrain/graph/compile.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe {
namespace {

/// Samples the terrain's heights and throws an Error if one is not finite. A division by zero at some places
/// cannot be found in the graph's text.
void check_heights(const Terrain& terrain)
{
    for (int i = 0; i < 256; ++i) {
        // The samples are spread evenly over a square of 2 km, by the plastic number's low-discrepancy
        // sequence.
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

std::vector<std::filesystem::path> Terrain::files() const
{
    std::vector<std::filesystem::path> files;
    for (const terrain::HeightTexture& texture : program_->textures) {
        if (!texture.is_mask && !texture.sand) {
            files.push_back(terrain::texture_path(*description_, texture.name));
        }
    }
    return files;
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
        // Steps along the ray are finer near the eye, where the ground is seen in more detail.
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

// The automatic camera for a terrain without objects. The automatic camera has a view in which light and
// shaded areas are balanced.

namespace {

constexpr double fov_rad = 0.8; // vertical field of view
constexpr double eye_above_m = 3.0;

/// Heights on a lattice around the origin, with linear interpolation. The graph is evaluated only once per
/// lattice point, so lookups are cheap.
class Relief {
public:
    Relief(const Terrain& terrain, double time_s)
    {
        heights_m_.reserve(size_t{side} * side);
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                heights_m_.push_back(
                    terrain.sample(spacing_m * (i - half), spacing_m * (j - half), time_s).height_m);
            }
        }
    }

    [[nodiscard]] double height_m(const glm::dvec2& place) const
    {
        const glm::dvec2 at = glm::clamp(place / spacing_m + static_cast<double>(half), glm::dvec2(0.0),
                                         glm::dvec2(side - 1.001));
        const glm::ivec2 cell(at);
        const glm::dvec2 f = at - glm::dvec2(cell);
        const double near = glm::mix(corner(cell), corner(cell + glm::ivec2(1, 0)), f.x);
        const double far = glm::mix(corner(cell + glm::ivec2(0, 1)), corner(cell + glm::ivec2(1, 1)), f.x);
        return glm::mix(near, far, f.y);
    }

    [[nodiscard]] glm::dvec3 normal(const glm::dvec2& place) const
    {
        const auto rise = [&](const glm::dvec2& way) {
            return height_m(place + way) - height_m(place - way);
        };
        return glm::normalize(glm::dvec3(-rise({spacing_m, 0.0}), 2.0 * spacing_m, -rise({0.0, spacing_m})));
    }

    /// Distance from a point to the ground in the direction of a unit vector. Returns at most `reach_m`.
    [[nodiscard]] double way_to_ground_m(const glm::dvec3& from, const glm::dvec3& towards,
                                         double reach_m) const
    {
        for (double way_m = spacing_m; way_m < reach_m; way_m += std::max(spacing_m, 0.04 * way_m)) {
            const glm::dvec3 at = from + way_m * towards;
            if (at.y < height_m({at.x, at.z})) {
                return way_m;
            }
        }
        return reach_m;
    }

    static constexpr double spacing_m = 2.0;
    static constexpr int half = 80;
    static constexpr int side = 2 * half + 1;

private:
    [[nodiscard]] double corner(const glm::ivec2& cell) const
    {
        return heights_m_[static_cast<size_t>(cell.y) * side + static_cast<size_t>(cell.x)];
    }

    std::vector<double> heights_m_;
};

/// Returns eye positions at a rider's height above the highest places of the ground. The eye positions keep a
/// minimum distance from each other.
std::vector<glm::dvec3> lookouts(const Relief& relief)
{
    constexpr size_t most = 8;
    constexpr double apart_m = 25.0;
    constexpr int reach = 40; // largest distance of eye positions from the origin, in lattice spacings
    std::vector<glm::dvec3> places;
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const glm::dvec2 place = Relief::spacing_m * glm::dvec2(i, j);
            places.emplace_back(place.x, relief.height_m(place), place.y);
        }
    }
    std::ranges::stable_sort(places, std::ranges::greater{}, [](const glm::dvec3& place) { return place.y; });
    std::vector<glm::dvec3> chosen;
    for (const glm::dvec3& place : places) {
        const bool is_apart = std::ranges::all_of(
            chosen, [&](const glm::dvec3& other) { return glm::distance(place, other) > apart_m; });
        if (is_apart && chosen.size() < most) {
            chosen.push_back(place);
        }
    }
    return chosen;
}

/// Rates a view at low resolution: how much of the view is shade, and how often light and shade meet.
double merit(const Relief& relief, const Camera& camera, const glm::dvec3& towards_sun)
{
    constexpr int columns = 16;
    constexpr int rows = 9;
    constexpr double reach_m = 110.0;
    constexpr double wanted_shade = 0.35;
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double half_height = std::tan(0.5 * camera.vertical_fov_rad);
    int ground = 0;
    int shaded = 0;
    int edges = 0;
    int close = 0;
    for (int row = 0; row < rows; ++row) {
        bool was_shaded = false;
        for (int column = 0; column < columns; ++column) {
            const double x = (2.0 * (column + 0.5) / columns - 1.0) * half_height * columns / rows;
            const double y = (1.0 - 2.0 * (row + 0.5) / rows) * half_height;
            const glm::dvec3 towards = glm::normalize(ahead + x * right + y * up);
            const double way_m = relief.way_to_ground_m(camera.eye, towards, reach_m);
            if (way_m >= reach_m) {
                continue;
            }
            const glm::dvec3 point = camera.eye + way_m * towards;
            const glm::dvec2 place(point.x, point.z);
            const glm::dvec3 above(place.x, relief.height_m(place) + 0.3, place.y);
            const bool is_shaded = glm::dot(relief.normal(place), towards_sun) < 0.1 ||
                                   relief.way_to_ground_m(above, towards_sun, 60.0) < 60.0;
            ++ground;
            shaded += is_shaded ? 1 : 0;
            close += way_m < 3.0 * eye_above_m ? 1 : 0;
            edges += ground > 1 && is_shaded != was_shaded ? 1 : 0;
            was_shaded = is_shaded;
        }
    }
    if (ground == 0) {
        return -1.0;
    }
    const double shade = static_cast<double>(shaded) / ground;
    return -4.0 * (shade - wanted_shade) * (shade - wanted_shade) + 0.02 * std::min(edges, 20) -
           0.5 * static_cast<double>(close) / (rows * columns);
}

} // namespace

Camera terrain_camera(const Terrain& terrain, double time_s, const glm::dvec3& towards_sun)
{
    constexpr int headings = 24;
    // Tangent of the camera's pitch. With the returned value, the horizon lies a third of the page's height
    // below the top edge.
    constexpr double pitch = -0.16;
    constexpr double farthest_m = 100.0;
    const Relief relief(terrain, time_s);
    const glm::dvec3 sun = glm::normalize(towards_sun);
    Camera best{.vertical_fov_rad = fov_rad};
    double most = -1e9;
    for (const glm::dvec3& place : lookouts(relief)) {
        for (int i = 0; i < headings; ++i) {
            const double angle_rad = 2.0 * std::numbers::pi * i / headings;
            const glm::dvec3 ahead =
                glm::normalize(glm::dvec3(std::cos(angle_rad), pitch, std::sin(angle_rad)));
            Camera camera{.eye = place + glm::dvec3(0.0, eye_above_m, 0.0), .vertical_fov_rad = fov_rad};
            camera.target = camera.eye + farthest_m * ahead;
            const double own = merit(relief, camera, sun);
            if (own > most) {
                most = own;
                best = camera;
            }
        }
    }
    // The camera's target is a point on the ground, so that the camera can orbit around it.
    const glm::dvec3 ahead = glm::normalize(best.target - best.eye);
    best.target = terrain.hit(best.eye, ahead, farthest_m, time_s).value_or(best.target);
    return best;
}

} // namespace estampe
