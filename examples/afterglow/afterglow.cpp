// SPDX-License-Identifier: MIT
#include "afterglow.hpp"

#include <array>
#include <cmath>

#include "afterglow.glsl.h"
#include "gpu/resources.hpp"
#include "shaders/afterglow_comp.hpp"

namespace estampe::features {
namespace {

uint64_t bytes_of(glm::uvec2 size_px)
{
    return sizeof(float) * uint64_t{size_px.x} * size_px.y;
}

} // namespace

AfterglowPlan Afterglow::plan(gpu::Device& device, glm::uvec2 size_px, double time_s, bool follows,
                              const AfterglowStyle& style)
{
    if (ink_.empty() || size_px != size_px_) {
        ink_ = gpu::Buffer(device, "afterglow", bytes_of(size_px), gpu::MemoryUse::device);
        size_px_ = size_px;
        time_s_.reset();
    }
    AfterglowPlan plan{.size_px = size_px, .time_s = time_s};
    if (follows && time_s_ && *time_s_ <= time_s) {
        plan.kept =
            static_cast<float>(std::exp2((*time_s_ - time_s) / static_cast<double>(style.half_life_s)));
    }
    time_s_.reset(); // no previous picture until this picture has been drawn
    return plan;
}

gpu::ImageId Afterglow::record(gpu::Graph& graph, const AfterglowPlan& plan, gpu::ImageId ink)
{
    auto pass = graph.compute("afterglow", shaders::afterglow_comp);
    pass.sample(ink);
    static_cast<void>(pass.modify(gpu::import_whole(graph, "afterglow", ink_)));
    const gpu::ImageId lasting = pass.write(graph.image(
        "afterglow/ink", {.width = plan.size_px.x, .height = plan.size_px.y, .format = gpu::Format::r16f}));
    pass.push(shared::AfterglowConstants{.size_px = plan.size_px, .kept = plan.kept})
        .dispatch_over(plan.size_px.x, plan.size_px.y);
    return lasting;
}

void Afterglow::drawn(const AfterglowPlan& plan)
{
    time_s_ = plan.time_s;
}

void Afterglow::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::film_recalled) {
        time_s_.reset();
    }
}

void Afterglow::save(FilmWriter& writer)
{
    if (time_s_) {
        writer.value(size_px_);
        writer.value(*time_s_);
        writer.buffers(std::array{&ink_});
    }
}

void Afterglow::load(FilmReader& reader)
{
    const auto size_px = reader.value<glm::uvec2>();
    const auto time_s = reader.value<double>();
    ink_ = reader.buffer("afterglow", bytes_of(size_px));
    size_px_ = size_px;
    time_s_ = time_s;
}

} // namespace estampe::features
