// SPDX-License-Identifier: MIT
#include "output/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/vector_drawing.hpp>

#include "output/pictures.hpp"
#include "output/stroke_path.hpp"

namespace estampe::output {
namespace {

/// Length of the UTF-8 character at index `i` of the text; 0 if it is not valid.
size_t sequence_length(const std::string& text, size_t i)
{
    const auto first = static_cast<unsigned char>(text[i]);
    const size_t length = first < 0x80                    ? 1
                          : first >= 0xc2 && first < 0xe0 ? 2
                          : first >= 0xe0 && first < 0xf0 ? 3
                          : first >= 0xf0 && first < 0xf5 ? 4
                                                          : 0;
    for (size_t k = 1; k < length; ++k) {
        if (i + k >= text.size() || (static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80) {
            return 0;
        }
    }
    return length;
}

} // namespace

std::string escaped(const std::string& text)
{
    static const std::map<char, std::string> own{
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    std::string result;
    result.reserve(text.size());
    for (size_t i = 0; i < text.size();) {
        const size_t length = sequence_length(text, i);
        const auto written = own.find(text[i]);
        if (length == 0) {
            result += '?';
        } else if (written != own.end()) {
            result += written->second;
        } else if (static_cast<unsigned char>(text[i]) < 0x20) {
            result += ' ';
        } else {
            result += text.substr(i, length);
        }
        i += std::max<size_t>(length, 1);
    }
    return result;
}

} // namespace estampe::output

namespace estampe {
namespace {

using output::escaped;
using output::number;

constexpr size_t kind_count = 15;

std::string color_text(const glm::vec3& srgb)
{
    const auto byte = [](float value) { return std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(srgb.x), byte(srgb.y), byte(srgb.z));
}

/// Makes unique names that are valid as XML ids: letters and digits.
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

/// Writes one SVG layer per kind of stroke, with layers of hidden lines below those of visible lines. Each
/// layer has one group per object.
std::string layers_by_kind(const VectorDrawing& drawing, float tolerance_mm)
{
    // A group of strokes: visible or hidden, kind of stroke, object.
    using Key = std::tuple<bool, StrokeKind, uint32_t>;
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

/// Writes one SVG layer per pen, with its strokes in the order of the drawing. Labels start with a number, as
/// plotter programs require.
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
        "hatch",  "shadow",       "suggestive", "leaf",   "crest",   "valley", "ridge", "crease",
        "marked", "intersection", "boundary",   "border", "outline", "focus",  "frame"};
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
