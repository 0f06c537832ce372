// SPDX-License-Identifier: MIT
#include "features/ink/flowing_ink.hpp"

#include <algorithm>
#include <array>

#include "features/ink/ink_zones.hpp"

namespace estampe::features {
namespace {

shared::FrameGlobals page_seen_by(const FlowingInkInputs& in, const Camera& camera)
{
    return frame_globals(
        camera, in.layout.bounds, in.layout.anchor,
        {.size_px = {in.settings.width, in.settings.height}, .page_height_mm = in.style.paper.height_mm});
}

ink::Page page_of(const FlowingInkInputs& in)
{
    const glm::uvec2 size_px(in.settings.width, in.settings.height);
    const float px_per_mm = pixels_per_mm(size_px.y, in.style.paper.height_mm);
    const paper::Window window = paper::window_of(in.style.paper, static_cast<float>(size_px.x) / px_per_mm);
    const PixelSize pixel = pixel_size(in.camera, size_px.y);
    return {.size_px = size_px,
            .pixels_per_mm = px_per_mm,
            .window_min_mm = window.min_mm,
            .window_max_mm = window.max_mm,
            .rad_per_mm = pixel.is_parallel ? 0.0F : pixel.at_one_m * px_per_mm};
}

ink::View view_of(const FlowingInkInputs& in, const MotionPlan& moved)
{
    const glm::mat4& now = moved.clip_from_anchor;
    const glm::mat4& before = moved.clip_from_anchor_before;
    const glm::dvec3 forward = glm::normalize(in.camera.target - in.camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, in.camera.up));
    const auto near_m = static_cast<float>(in.camera.near_m);
    return {.before_from_clip = glm::mat4(glm::dmat4(before) * glm::inverse(glm::dmat4(now))),
            .is_moved = before != now,
            .has_motion = moved.pose_moved,
            .plane_depth = std::min(near_m / std::max(in.nearby_m, near_m), 1.0F),
            .forward = glm::vec3(forward),
            .up = glm::vec3(glm::cross(right, forward))};
}

void save_camera(FilmWriter& writer, const Camera& camera)
{
    writer.value(camera.eye);
    writer.value(camera.target);
    writer.value(camera.up);
    writer.value(camera.vertical_fov_rad);
    writer.value(camera.near_m);
    writer.value(camera.orthographic_half_height_m.value_or(-1.0)); // negative: in perspective
}

Camera load_camera(FilmReader& reader)
{
    Camera camera{.eye = reader.value<glm::dvec3>(),
                  .target = reader.value<glm::dvec3>(),
                  .up = reader.value<glm::dvec3>()};
    camera.vertical_fov_rad = reader.value<double>();
    camera.near_m = reader.value<double>();
    const auto half_height_m = reader.value<double>();
    if (half_height_m >= 0.0) {
        camera.orthographic_half_height_m = half_height_m;
    }
    return camera;
}

} // namespace

void FlowingInk::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::anchor_moved || event == Event::film_recalled) {
        forget();
    }
}

void FlowingInk::forget()
{
    memory_.forget();
    water_.forget();
}

void FlowingInk::save(FilmWriter& writer)
{
    const std::optional<ink::Memory::Kept> kept = memory_.kept();
    const std::optional<KeptWater> water = water_.kept(writer.device(), writer.executor());
    if (!kept && !water) {
        return;
    }
    writer.flag(kept.has_value());
    if (kept) {
        writer.value(kept->grid.size);
        writer.value(kept->grid.margin_cells);
        writer.value(kept->grid.cells_per_px);
        writer.value(kept->grid.mm_per_cell);
        writer.value(kept->grid.face_side);
        writer.value(kept->time_s);
        writer.value(kept->sum_now);
        save_camera(writer, camera_before_);
        writer.buffers(memory_.kept_buffers());
    }
    writer.flag(water.has_value());
    if (water) {
        writer.value(water->time_s);
        writer.value(uint64_t{water->velocity.size()});
        writer.floats(water->velocity);
    }
}

