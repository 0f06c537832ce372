// SPDX-License-Identifier: MIT
#pragma once

// From what the stages of a picture come to, to its layers.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <estampe/layers.hpp>

namespace estampe::frame {

/// Which share of each pixel belongs to what, over several samples. Most pixels are of one thing alone.
class Shares {
public:
    explicit Shares(size_t pixel_count) : first_(pixel_count), first_count_(pixel_count) {}

    /// Another sample: a number for each pixel, 0 for nothing.
    void add(std::span<const uint32_t> things);

    /// How often each thing was seen where it was seen at all: pixel and count, in the order of pixels.
    using Places = std::vector<std::pair<uint32_t, uint32_t>>;
    [[nodiscard]] std::map<uint32_t, Places> places() const;

private:
    std::vector<uint32_t> first_; ///< the first thing seen there
    std::vector<uint32_t> first_count_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> rest_; ///< by pixel and thing
};

/// A mask that holds no more of the page than it has to.
[[nodiscard]] PictureMask cropped_mask(std::string name, uint32_t page_width, const Shares::Places& places,
                                       uint32_t sample_count);

/// What the first layers come to, pixel by pixel; colours opaque, with the cover of the topmost in alpha.
struct StageColors {
    std::span<const glm::vec4> paper;
    std::span<const glm::vec4> wash;
    std::span<const glm::vec4> ink; ///< that flows; empty where there is none, which has no layer then
    std::span<const glm::vec4> hatch;
    std::span<const glm::vec4> lines;
    std::span<const glm::vec4> smoke; ///< empty where there is none
    bool is_transparent = false;      ///< the wash's alpha is that of what lies on paper of this colour
    glm::vec3 paper_color{1.0F};
};

/// The layers between these: laid on each other they give each stage again, but for the last bits of floats.
/// The paper of a transparent picture is a hidden layer, and its wash has alpha in place of multiplying.
[[nodiscard]] std::vector<PictureLayer> layers_between(const StageColors& stages, uint32_t width,
                                                       uint32_t height);

} // namespace estampe::frame
