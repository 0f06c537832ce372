// SPDX-License-Identifier: MIT
#include "techniques/terrain/terrain_file.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>
#include <estampe/terrain.hpp>

#include "core/file.hpp"
#include "style/names.hpp"
#include "style/parameter.hpp"
#include "style/toml.hpp"
#include "techniques/terrain/graph/language.hpp"

namespace estampe::terrain {

const style::Table<TerrainLook>& look_table()
{
    static const auto table = style::Table<TerrainLook>("terrain", "Look of the ground")
                                  .color("color", &TerrainLook::color, "Colour of the sand on the ground");
    return table;
}

const style::Table<TerrainWind>& wind_table()
{
    static const auto table =
        style::Table<TerrainWind>("wind", "Wind over the ground, along which dunes and ripples move")
            .number(
                "towards_deg", &TerrainWind::towards_deg, {-360.0F, 360.0F}, "deg",
                "Direction towards which the wind over the ground blows, seen from above: 0 is +z, 90 is +x")
            .number("speed_m_per_s", &TerrainWind::speed_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed of the wind over the ground: from 6 m/s on, sand drifts off the crests of dunes. "
                    "In formulas of heights, the name of this value is `wind`.");
    return table;
}

const style::Table<TerrainMeshing>& mesh_table()
{
    static const auto table =
        style::Table<TerrainMeshing>("mesh",
                                     "Triangles of the ground: how fine, how wide and how they are built")
            .choice(
                "method", &TerrainMeshing::method,
                {{"rings", TerrainMesh::rings}, {"grid", TerrainMesh::grid}, {"object", TerrainMesh::object}},
                "How the ground is divided into triangles. rings: grids around the camera, one in the other, "
                "each twice as coarse; grid: one even grid in front of the camera; object: an object of the "
                "scene, raised by the heights.")
            .text("object", &TerrainMeshing::object,
                  "Name of the object of the scene whose surface the heights raise. Only used when "
                  "mesh.method is object.")
            .choice(
                "update", &TerrainMeshing::update,
                {{"moved", TerrainUpdate::moved},
                 {"always", TerrainUpdate::always},
                 {"still", TerrainUpdate::still}},
                "When the heights of the ground are computed again. moved: if the camera or the time has "
                "changed; always: in every picture; still: if the camera has moved, as if time stood still.")
            .number("cell_m", &TerrainMeshing::cell_m, {0.01F, 64.0F}, "m",
                    "Distance between points of the ground near the camera, rounded to a power of two. Less "
                    "gives a finer ground and is slower.")
            .integer("cells", &TerrainMeshing::cells, {16, 2048}, "",
                     "Number of cells (squares) along a side of each grid of the ground, rounded up to a "
                     "multiple of 4. More is finer and slower.")
            .number("reach_m", &TerrainMeshing::reach_m, {10.0F, 100000.0F}, "m",
                    "Smallest distance from the camera to which the ground extends: more shows more ground. "
                    "Only used when mesh.method is rings.")
            .number("planet_radius_m", &TerrainMeshing::planet_radius_m, {0.0F, 1e7F}, "m",
                    "Radius of the planet along which the ground curves: less brings the horizon nearer. 0 "
                    "is flat ground.");
    return table;
}

const style::Table<TerrainRipples>& ripples_table()
{
    static const auto table =
        style::Table<TerrainRipples>("ripples", "Ripples that the wind forms on sand, visible from near")
            .number("wavelength_m", &TerrainRipples::wavelength_m, {0.005F, 100.0F}, "m",
                    "Distance between the crests of two sand ripples: less gives finer ripples")
            .number(
                "height_m", &TerrainRipples::height_m, {0.0F, 10.0F}, "m",
                "Height of a sand ripple from trough to crest: more is easier to see. 0 draws no ripples.")
            .number("meander", &TerrainRipples::meander, {0.0F, 1.0F}, "",
                    "How much sand ripples bend to the sides. 0 is straight and unbroken, 1 bends, forks and "
                    "ends everywhere.")
            .number("drift_m_per_s", &TerrainRipples::drift_m_per_s, {-1.0F, 1.0F}, "m/s",
                    "Speed at which sand ripples move with the wind: 0 stands still, below 0 moves against "
                    "the wind");
    return table;
}

const style::Table<TerrainTrails>& trails_table()
{
    static const auto table =
        style::Table<TerrainTrails>("trails",
                                    "Trails in sand: footprints, and marks of things that are dragged")
            .number("half_life_s", &TerrainTrails::half_life_s, {0.1F, 1e6F}, "s",
                    "Time in which the wind fills a trail in sand to half of its depth: more keeps "
                    "footprints longer")
            .number("repose_deg", &TerrainTrails::repose_deg, {5.0F, 80.0F}, "deg",
                    "Steepest angle at which the rim of a trail in sand stands before the rim slides down. "
                    "Less looks like dry sand, more like damp sand.")
            .number("extent_m", &TerrainTrails::extent_m, {4.0F, 400.0F}, "m",
                    "Size of the square in front of the camera in which trails in sand are visible. Less "
                    "shows finer prints, because the square always has 1,024 pixels per side.");
    return table;
}

} // namespace estampe::terrain

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

/// Sets the parameter that `entry` names in `target`, a struct whose parameters are listed in `table`.
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
    if (table.section() == "wind" && entry.key == "direction_deg") {
        throw Error("this key of older files counted from +x", entry.key_where,
                    "write towards_deg = 90 - direction_deg, which counts from +z like all bearings");
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

/// Writes an assignment of TOML, with the key in quotes if it needs them.
std::string assignment(const std::string& key, const std::string& text)
{
    return fmt::format("{} = {}\n", terrain::is_name(key) ? key : style::format_value(key),
                       style::format_value(text));
}

std::string node_line(const HeightNode& node)
{
    std::string in_one_line = node.expression;
    std::ranges::replace(in_one_line, '\n', ' ');
    return assignment(node.name, in_one_line);
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

TerrainDescription load_terrain(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes, scope);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    TerrainDescription terrain = parse_terrain(text, path.string(), path.parent_path());
    terrain.scope = scope;
    return terrain;
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
        tracks += assignment(track.name, track_text(track));
    }
    return text + nodes + toml_of(terrain::wind_table(), terrain.wind) +
           toml_of(terrain::mesh_table(), terrain.meshing) +
           toml_of(terrain::ripples_table(), terrain.ripples) +
           toml_of(terrain::trails_table(), terrain.trails) + tracks;
}

} // namespace estampe