void FlowingInk::load(FilmReader& reader)
{
    forget();
    if (reader.flag()) {
        ink::Memory::Kept kept;
        kept.grid.size = reader.value<glm::uvec2>();
        kept.grid.margin_cells = reader.value<glm::vec2>();
        kept.grid.cells_per_px = reader.value<float>();
        kept.grid.mm_per_cell = reader.value<float>();
        kept.grid.face_side = reader.value<uint32_t>();
        kept.time_s = reader.value<double>();
        kept.sum_now = reader.value<uint32_t>() & 1U;
        camera_before_ = load_camera(reader);
        const std::array<uint64_t, 3> bytes = ink::Memory::kept_bytes(kept.grid);
        std::array<gpu::Buffer, 3> buffers;
        for (size_t i = 0; i < bytes.size(); ++i) {
            buffers.at(i) = reader.buffer("ink", bytes.at(i));
        }
        memory_.recall(reader.device(), kept, std::move(buffers));
    }
    if (reader.flag()) {
        const auto time_s = reader.value<double>();
        water_.recall({.time_s = time_s, .velocity = reader.floats(reader.value<uint64_t>())});
    }
}

std::optional<double> FlowingInk::before_s(const RenderSettings& settings, const ink::InkStyle& style) const
{
    const bool goes_on = style.drawn && settings.continuity == Continuity::follows;
    return goes_on ? memory_.time_s() : std::nullopt;
}

std::optional<InkPlan> FlowingInk::ensure(gpu::Device& device, gpu::Executor& executor,
                                          const FlowingInkInputs& in, std::vector<std::string>& notes)
{
    const ink::InkStyle& style = in.style.ink;
    if (!style.drawn) {
        forget();
        return std::nullopt;
    }
    const ink::Page page = page_of(in);
    const bool is_there = memory_.holds(ink::grid_of(style, page));
    const std::optional<double> before = is_there ? before_s(in.settings, style) : std::nullopt;
    const ink::Time time = ink::time_of(style, in.settings.time_s, before);
    const shared::FrameGlobals seen = page_seen_by(in, in.camera);
    const std::vector<shared::InkZone> zones = ink_zones(
        {.scene = in.scene, .pose = in.pose, .anchor = in.layout.anchor, .page = seen}, style.zones, notes);
    const Camera& before_camera = time.is_fresh ? in.camera : camera_before_;
    const MotionPlan moved{.clip_from_anchor = seen.clip_from_anchor,
                           .clip_from_anchor_before = page_seen_by(in, before_camera).clip_from_anchor,
                           .pose_moved = in.pose_moved};
    InkPlan plan{.ink = ink::plan_of(style, page, time, view_of(in, moved), zones), .motion = {}};
    plan.ink.variant |= device.execution().looks_only_where_needed() ? uint32_t{shared::ink_in_strips} : 0U;
    if (style.solved > 0.0F && plan.ink.grid.face_side == 0) {
        ink::add_stream(plan.ink, water_.stirred(device, executor, style, page, time, zones,
                                                 in.settings.measure_solvers));
    } else {
        water_.forget();
    }
    if ((plan.ink.first_variant & shared::ink_has_motion) != 0) {
        plan.motion = moved;
    }
    plan.ink.mask = ink_mask(in.layout, in.scene, style.objects, notes);
    memory_.ensure(device, style, plan.ink);
    memory_.forget(); // until it has been drawn
    return plan;
}

InkPlan FlowingInk::shown_on(gpu::Device& device, const InkPlan& drawn, const FlowingInkInputs& in)
{
    InkPlan shown{.ink = ink::shown_on(drawn.ink, page_of(in)), .motion = {}};
    memory_.show(device, shown.ink);
    return shown;
}

void FlowingInk::drawn(const InkPlan& plan, const Camera& camera)
{
    memory_.end_picture(plan.ink);
    camera_before_ = camera;
}

} // namespace estampe::features
