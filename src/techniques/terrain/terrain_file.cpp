// SPDX-License-Identifier: MIT
#include <algorithm>

#include <estampe/error.hpp>
#include <estampe/terrain.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/file.hpp"
#include "style/raw.hpp"
#include "style/suggest.hpp"
#include "techniques/terrain/terrain_tables.hpp"

namespace estampe {
namespace {

using style::Entry;
using style::in_quotes;

const std::vector<std::string> sections{"terrain", "nodes", "wind", "mesh", "ripples", "trails", "tracks"};

[[noreturn]] void fail_unknown(const std::string& word, const std::string& where,
                               const std::vector<std::string>& known)
{
    const std::string meant = style::nearest(word, known);
    throw Error(fmt::format("unknown key or section {}", in_quotes(word)), where,
                meant.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                              : fmt::format("did you mean {}?", in_quotes(meant)));
}

HeightNode node_of(const Entry& entry)
{
    HeightNode node{.name = entry.key, .where = entry.value_where};
    if (const auto* text = std::get_if<std::string>(&entry.raw.value)) {
        node.expression = *text;
    } else if (std::holds_alternative<int64_t>(entry.raw.value) ||
               std::holds_alternative<double>(entry.raw.value)) {
        node.expression = entry.raw.shown;
    } else {
        throw Error(fmt::format("{} is no height, but {}", in_quotes(entry.key), entry.raw.shown),
                    entry.value_where, "write it in quotes: height = \"6 * fbm(400)\"");
    }
    return node;
}

TerrainTrack track_of(const Entry& entry)
{
    const auto* const text = std::get_if<std::string>(&entry.raw.value);
    return parse_track(text != nullptr ? *text : entry.raw.shown, entry.key, entry.value_where);
}

/// Sets what `entry` names in `target`, a struct of `table`.
template <typename Struct>
void set_by(const style::Table<Struct>& table, const Entry& entry, Struct& target)
{
    std::vector<std::string> known;
    if (table.section() == "terrain") {
        known.emplace_back("height");
    }
    for (const style::Parameter& parameter : table.parameters()) {
        if (parameter.key == entry.key) {
            parameter.set(&target, style::check(parameter, entry.section + "." + entry.key, entry.raw,
                                                entry.value_where));
            return;
        }
        known.push_back(parameter.key);
    }
    fail_unknown(entry.key, entry.key_where, known);
}

template <typename Struct>
std::string toml_of(const style::Table<Struct>& table, const Struct& values)
{
    std::string text = fmt::format("\n[{}]\n", table.section());
    for (const style::Parameter& parameter : table.parameters()) {
        text += fmt::format("{} = {}\n", parameter.key, style::format_value(parameter.get(&values)));
    }
    return text;
}

std::string node_line(const HeightNode& node)
{
    std::string escaped;
    for (const char c : node.expression) {
        if (c == '"' || c == '\\') {
            escaped += '\\';
        }
        escaped += c == '\n' ? ' ' : c;
    }
    return fmt::format("{} = \"{}\"\n", node.name, escaped);
}

} // namespace

TerrainDescription parse_terrain(std::string_view text, const std::string& name,
                                 const std::filesystem::path& folder)
{
    TerrainDescription result;
    result.name = name;
    result.folder = folder;
    const style::Document document = style::parse_toml(text, name);
    for (const style::Document::Header& section : document.sections) {
        if (std::ranges::find(sections, section.name) == sections.end()) {
            fail_unknown(section.name, section.where, sections);
        }
    }
    for (const Entry& entry : document.entries) {
        if (entry.section == "nodes" || (entry.section == "terrain" && entry.key == "height")) {
            result.nodes.push_back(node_of(entry));
        } else if (entry.section == "terrain") {
            set_by(terrain::look_table(), entry, result.look);
        } else if (entry.section == "wind") {
            set_by(terrain::wind_table(), entry, result.wind);
        } else if (entry.section == "mesh") {
            set_by(terrain::mesh_table(), entry, result.meshing);
        } else if (entry.section == "ripples") {
            set_by(terrain::ripples_table(), entry, result.ripples);
        } else if (entry.section == "trails") {
            set_by(terrain::trails_table(), entry, result.trails);
        } else if (entry.section == "tracks") {
            result.tracks.push_back(track_of(entry));
        } else {
            fail_unknown(entry.key, entry.key_where, sections);
        }
    }
    return result;
}

TerrainDescription load_terrain(const std::filesystem::path& path)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parse_terrain(text, path.string(), path.parent_path());
}

std::string terrain_toml(const TerrainDescription& terrain)
{
    std::string text = "[terrain]\n";
    std::string nodes = "\n[nodes]\n";
    for (const HeightNode& node : terrain.nodes) {
        (node.name == "height" ? text : nodes) += node_line(node);
    }
    std::string look = toml_of(terrain::look_table(), terrain.look);
    text += look.substr(look.find("]\n") + 2);
    std::string tracks = "\n[tracks]\n";
    for (const TerrainTrack& track : terrain.tracks) {
        tracks += fmt::format("{} = \"{}\"\n", track.name, track_text(track));
    }
    return text + nodes + toml_of(terrain::wind_table(), terrain.wind) +
           toml_of(terrain::mesh_table(), terrain.meshing) +
           toml_of(terrain::ripples_table(), terrain.ripples) +
           toml_of(terrain::trails_table(), terrain.trails) + tracks;
}

} // namespace estampe
