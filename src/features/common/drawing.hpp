// SPDX-License-Identifier: MIT
#pragma once

// The first page of a style: a few factors over whatever the preset says, for who draws.

#include <cstdint>

#include "style/parameter.hpp"

namespace estampe::features {

struct StyleTables;

enum class PaperKind : uint8_t { preset, white, cream, none };

/// Factors; 1 leaves what the rest of the style says.
struct DrawingStyle {
    float line_weight = 1.0F;
    float hatch_spacing = 1.0F;
    float hatch_weight = 1.0F;
    float darkness = 1.0F;
    float contrast = 1.0F;
    float detail = 1.0F;
    float wobble = 1.0F;
    float color = 1.0F;
    PaperKind paper = PaperKind::preset;
    int seed = 1;

    bool operator==(const DrawingStyle&) const = default;
};

[[nodiscard]] const style::Table<DrawingStyle>& drawing_table();

/// The style with its section [drawing] carried out on all other sections and on what single materials and
/// objects have otherwise; values are kept within their ranges. Returns `style` itself if the section changes
/// nothing, else `room`, whose memory is used again. Cost: some microseconds.
[[nodiscard]] const StyleTables& with_drawing(const StyleTables& style, StyleTables& room);

} // namespace estampe::features
