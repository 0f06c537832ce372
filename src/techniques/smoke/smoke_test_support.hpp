// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/smoke/smoke.hpp"

/// Smoke from grids that tests fill, and rays for computing the expected pictures.
namespace estampe::smoke {

inline constexpr glm::uvec2 size_px(48, 40);
inline constexpr double near_m = 0.05;
inline constexpr uint32_t side = 32;
inline constexpr float cell_m = 1.0F / side;

/// Density as a function of the cell's middle, in a box of one metre.
using Density = std::function<float(glm::vec3)>;

/// A slightly rotated box of one metre around the origin.
struct Turned {
    glm::dmat4 anchor_from_box = glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(0.3, 1.0, 0.2)));

    [[nodiscard]] Box box() const
    {
        glm::dmat4 box_from_grid = glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5));
        box_from_grid = glm::scale(box_from_grid, glm::dvec3(1.0 / side));
        return {.cells = glm::uvec3(side),
                .cell_m = cell_m,
                .grid_from_anchor = glm::mat4(glm::inverse(anchor_from_box * box_from_grid))};
    }
};

struct Seen {
    Camera camera{.eye = {0.4, 0.3, 2.2}, .target = {0.0, 0.05, 0.0}, .near_m = near_m};
    test::Painter<float> depth = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> lines = [](glm::uvec2) { return glm::vec4(0.0F); };
    std::vector<Lamp> lamps = {};
    float ambient = 1.0F;
    std::optional<glm::vec3> towards_sun = {}; ///< if set, the smoke's shadow is computed
    std::optional<float> haze_reach_m = {};    ///< haze into green, from half a metre on
};

struct Drawn {
    std::vector<glm::vec4> marched;
    std::vector<uint32_t> paint; ///< four bytes each
    std::vector<float> ink;
    std::vector<float> share; ///< share of sunlight
    shared::FrameGlobals frame;

    [[nodiscard]] float cover(size_t i) const { return static_cast<float>(paint[i] >> 24U) / 255.0F; }
};

/// A box and its content.
struct Filled {
    Box box;
    Density density; ///< function of the cell's middle, in metres from the low corner
};

inline gpu::Image field_of(const Filled& filled)
{
    const glm::uvec3& cells = filled.box.cells;
    gpu::Image field(test::shared_device(), "density",
                     {.width = cells.x, .height = cells.y, .format = gpu::Format::r32f, .layers = cells.z});
    gpu::upload_layers(test::shared_device(), field, [&](uint32_t z) {
        std::vector<float> numbers;
        for (uint32_t i = 0; i < cells.x * cells.y; ++i) {
            numbers.push_back(
                filled.density((glm::vec3(i % cells.x, i / cells.x, z) + 0.5F) * filled.box.cell_m));
        }
        const auto bytes = std::as_bytes(std::span(numbers));
        return gpu::LayerPixels{.levels = {{bytes.begin(), bytes.end()}}};
    });
    return field;
}

inline Drawn draw(const std::vector<Filled>& filled, const SmokeStyle& style, const Seen& seen)
{
    gpu::Device& device = test::shared_device();
    std::vector<Box> boxes;
    std::vector<gpu::Image> fields;
    for (const Filled& one : filled) {
        boxes.push_back(one.box);
        fields.push_back(field_of(one));
    }
    const shared::SmokeGlobals around =
        globals_of(boxes, style, {.lamps = seen.lamps, .ambient = seen.ambient});
    auto globals = gpu::upload_buffer(device, "smoke", std::vector{around});
    const Bounds bounds{.min = glm::dvec3(-1.0), .max = glm::dvec3(1.0)};
    Drawn drawn{.frame = features::frame_globals(seen.camera, bounds, glm::dvec3(0.0), {.size_px = size_px})};
    auto frame = gpu::upload_buffer(device, "frame", std::vector{drawn.frame});
    auto depth = test::Layer::depth(size_px, seen.depth);
    auto lines = test::Layer::root_color(size_px, seen.lines);
    auto sky = test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(0.0F, 1.0F, 0.0F, 1.0F); });
    auto half = test::Layer::coverage(size_px, [](glm::uvec2) { return 0.5F; });
    VolumeMemory memory;
    memory.ensure(device, around);
    for (int wanted = 0; wanted < (seen.towards_sun ? 4 : 3); ++wanted) {
        gpu::Graph graph;
        const ViewInputs view{.frame = gpu::import_whole(graph, "frame", frame),
                              .globals = gpu::import_whole(graph, "smoke", globals),
                              .depth = depth.in(graph),
                              .size_px = size_px};
        Fields densities{.globals = view.globals, .densities = {}};
        for (gpu::Image& field : fields) {
            densities.densities.push_back(gpu::import_uploaded(graph, "density", field));
        }
        const Volume volume =
            wanted == 0 ? add_volume(graph, memory, style, densities) : memory.import(graph);
        if (wanted == 3) {
            drawn.share = test::run_and_read_coverage(
                graph, add_thrown(graph, volume, style,
                                  {.view = view, .share = half.in(graph), .towards_sun = *seen.towards_sun}));
            continue;
        }
        const gpu::ImageId marched = add_march(graph, volume, style, view);
        const Layer layer =
            add_ink(graph, style,
                    {.view = view,
                     .marched = marched,
                     .lines = lines.in(graph),
                     .pixels_per_mm = 4.0F,
                     .haze = seen.haze_reach_m
                                 ? std::optional(Haze{
                                       .sky = sky.in(graph), .start_m = 0.5F, .reach_m = *seen.haze_reach_m})
                                 : std::nullopt});
        if (wanted == 0) {
            drawn.marched = test::run_and_read_as<glm::vec4>(graph, marched);
        } else if (wanted == 1) {
            drawn.paint = test::run_and_read_as<uint32_t>(graph, layer.paint);
        } else {
            drawn.ink = test::run_and_read_coverage(graph, layer.ink);
        }
    }
    return drawn;
}

