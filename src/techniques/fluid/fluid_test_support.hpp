// SPDX-License-Identifier: MIT
#pragma once

// Fields that tests start from and read back: numbers in double precision, at their places on the grid.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "support/gpu_device.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::fluid {

/// Velocity of a place in metres.
using Flow = std::function<glm::dvec3(glm::dvec3)>;

[[nodiscard]] inline glm::dvec3 place_of(const Grid& grid, uint32_t component, glm::uvec3 cell)
{
    glm::dvec3 place = glm::dvec3(cell) + 0.5;
    if (component < 3) {
        place[static_cast<int>(component)] -= 0.5;
    }
    return place * static_cast<double>(grid.cell_m);
}

template <class Value>
[[nodiscard]] std::vector<float> over_nodes(const Grid& grid, uint32_t channels, Value value)
{
    std::vector<float> numbers;
    for (uint32_t i = 0; i < channels; ++i) {
        for (uint32_t k = 0; k < grid.cell_count(); ++k) {
            const glm::uvec3 cell(k % grid.cells.x, k / grid.cells.x % grid.cells.y,
                                  k / (grid.cells.x * grid.cells.y));
            numbers.push_back(static_cast<float>(value(i, cell)));
        }
    }
    return numbers;
}

/// On the faces of the grid.
[[nodiscard]] inline std::vector<float> velocity_of(const Grid& grid, const Flow& flow)
{
    return over_nodes(grid, grid.dimensions(), [&](uint32_t component, glm::uvec3 cell) {
        return flow(place_of(grid, component, cell))[static_cast<int>(component)];
    });
}

/// All layers of an image that `graph` makes, one after the other.
[[nodiscard]] inline std::vector<float> run_and_read_layers(gpu::Graph& graph, gpu::ImageId image)
{
    const gpu::ImageDesc desc = graph.describe(image);
    gpu::BufferId numbers = graph.buffer("layers", {.size_bytes = gpu::size_bytes(desc)});
    auto copy = graph.custom("copy layers");
    copy.touch(image, gpu::Access::transfer_read);
    numbers = copy.touch_write(numbers, gpu::Access::transfer_write);
    copy.execute([image, numbers, desc](gpu::Recorder& recorder) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, desc.layers},
                                       .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(image).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, recorder.buffer(numbers).handle(), 1,
                               &region);
    });
    auto hand_on = graph.custom("hand on");
    hand_on.touch(image, gpu::Access::compute_sampled);
    hand_on.keep().execute([](gpu::Recorder&) {});
    return test::run_and_read_as<float>(graph, numbers);
}

} // namespace estampe::fluid
