// SPDX-License-Identifier: MIT
#include <algorithm>

#include "gpu/upload.hpp"
#include "techniques/ink/flow/flow.hpp"
#include "techniques/ink/ink.hpp"

namespace estampe::ink {
namespace {

constexpr uint64_t sums_bytes = 16; // there is no smaller buffer

template <class T>
gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, std::span<const T> items)
{
    gpu::Buffer buffer(device, name, std::max<size_t>(items.size_bytes(), sizeof(glm::vec4)),
                       gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(items), buffer.mapped().begin());
    return buffer;
}

} // namespace

std::array<uint64_t, 3> Memory::kept_bytes(const Grid& grid)
{
    const uint64_t count = grid.cell_count();
    // Depths of the cube are never asked for.
    return {sizeof(uint32_t) * count, sizeof(float) * (grid.face_side > 0 ? 4 : count), sums_bytes};
}

void Memory::make_room(gpu::Device& device, const Grid& grid)
{
    const auto bytes = kept_bytes(grid);
    for (gpu::Buffer& cells : cells_) {
        cells = gpu::Buffer(device, "ink cells", bytes[0], gpu::MemoryUse::device);
    }
    for (gpu::Buffer& depths : depths_) {
        depths = gpu::Buffer(device, "ink depths", bytes[1], gpu::MemoryUse::device);
    }
    grid_ = grid;
    forget();
}

void Memory::ensure(gpu::Device& device, const InkStyle& style, const Plan& plan)
{
    if (grid_ != plan.grid || cells_.front().empty()) {
        make_room(device, plan.grid);
    }
    if (plan.time.is_fresh || sums_.empty()) {
        sums_ = gpu::upload_buffer(device, "ink sums", std::vector<std::byte>(sums_bytes));
        sum_now_ = 0;
    }
    show(device, plan);
    mask_ = mapped_buffer(device, "ink mask", std::span<const uint32_t>(plan.mask));
    const bool has_map = (plan.variant & shared::ink_has_map) != 0;
    const bool has_picture = has_map && !style.flow_map.empty();
    if (has_picture && (map_file_ != style.flow_map || map_page_mm_ != plan.globals.page_mm)) {
        map_stream_ = stream_of_flow(read_flow(style.flow_map), plan.globals.page_mm);
        map_file_ = style.flow_map;
        map_page_mm_ = plan.globals.page_mm;
        holds_picture_ = false;
    }
    if (!plan.stream.empty()) {
        std::vector<float> stream = plan.stream;
        for (size_t i = 0; has_picture && i < stream.size(); ++i) {
            stream[i] += style.flow_mm_s * map_stream_[i];
        }
        map_ = gpu::upload_buffer(device, "ink flow map", stream);
        holds_picture_ = false;
    } else if (map_.empty() || (has_picture && !holds_picture_)) {
        map_ = gpu::upload_buffer(device, "ink flow map", has_picture ? map_stream_ : std::vector<float>(4));
        holds_picture_ = has_picture;
    }
}

void Memory::show(gpu::Device& device, const Plan& plan)
{
    globals_ = mapped_buffer(device, "ink", std::span(&plan.globals, 1));
}

void Memory::end_picture(const Plan& plan)
{
    time_s_ = plan.time.to_s;
}

std::optional<Memory::Kept> Memory::kept() const
{
    return time_s_ ? std::optional(Kept{grid_, *time_s_, sum_now_}) : std::nullopt;
}

std::array<gpu::Buffer*, 3> Memory::kept_buffers()
{
    return {&cells_.at(newest_), &depths_.at(newest_depth_), &sums_};
}

void Memory::recall(gpu::Device& device, const Kept& kept, std::array<gpu::Buffer, 3> buffers)
{
    make_room(device, kept.grid);
    cells_.at(newest_) = std::move(buffers[0]);
    depths_.at(newest_depth_) = std::move(buffers[1]);
    sums_ = std::move(buffers[2]);
    sum_now_ = kept.sum_now;
    time_s_ = kept.time_s;
}

} // namespace estampe::ink
