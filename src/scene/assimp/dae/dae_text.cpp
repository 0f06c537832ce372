// SPDX-License-Identifier: MIT
#include "scene/assimp/dae/dae_text.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "scene/assimp/dae/cameras.hpp"
#include "scene/assimp/dae/origin.hpp"

namespace estampe::dae {
namespace {

bool is_blank(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

/// Programs of Windows write "-1.#IND" and the like for what is not a number.
bool is_windows_nan(std::string_view word)
{
    return word.find(".#") != std::string_view::npos;
}

/// One blank between words and none around: Assimp takes a blank for a number in some places.
std::string tidied(std::string_view text)
{
    std::string result;
    result.reserve(text.size());
    size_t at = 0;
    while (at < text.size()) {
        if (is_blank(text[at])) {
            ++at;
            continue;
        }
        const size_t first = at;
        while (at < text.size() && !is_blank(text[at]))
            ++at;
        const std::string_view word = text.substr(first, at - first);
        if (!result.empty())
            result += ' ';
        result += is_windows_nan(word) ? "0" : word;
    }
    return result;
}

/// Names of files keep their blanks within.
bool holds_a_path(const pugi::xml_node& text)
{
    const std::string_view parent = text.parent().name();
    return parent == "init_from" || parent == "ref";
}

std::string trimmed(std::string_view text)
{
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return std::string(text);
}

struct TidyTexts : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override
    {
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
            node.set_value((holds_a_path(node) ? trimmed(node.value()) : tidied(node.value())).c_str());
        return true;
    }
};

struct StringWriter : pugi::xml_writer {
    std::string text;

    void write(const void* data, size_t size) override { text.append(static_cast<const char*>(data), size); }
};

std::optional<double> number_below(const pugi::xml_node& root, const char* name)
{
    const pugi::xml_node found =
        root.find_node([name](const pugi::xml_node& node) { return std::string_view(node.name()) == name; });
    const double number = found.text().as_double(-1.0);
    return number >= 0.0 && number <= 1e6 ? std::optional(number) : std::nullopt;
}

} // namespace

Document read_document(const std::filesystem::path& path)
{
    std::vector<std::byte> bytes = read_file(path);
    pugi::xml_document xml;
    const pugi::xml_parse_result result = xml.load_buffer_inplace(bytes.data(), bytes.size());
    if (!result)
        throw Error(fmt::format("is not sound XML at byte {}: {}", result.offset, result.description()));
    const pugi::xml_node root = xml.child("COLLADA");
    if (!root)
        throw Error("is XML, but not COLLADA");
    TidyTexts tidy;
    xml.traverse(tidy);
    Document document;
    document.moved_vertices = move_to_origin(root);
    document.lenses = number_cameras(root);
    const pugi::xml_node scenes = root.child("library_visual_scenes");
    document.frames_per_s = number_below(scenes, "frame_rate");
    if (document.frames_per_s && !(*document.frames_per_s > 0.0 && *document.frames_per_s <= 1000.0))
        document.frames_per_s.reset();
    const double metres = root.child("asset").child("unit").attribute("meter").as_double(0.0);
    if (metres > 0.0 && std::isfinite(metres))
        document.unit_m = metres;
    document.start_s = number_below(scenes, "start_time").value_or(0.0);
    StringWriter writer;
    xml.save(writer, "", pugi::format_raw, pugi::encoding_utf8);
    document.text = std::move(writer.text);
    return document;
}

} // namespace estampe::dae