inline Drawn draw(const Density& density, const SmokeStyle& style, const Seen& seen = {})
{
    return draw(std::vector<Filled>{{Turned().box(), density}}, style, seen);
}

inline SmokeStyle plain(float extinction_per_m, Sampling sampling = Sampling::rays, float step = 0.7F)
{
    return {.enabled = true,
            .thickness = 0.1F * extinction_per_m,
            .puffs = false,
            .sampling = sampling,
            .step = step};
}

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

/// The ray through the middle of a pixel.
inline Ray ray_through(const Drawn& drawn, const Camera& camera, size_t pixel)
{
    const glm::dvec2 ndc =
        2.0 * (glm::dvec2(pixel % size_px.x, pixel / size_px.x) + 0.5) / glm::dvec2(size_px) - 1.0;
    const auto point_at = [&](double depth) {
        const glm::dvec4 point =
            glm::inverse(glm::dmat4(drawn.frame.clip_from_anchor)) * glm::dvec4(ndc, depth, 1.0);
        return glm::dvec3(point) / point.w;
    };
    const bool is_parallel = camera.orthographic_half_height_m.has_value();
    const glm::dvec3 near = point_at(1.0);
    return {is_parallel ? near : camera.eye,
            is_parallel ? glm::normalize(camera.target - camera.eye) : glm::normalize(near - camera.eye)};
}

/// The ray through a pixel's middle in the box's axes, from the low corner.
inline Ray ray_of(const Drawn& drawn, const Camera& camera, size_t pixel)
{
    const Ray ray = ray_through(drawn, camera, pixel);
    const glm::dmat4 box_from_anchor = glm::inverse(Turned().anchor_from_box);
    return {glm::dvec3(box_from_anchor * glm::dvec4(ray.origin, 1.0)) + 0.5,
            glm::dmat3(box_from_anchor) * ray.direction};
}

/// The part of a ray in the box of one metre, up to `most`: distances of entry and exit.
inline glm::dvec2 range_in_box(const Ray& ray, double most = 1e9)
{
    double from = 0.0;
    double to = most;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = -ray.origin[axis] / ray.direction[axis];
        const double b = (1.0 - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return {from, to};
}

inline double way_through_box(const Ray& ray, double most = 1e9)
{
    const glm::dvec2 range = range_in_box(ray, most);
    return std::max(range.y - range.x, 0.0);
}

/// Transforms a ray of the scene to the box: lengths are box sides, from the low corner.
inline Ray in_sides(const Box& box, const Ray& ray)
{
    const glm::dmat4 grid_from_anchor(box.grid_from_anchor);
    return {glm::dvec3(grid_from_anchor * glm::dvec4(ray.origin, 1.0)) / glm::dvec3(box.cells),
            glm::dmat3(grid_from_anchor) * ray.direction / glm::dvec3(box.cells)};
}

inline std::vector<Camera> cameras()
{
    Camera parallel{.eye = {0.4, 0.3, 2.2}, .target = {0.0, 0.05, 0.0}, .near_m = near_m};
    parallel.orthographic_half_height_m = 0.9;
    return {Seen().camera,
            parallel,
            // The last one is inside the box.
            {.eye = {0.1, -0.05, 0.2}, .target = {0.3, 0.1, -1.0}, .near_m = near_m}};
}

} // namespace estampe::smoke
