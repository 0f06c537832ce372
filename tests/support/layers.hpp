// SPDX-License-Identifier: MIT
#pragma once

// Images that a test fills pixel by pixel, as inputs of a technique in place of other techniques' outputs.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/resources.hpp"

namespace estampe::test {

/// Page position in whole pixels, y down.
template <class Texel>
using Painter = std::function<Texel(glm::uvec2)>;

/// An image on the shared device. Must outlive the run of every graph that uses the image.
class Layer {
public:
    [[nodiscard]] gpu::ImageId in(gpu::Graph& graph);

    static Layer coverage(glm::uvec2 size_px, const Painter<float>& paint);       ///< r16f
    static Layer color(glm::uvec2 size_px, const Painter<glm::vec4>& paint);      ///< rgba16f
    static Layer root_color(glm::uvec2 size_px, const Painter<glm::vec4>& paint); ///< rgba8, roots of rgb
    static Layer words(glm::uvec2 size_px, const Painter<uint32_t>& paint);       ///< r32ui
    static Layer depth(glm::uvec2 size_px, const Painter<float>& paint);          ///< r32f
    static Layer places(glm::uvec2 size_px, const Painter<glm::vec4>& paint);     ///< rgba32f
    static Layer normals(glm::uvec2 size_px, const Painter<glm::vec3>& paint);    ///< rg32ui, packed twice

    /// rgba32ui: changes of a coordinate per pixel to the right and down, packed as by the surface pass.
    static Layer footprints(glm::uvec2 size_px, const Painter<std::pair<glm::vec3, glm::vec3>>& paint);

private:
    Layer() = default;
    template <class Texel>
    static Layer of(gpu::Format format, glm::uvec2 size_px, const Painter<Texel>& paint);

    gpu::Image image_;
};

/// Runs `graph`. Returns the texels of an rgba16f image, row by row.
[[nodiscard]] std::vector<glm::vec4> run_and_read_colors(gpu::Graph& graph, gpu::ImageId image);

/// Runs `graph`. Returns the texels of an r16f image, row by row.
[[nodiscard]] std::vector<float> run_and_read_coverage(gpu::Graph& graph, gpu::ImageId image);

} // namespace estampe::test
