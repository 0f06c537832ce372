// SPDX-License-Identifier: MIT
#include "techniques/raster/choose_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <estampe/error.hpp>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/mesh.glsl.h"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {
namespace {

constexpr glm::uvec2 page_px(1280, 720);
constexpr uint32_t quads_across = 128;
constexpr double worthwhile = 0.8;
constexpr int rounds = 3;

struct Mesh {
    std::vector<shared::PosedVertex> vertices;
    std::vector<glm::uvec4> triangles;
};

/// A wavy sheet over the whole page, in clip space.
void add_sheet(Mesh& mesh, float depth, bool faces_the_eye)
{
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    constexpr uint32_t row = quads_across + 1;
    for (uint32_t y = 0; y < row; ++y) {
        for (uint32_t x = 0; x < row; ++x) {
            const glm::vec2 place = 2.0F * glm::vec2(x, y) / static_cast<float>(quads_across) - 1.0F;
            const float wave = std::sin(9.0F * place.x) * std::sin(7.0F * place.y);
            mesh.vertices.push_back({.position = {place, depth + 0.05F * wave}});
        }
    }
    for (uint32_t y = 0; y < quads_across; ++y) {
        for (uint32_t x = 0; x < quads_across; ++x) {
            const uint32_t a = first + y * row + x;
            const uint32_t b = faces_the_eye ? a + row : a + 1;
            const uint32_t c = faces_the_eye ? a + 1 : a + row;
            mesh.triangles.emplace_back(a, b, c, 0U);
            mesh.triangles.emplace_back(b, a + row + 1, c, 0U);
        }
    }
}

double total_ms(const std::vector<PassTiming>& timings)
{
    double sum = 0.0;
    for (const PassTiming& pass : timings) {
        sum += pass.gpu_ms;
    }
    return sum;
}

} // namespace

RasterPath measure_paths(gpu::Device& device, gpu::Executor& executor)
{
    Mesh mesh; // a body's front, and its back behind it
    add_sheet(mesh, 0.7F, true);
    add_sheet(mesh, 0.3F, false);
    gpu::Buffer vertices = gpu::upload_buffer(device, "measured vertices", mesh.vertices);
    gpu::Buffer triangles = gpu::upload_buffer(device, "measured triangles", mesh.triangles);
    const auto draw_ms = [&](RasterPath path) {
        gpu::Graph graph;
        const RasterInputs in = unmasked_inputs(graph, gpu::import_whole(graph, "triangles", triangles),
                                                gpu::import_whole(graph, "vertices", vertices));
        const Batch batch{.triangle_count = static_cast<uint32_t>(mesh.triangles.size()), .plain = true};
        graph.export_buffer(
            add_visibility(graph, "measured", in, {&batch, 1}, {.size_px = page_px, .path = path}));
        executor.run(graph);
        return total_ms(executor.timings());
    };
    double hardware_ms = std::numeric_limits<double>::max();
    double compute_ms = std::numeric_limits<double>::max();
    for (int round = 0; round <= rounds; ++round) {
        const double hardware_now_ms = draw_ms(RasterPath::hardware);
        const double compute_now_ms = draw_ms(RasterPath::compute);
        if (round > 0) { // the first one warms up
            hardware_ms = std::min(hardware_ms, hardware_now_ms);
            compute_ms = std::min(compute_ms, compute_now_ms);
        }
    }
    return hardware_ms < worthwhile * compute_ms ? RasterPath::hardware : RasterPath::compute;
}

std::optional<RasterPath> settled_path(const DeviceInfo& device, RasterPath wanted)
{
    if (wanted == RasterPath::compute && !device.compute_raster) {
        throw Error(device.name + " cannot draw triangles in compute: it lacks 64-bit buffer atomics",
                    "raster", "use hardware or auto");
    }
    if (wanted != RasterPath::automatic) {
        return wanted;
    }
    return device.software || !device.compute_raster ? std::optional(RasterPath::hardware) : std::nullopt;
}

Paths paths_of(const DeviceInfo& device, RasterPath wanted, RasterPath chosen, const PageWork& work)
{
    Paths paths{.page = chosen, .maps = chosen};
    const bool is_free = device.software && device.compute_raster && wanted == RasterPath::automatic;
    if (is_free && !work.has_masks && 8 * work.triangles >= work.pixels) {
        paths.page = RasterPath::compute;
    }
    return paths;
}

RasterPath choose_path(gpu::Device& device, gpu::Executor& executor, RasterPath wanted)
{
    const auto settled = settled_path(device.info(), wanted);
    return settled ? *settled : measure_paths(device, executor);
}

} // namespace estampe::raster

namespace estampe {

const char* name_of(RasterPath path)
{
    switch (path) {
    case RasterPath::automatic:
        return "auto";
    case RasterPath::hardware:
        return "hardware";
    case RasterPath::compute:
        return "compute";
    }
    return "";
}

} // namespace estampe
