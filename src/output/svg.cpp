// SPDX-License-Identifier: MIT
#include <estampe/vector_drawing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "output/save_as.hpp"
#include "output/stroke_shape.hpp"
#include "output/svg.hpp"
#include "output/xml_text.hpp"

namespace estampe {
namespace {

using output::escaped;
using output::number;

constexpr size_t kind_count = 14;

std::string color_text(const glm::vec3& srgb)
{
    const auto byte = [](float value) { return std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(srgb.x), byte(srgb.y), byte(srgb.z));
}

/// Names that may stand as ids: letters and digits, none given twice.
class Ids {
public:
    std::string make(const std::string& name)
    {
        std::string id;
        for (const char c : name) {
            const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                                  (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
            id += is_plain ? c : '_';
        }
        std::string free = id;
        for (int i = 2; !taken_.insert(free).second; ++i) {
            free = fmt::format("{}-{}", id, i);
        }
        return free;
    }

private:
    std::set<std::string> taken_;
};

std::string head(const VectorDrawing& drawing, bool has_paper)
{
    const std::string width = number(drawing.width_mm);
    const std::string height = number(drawing.height_mm);
    std::string text =
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"\n"
                    "     xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
                    "     width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
                    width, height);
    if (has_paper) {
        text += fmt::format("<rect id=\"paper\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", width, height,
                            color_text(drawing.paper_srgb));
    }
    return text;
}

std::string layer_start(const std::string& id, const std::string& label, const std::string& more)
{
    return fmt::format("<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\"{}>\n", id,
                       escaped(label), more);
}

std::string lines_of(const VectorDrawing& drawing)
{
    return fmt::format(" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"{}\"",
                       drawing.has_mitred_corners ? "miter" : "round");
}

std::string path_of(const VectorDrawing& drawing, const VectorStroke& stroke, float tolerance_mm)
{
    const std::string ink = color_text(drawing.inks_srgb.at(stroke.ink));
    if (stroke.is_hidden || output::has_one_width(stroke, tolerance_mm)) {
        return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                           output::center_path(stroke, tolerance_mm), ink,
                           number(output::mean_width_mm(stroke)));
    }
    return fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", output::area_path(stroke, tolerance_mm), ink);
}

/// Layers by kind, those of hidden lines below; in each a group for every object.
std::string layers_by_kind(const VectorDrawing& drawing, float tolerance_mm)
{
    using Key = std::tuple<bool, StrokeKind, uint32_t>; // seen, kind, object
    std::map<Key, std::vector<const VectorStroke*>> groups;
    for (const VectorStroke& stroke : drawing.strokes) {
        groups[{!stroke.is_hidden, stroke.kind, stroke.object}].push_back(&stroke);
    }
    Ids ids;
    std::string text;
    bool is_open = false;
    const Key* before = nullptr;
    for (const auto& [key, strokes] : groups) {
        const auto& [is_seen, kind, object] = key;
        const std::string label = fmt::format("{}{}", is_seen ? "" : "hidden ", name_of(kind));
        if (before == nullptr || std::get<0>(*before) != is_seen || std::get<1>(*before) != kind) {
            text += is_open ? "</g>\n" : "";
            text += layer_start(ids.make(label), label,
                                lines_of(drawing) + (is_seen ? std::string()
                                                             : fmt::format(" stroke-dasharray=\"{},{}\"",
                                                                           number(drawing.dash_mm),
                                                                           number(drawing.dash_gap_mm))));
            is_open = true;
        }
        before = &key;
        const std::string& name = drawing.objects.at(object);
        text += fmt::format("<g id=\"{}\" inkscape:label=\"{}\">\n",
                            ids.make(fmt::format("{}-{}", label, name)), escaped(name));
        for (const VectorStroke* stroke : strokes) {
            text += path_of(drawing, *stroke, tolerance_mm);
        }
        text += "</g>\n";
    }
    return text + (is_open ? "</g>\n" : "");
}

/// A layer for each pen, its strokes in the order of the drawing. Numbers lead the labels, as programs that
/// drive plotters want them.
std::string layers_by_pen(const VectorDrawing& drawing, float tolerance_mm)
{
    std::vector<std::vector<const VectorStroke*>> pens(drawing.inks_srgb.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        pens.at(stroke.ink).push_back(&stroke);
    }
    std::string text;
    for (size_t i = 0; i < pens.size(); ++i) {
        if (pens[i].empty()) {
            continue;
        }
        const std::string ink = color_text(drawing.inks_srgb[i]);
        const std::string width = number(
            drawing.hatch_width_mm > 0.0F ? drawing.hatch_width_mm : output::mean_width_mm(*pens[i].front()));
        text +=
            layer_start(fmt::format("pen-{}", i + 1), fmt::format("{} pen {}", i + 1, ink),
                        fmt::format("{} stroke=\"{}\" stroke-width=\"{}\"", lines_of(drawing), ink, width));
        for (const VectorStroke* stroke : pens[i]) {
            text += fmt::format("<path d=\"{}\"/>\n", output::center_path(*stroke, tolerance_mm));
        }
        text += "</g>\n";
    }
    return text;
}

} // namespace

const char* name_of(StrokeKind kind)
{
    constexpr std::array<const char*, kind_count> names{
        "hatch",  "shadow",       "suggestive", "crest",  "valley",  "ridge", "crease",
        "marked", "intersection", "boundary",   "border", "outline", "focus", "frame"};
    return names.at(static_cast<size_t>(kind));
}

std::string output::encode_svg(const VectorDrawing& drawing, const SvgSettings& settings)
{
    if (!(drawing.width_mm > 0.0F && drawing.height_mm > 0.0F)) {
        throw Error("a drawing without a size cannot be written");
    }
    return head(drawing, drawing.has_paper && !settings.is_for_plotter) +
           (settings.is_for_plotter ? layers_by_pen(drawing, settings.tolerance_mm)
                                    : layers_by_kind(drawing, settings.tolerance_mm)) +
           "</svg>\n";
}

void save_svg(const VectorDrawing& drawing, const std::filesystem::path& path, const SvgSettings& settings)
{
    output::save_as(path, [&] {
        const std::string text = output::encode_svg(drawing, settings);
        const auto bytes = std::as_bytes(std::span(text));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    });
}

} // namespace estampe
