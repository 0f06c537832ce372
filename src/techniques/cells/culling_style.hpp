// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "style/parameter.hpp"

namespace estampe::cells {

/// Whether a picture leaves out the rooms that are not seen through portals.
enum class Culling : uint8_t { off, portals };

/// The style's section [culling], which changes the time of a picture and not the picture.
struct CullingStyle {
    Culling cells = Culling::off;
};

[[nodiscard]] const style::Table<CullingStyle>& culling_table();

} // namespace estampe::cells
