// SPDX-License-Identifier: MIT
#pragma once

// Reads OpenRaster files as painting programs do: by libzip and pugixml, and by the reader of images.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/image.hpp>

namespace estampe::test {

struct RasterLayer {
    std::string name;
    std::string group; ///< of the stack that it lies in; empty: the outermost
    std::string operation;
    bool is_visible = false;
    uint32_t x = 0;
    uint32_t y = 0;
    Image image;
};

struct OpenRaster {
    std::vector<std::string> entries; ///< of the archive, in its order
    std::string mimetype;
    bool is_mimetype_stored = false;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<RasterLayer> layers; ///< from the bottom up
    Image merged;
    Image thumbnail;
};

/// Adds a failure to the running test where the file is none.
[[nodiscard]] OpenRaster read_openraster(std::span<const std::byte> bytes);

/// The visible layers on each other in sRGB-encoded values, 0 to 255: rounded after each, or at the end.
[[nodiscard]] std::vector<glm::dvec3> composite(const OpenRaster& raster, bool rounds_each);

/// The largest difference of any channel, in steps of 1/255.
[[nodiscard]] double largest_difference(const std::vector<glm::dvec3>& values, const Image& image);

/// The share of pixels that are not the picture's very bytes.
[[nodiscard]] double share_that_differs(const std::vector<glm::dvec3>& values, const Image& image);

} // namespace estampe::test
