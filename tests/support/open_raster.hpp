// SPDX-License-Identifier: MIT
#pragma once

// Reads OpenRaster files as painting programs do, with libzip, pugixml and the image reader.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/image.hpp>

namespace estampe::test {

struct RasterLayer {
    std::string name;
    std::string group; ///< name of the stack that contains the layer; empty: the outermost stack
    std::string operation;
    bool is_visible = false;
    uint32_t x = 0;
    uint32_t y = 0;
    Image image;
};

struct OpenRaster {
    std::vector<std::string> entries; ///< names of the archive's entries, in the archive's order
    std::string mimetype;
    bool is_mimetype_stored = false;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<RasterLayer> layers; ///< from the bottom up
    Image merged;
    Image thumbnail;
};

/// Adds a failure to the running test if the file is not a valid OpenRaster file.
[[nodiscard]] OpenRaster read_openraster(std::span<const std::byte> bytes);

/// Composites the visible layers in sRGB-encoded values, 0 to 255. Rounds after each layer, or only at the
/// end.
[[nodiscard]] std::vector<glm::dvec3> composite(const OpenRaster& raster, bool rounds_each);

/// The largest difference of any channel, in steps of 1/255.
[[nodiscard]] double largest_difference(const std::vector<glm::dvec3>& values, const Image& image);

/// The share of pixels whose bytes differ from the picture's.
[[nodiscard]] double share_that_differs(const std::vector<glm::dvec3>& values, const Image& image);

} // namespace estampe::test
