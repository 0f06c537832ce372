// SPDX-License-Identifier: MIT
#pragma once

// Section [drawing] of a style: the few factors that an artist changes first. The factors of the section
// [drawing] multiply the values of the preset.

#include <cstdint>

#include "style/parameter.hpp"

namespace estampe::features {

struct StyleTables;

enum class PaperKind : uint8_t { preset, white, cream, none };

/// Values of the section [drawing]. Each factor multiplies values of the style's other sections; 1 changes
/// nothing.
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

/// Applies the section [drawing] to all other sections of the style. In overrides for single materials and
/// objects, only numbers are changed. Values stay within their ranges. Returns `style` itself if the section
/// [drawing] changes nothing. Otherwise returns `room`; the memory of `room` is reused. Cost: some
/// microseconds.
[[nodiscard]] const StyleTables& with_drawing(const StyleTables& style, StyleTables& room);

} // namespace estampe::features
