// SPDX-License-Identifier: MIT
#include "contact_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <imgui.h>

#include <fmt/format.h>

#include <estampe/shapes.hpp>
#include <estampe/style.hpp>

#include "core/file.hpp"
#include "core/image_formats.hpp"
#include "drawing.hpp"
#include "messages.hpp"
#include "option_values.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

constexpr uint32_t gap_px = 16;
constexpr uint32_t letter_px = 13; // Height of the letters in Dear ImGui's own font
constexpr uint32_t letter_scale = 2;
constexpr uint32_t name_px = letter_px * letter_scale + gap_px / 2;

/// The letters of Dear ImGui's built-in font, as the coverage of each pixel. No font file is needed.
class Letters {
public:
    Letters()
    {
        atlas_.Flags |= ImFontAtlasFlags_NoMouseCursors | ImFontAtlasFlags_NoBakedLines;
        font_ = atlas_.AddFontDefault();
        atlas_.GetTexDataAsAlpha8(&coverage_, &width_, &height_);
    }

    /// Draws `text` in black; the text's upper left corner is at a pixel of the sheet.
    void draw(Image& sheet, const std::string& text, uint32_t left_px, uint32_t top_px) const
    {
        float pen = 0.0F;
        for (const char letter : text) {
            if (static_cast<unsigned char>(letter) > '~') {
                continue; // Skips the bytes of a character outside ASCII
            }
            const ImFontGlyph* glyph = font_->FindGlyphNoFallback(static_cast<ImWchar>(letter));
            if (glyph == nullptr) {
                continue;
            }
            draw(sheet, *glyph, left_px + letter_scale * static_cast<uint32_t>(pen), top_px);
            pen += glyph->AdvanceX;
        }
    }

private:
    void draw(Image& sheet, const ImFontGlyph& glyph, uint32_t left_px, uint32_t top_px) const
    {
        const auto from_x = static_cast<uint32_t>(std::lround(glyph.U0 * static_cast<float>(width_)));
        const auto from_y = static_cast<uint32_t>(std::lround(glyph.V0 * static_cast<float>(height_)));
        const auto wide = static_cast<uint32_t>(std::lround(glyph.X1 - glyph.X0)) * letter_scale;
        const auto high = static_cast<uint32_t>(std::lround(glyph.Y1 - glyph.Y0)) * letter_scale;
        left_px += letter_scale * static_cast<uint32_t>(std::lround(std::max(glyph.X0, 0.0F)));
        top_px += letter_scale * static_cast<uint32_t>(std::lround(std::max(glyph.Y0, 0.0F)));
        for (uint32_t y = 0; y < high && top_px + y < sheet.height; ++y) {
            for (uint32_t x = 0; x < wide && left_px + x < sheet.width; ++x) {
                const size_t texel = size_t{from_y + y / letter_scale} * static_cast<size_t>(width_) +
                                     from_x + x / letter_scale;
                const auto tone = static_cast<uint8_t>(255 - coverage_[texel]);
                uint8_t* pixel = &sheet.rgba[4 * (size_t{top_px + y} * sheet.width + left_px + x)];
                std::fill_n(pixel, 3, std::min(*pixel, tone));
            }
        }
    }

    ImFontAtlas atlas_;
    const ImFont* font_ = nullptr;
    unsigned char* coverage_ = nullptr;
    int width_ = 0;
    int height_ = 0;
};

/// Makes a small scene of round, flat and thin objects on a ground, for a user who gives no scene.
Scene still_life()
{
    Scene scene;
    const auto add = [&](Primitive primitive, const glm::vec3& color, const glm::dvec3& place) {
        primitive.material = static_cast<Index>(scene.materials.size());
        scene.materials.push_back({.base_color = glm::vec4(color, 1.0F), .metallic = 0.0F});
        scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
        scene.nodes.push_back(
            {.transform = {.translation = place}, .mesh = static_cast<Index>(scene.meshes.size())});
        scene.meshes.push_back({.primitives = {std::move(primitive)}});
    };
    add(shapes::fluted_column({.radius_bottom = 0.45F, .radius_top = 0.38F, .height = 3.2F}),
        {0.85F, 0.8F, 0.7F}, {-1.3, 0.0, -0.6});
    add(shapes::sphere(0.75F, 64, 32), {0.75F, 0.25F, 0.18F}, {0.6, 0.75, 0.6});
    add(shapes::box({1.2F, 1.2F, 1.2F}), {0.35F, 0.45F, 0.6F}, {1.1, 0.6, -1.2});
    add(shapes::torus(0.45F, 0.16F), {0.3F, 0.5F, 0.3F}, {-0.7, 0.16, 1.4});
    return scene;
}

} // namespace

Image lay_out_sheet(std::span<const SheetEntry> entries)
{
    if (entries.empty()) {
        return {};
    }
    constexpr double screen = 16.0 / 9.0;
    const uint32_t cell_width = entries[0].picture.width + gap_px;
    const uint32_t cell_height = entries[0].picture.height + gap_px + name_px;
    const auto count = static_cast<double>(entries.size());
    const auto columns = static_cast<uint32_t>(
        std::clamp(std::round(std::sqrt(count * screen * cell_height / cell_width)), 1.0, count));
    const auto rows = static_cast<uint32_t>((entries.size() + columns - 1) / columns);
    const uint64_t width = uint64_t{columns} * cell_width + gap_px;
    const uint64_t height = uint64_t{rows} * cell_height + gap_px;
    auto sheet = new_image<Image>(width, height, "the sheet");
    std::ranges::fill(sheet.rgba, uint8_t{255});
    const Letters letters;
    for (size_t i = 0; i < entries.size(); ++i) {
        const Image& picture = entries[i].picture;
        const uint32_t left_px = gap_px + static_cast<uint32_t>(i % columns) * cell_width;
        const uint32_t top_px = gap_px + static_cast<uint32_t>(i / columns) * cell_height;
        for (uint32_t y = 0; y < picture.height; ++y) {
            std::memcpy(&sheet.rgba[4 * (size_t{top_px + y} * sheet.width + left_px)],
                        &picture.rgba[size_t{4} * y * picture.width], size_t{4} * picture.width);
        }
        letters.draw(sheet, entries[i].name, left_px, top_px + picture.height + gap_px / 4);
    }
    return sheet;
}

Image draw_contact_sheet(const DrawOptions& draw)
{
    const Scene scene = draw.scene.empty() ? still_life() : load_scene_of(draw);
    print_warnings(scene.warnings);
    check_output(draw.output, input_files(draw, scene));
    const Index animation = choose_animation(draw, scene);
    const Camera camera = choose_camera(draw, scene, animation);
    warn_of_empty_view(draw, scene, animation, camera);
    Renderer renderer(draw.device);
    set_scene(renderer, scene, draw);
    DrawOptions in_preset = draw;
    WorldAnimator animator(in_preset, scene, worlds::Occasion::picture);
    std::vector<SheetEntry> entries;
    for (const std::string& name : Style::presets()) {
        in_preset.style = read_style(name, draw.assignments, draw.confine);
        const Style style = animator.show(renderer, draw.time_s, camera);
        entries.push_back({renderer.render(camera, style, settings_of(draw, animation)), name});
    }
    print_notes(renderer.notes());
    return lay_out_sheet(entries);
}

} // namespace estampe::app
