// SPDX-License-Identifier: MIT
#include "frame/surface_buffers.hpp"

#include <limits>

#include <fmt/format.h>

#include <estampe/surface_buffers.hpp>

#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "features/motion/motion.hpp"
#include "frame/renderer_impl.hpp"
#include "gpu/transfers.hpp"

namespace estampe::frame {

SurfaceReading make_surface_reading(gpu::Device& device, glm::uvec2 size_px)
{
    const uint64_t pixels = uint64_t{size_px.x} * size_px.y;
    const auto buffer = [&](const char* name, uint64_t texel_bytes) {
        return gpu::Buffer(device, name, texel_bytes * pixels, gpu::MemoryUse::readback);
    };
    return {.draw = buffer("draw read-back", sizeof(uint32_t)),
            .depth = buffer("depth read-back", sizeof(float)),
            .normal = buffer("normal read-back", sizeof(glm::uvec2))};
}

void declare_surface_reading(gpu::Graph& graph, const surface::Surface& surface, SurfaceReading& reading)
{
    gpu::add_read_back(graph, "surface/read draw", surface.draw, reading.draw);
    gpu::add_read_back(graph, "surface/read depth", surface.depth, reading.depth);
    gpu::add_read_back(graph, "surface/read normal", surface.normal, reading.normal);
}

namespace {

/// Converts reversed depth to the distance from the eye along the axis of view.
class Distance {
public:
    Distance(const Camera& camera, const pose::MeshData& layout, const features::ViewSettings& settings)
        : is_parallel_(camera.orthographic_half_height_m.has_value()), near_m_(camera.near_m)
    {
        if (is_parallel_) {
            const shared::FrameGlobals globals =
                features::frame_globals(camera, layout.bounds, layout.anchor, settings);
            const auto distance_at = [&](float depth) {
                const glm::vec4 place = globals.anchor_from_clip * glm::vec4(0.0F, 0.0F, depth, 1.0F);
                return glm::dot(glm::dvec3(place) + layout.anchor - camera.eye,
                                glm::normalize(camera.target - camera.eye));
            };
            at_zero_m_ = distance_at(0.0F);
            at_one_m_ = distance_at(1.0F);
        }
    }

    [[nodiscard]] float of(float depth) const
    {
        return static_cast<float>(is_parallel_ ? at_zero_m_ + depth * (at_one_m_ - at_zero_m_)
                                               : near_m_ / depth);
    }

private:
    bool is_parallel_;
    double near_m_;
    double at_zero_m_ = 0.0;
    double at_one_m_ = 0.0;
};

/// Memory that one pixel takes: 40 bytes in SurfaceReading and SurfaceBuffers together, and 32 for its
/// motion.
constexpr uint64_t bytes_a_buffer_pixel = 72;

/// The node and the material of each draw call.
struct DrawnThing {
    Index object = no_index;
    Index material = no_index;
};

std::vector<DrawnThing> things_of(const LoadedScene& loaded)
{
    std::vector<DrawnThing> things(loaded.layout.draws.size());
    for (size_t i = 0; i < loaded.layout.sources.size(); ++i) {
        const Index object = loaded.layout.sources[i].node;
        const Index material = loaded.layout.draws[i].material;
        if (object < loaded.given_nodes) {
            things[i].object = object;
            things[i].material = material < loaded.given_materials ? material : no_index;
        }
    }
    return things;
}

} // namespace
} // namespace estampe::frame

namespace estampe {

SurfaceBuffers Renderer::render_buffers(const Camera& camera, const Style& style,
                                        const RenderSettings& settings)
{
    Impl& impl = *impl_;
    const JobLimits job_limits(settings.limits);
    const features::StyleTables& tables = impl.tables_of(style);
    frame::check_page_memory({settings.width, settings.height});
    frame::check_size(impl.device, settings);
    RenderSettings page_settings = settings;
    if (page_settings.motion_since) {
        page_settings.motion_since->camera =
            page_camera(page_settings.motion_since->camera, tables.paper, settings);
    }
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    frame::FramePlan plan = impl.prepare(seen_by, tables, page_settings);
    const glm::uvec2 size_px(settings.width, settings.height);
    require_memory(frame::bytes_a_buffer_pixel * size_px.x * size_px.y,
                   fmt::format("the buffers of {} x {} pixels", size_px.x, size_px.y), "size",
                   "ask for a smaller picture");
    frame::SurfaceReading reading = frame::make_surface_reading(impl.device, size_px);
    impl.draw_frame(seen_by, tables, plan, {.surface = &reading});

    SurfaceBuffers buffers{.width = settings.width, .height = settings.height};
    const size_t pixels = size_t{size_px.x} * size_px.y;
    buffers.depth_m.resize(pixels, std::numeric_limits<float>::infinity());
    buffers.normals.resize(pixels, glm::vec3(0.0F));
    buffers.objects.resize(pixels, no_index);
    buffers.materials.resize(pixels, no_index);
    const auto draws = gpu::items_of<uint32_t>(reading.draw);
    const auto depths = gpu::items_of<float>(reading.depth);
    const auto normals = gpu::items_of<glm::uvec2>(reading.normal);
    const frame::Distance distance(
        seen_by, impl.loaded->layout,
        {.size_px = size_px, .page_height_mm = static_cast<double>(tables.paper.height_mm)});
    const std::vector<frame::DrawnThing> things = frame::things_of(*impl.loaded);
    const frame::SeenWindow window = frame::window_within_margin(tables.paper, settings);
    for (uint32_t y = window.min_px.y; y < window.max_px.y; ++y) {
        for (uint32_t x = window.min_px.x; x < window.max_px.x; ++x) {
            const size_t i = size_t{y} * size_px.x + x;
            const uint32_t number = frame::draw_number(draws[i]);
            if (number == 0) {
                continue;
            }
            buffers.depth_m[i] = distance.of(depths[i]);
            buffers.normals[i] = pose::unpack_normal(normals[i].x);
            buffers.objects[i] = things.at(number - 1).object;
            buffers.materials[i] = things.at(number - 1).material;
        }
    }
    if (settings.motion_since) {
        impl.motion = features::read_motion(impl.buffers.motion_pixels, settings);
        buffers.motion = impl.motion;
        for (size_t i = 0; i < pixels; ++i) {
            const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
            if (glm::any(glm::lessThan(pixel, window.min_px)) ||
                glm::any(glm::greaterThanEqual(pixel, window.max_px))) {
                buffers.motion.pixels[i] = glm::vec4(0.0F);
            }
        }
    }
    return buffers;
}

} // namespace estampe
