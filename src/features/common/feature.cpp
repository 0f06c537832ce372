// SPDX-License-Identifier: MIT
#include "features/common/feature.hpp"

#include <estampe/error.hpp>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"

namespace estampe::features {

void fail_damaged()
{
    throw Error("this is not the memory of a film's frame");
}

void FilmWriter::buffers(std::span<gpu::Buffer* const> buffers)
{
    std::vector<gpu::Buffer> copies;
    copies.reserve(buffers.size());
    gpu::Graph graph;
    for (gpu::Buffer* const buffer : buffers) {
        copies.emplace_back(device_, "film memory", buffer->size_bytes(), gpu::MemoryUse::readback);
        gpu::add_read_back(graph, "remember", gpu::import_whole(graph, "remembered", *buffer), copies.back());
    }
    executor_.run(graph);
    for (const gpu::Buffer& copy : copies) {
        append(copy.mapped());
    }
}

std::vector<float> FilmReader::floats(uint64_t count)
{
    if (count > left_.size() / sizeof(float)) {
        fail_damaged();
    }
    const auto bytes = take(sizeof(float) * count);
    std::vector<float> numbers(count);
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

gpu::Buffer FilmReader::buffer(const char* name, uint64_t size_bytes)
{
    return gpu::upload_buffer(device_, name, take(size_bytes));
}

std::span<const std::byte> FilmReader::take(uint64_t size_bytes)
{
    if (left_.size() < size_bytes) {
        fail_damaged();
    }
    const auto taken = left_.first(size_bytes);
    left_ = left_.subspan(size_bytes);
    return taken;
}

} // namespace estampe::features
