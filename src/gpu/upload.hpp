// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "gpu/resources.hpp"

namespace estampe::gpu {

/// Records commands with `record`, runs them, and waits: for uploads and read-backs outside the frame.
void run_once(Device& device, const std::function<void(VkCommandBuffer)>& record);

/// A device buffer filled with `bytes`. Cost: one staging copy, and a wait.
[[nodiscard]] Buffer upload_buffer(Device& device, const std::string& name, std::span<const std::byte> bytes);

template <class T>
[[nodiscard]] Buffer upload_buffer(Device& device, const std::string& name, const std::vector<T>& items)
{
    return upload_buffer(device, name, std::as_bytes(std::span(items)));
}

/// The levels of one layer of an image, finest first, each tightly packed.
struct LayerPixels {
    std::vector<std::vector<std::byte>> levels;
};

/// Fills all layers and levels of `image` and leaves it in the shader-read layout. Layers go through one
/// staging buffer in turn, so the peak of host memory is one layer.
void upload_layers(Device& device, Image& image,
                   const std::function<LayerPixels(uint32_t layer)>& layer_pixels);

} // namespace estampe::gpu
