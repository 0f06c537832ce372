// SPDX-License-Identifier: MIT
#include "viewer/terrain_edit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "techniques/terrain/graph/expression.hpp"
#include "techniques/terrain/graph/node_kinds.hpp"
#include "techniques/terrain/graph/program.hpp"
#include "viewer/terrain_text.hpp"

namespace estampe::viewer {
namespace {

std::string file_text(const std::filesystem::path& path)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::string> names_of(const TerrainDescription& terrain)
{
    std::vector<std::string> names;
    for (const HeightNode& node : terrain.nodes) {
        names.push_back(node.name);
    }
    return names;
}

/// The name in an expression's place where it stands as a word, but for texts in quotes.
std::string with_name(const std::string& expression, const std::string& before, const std::string& after)
{
    std::string result;
    for (size_t at = 0; at < expression.size();) {
        const char c = expression[at];
        size_t end = at + 1;
        if (c == '"' || c == '\'') {
            end = std::min(expression.find(c, at + 1), expression.size() - 1) + 1;
        } else {
            while (end <= expression.size() && terrain::is_name(expression.substr(at, end - at))) {
                ++end;
            }
            end = std::max(end - 1, at + 1);
        }
        const std::string word = expression.substr(at, end - at);
        result += word == before ? after : word;
        at = end;
    }
    return result;
}

/// Whether others can call a node so.
bool is_free_name(const TerrainDescription& terrain, const std::string& name)
{
    static constexpr std::array words{"x", "z", "time", "wind", "pi"};
    return terrain::is_name(name) && terrain::find_node_kind(name) == nullptr &&
           std::ranges::find(words, name) == words.end() &&
           std::ranges::count(terrain.nodes, name, &HeightNode::name) == 0;
}

} // namespace

TerrainEdit::TerrainEdit(const Terrain& terrain)
    : draft_(terrain.description()), known_as_(names_of(draft_)), terrain_(terrain), history_(draft_),
      saved_(terrain_toml(draft_))
{
    try {
        file_text_ = file_text(draft_.name);
    } catch (const Error&) {
        file_text_.clear(); // written anew when it is saved
    }
}

bool TerrainEdit::is_changed() const
{
    return terrain_toml(draft_) != saved_;
}

void TerrainEdit::take_draft()
{
    holds_settings_ = false;
    TerrainDescription tried = draft_;
    for (size_t i = 0; i < tried.nodes.size(); ++i) {
        tried.nodes[i].where = std::to_string(i); // for what is wrong with it
    }
    try {
        terrain_ = Terrain(std::move(tried));
        problem_.reset();
        ++revision_;
    } catch (const Error& error) {
        Problem problem{.text = error.what()};
        const std::string& where = error.where();
        size_t node = 0;
        const auto [end, trouble] = std::from_chars(where.data(), where.data() + where.size(), node);
        if (trouble == std::errc() && end == where.data() + where.size() && node < draft_.nodes.size()) {
            problem.node = node;
            problem.text.erase(0, where.size() + 2);
        }
        problem_ = std::move(problem);
    }
}

void TerrainEdit::set_expression(size_t node, const std::string& expression)
{
    draft_.nodes.at(node).expression = expression;
    take_draft();
}

void TerrainEdit::rename(size_t node, const std::string& name)
{
    if (draft_.nodes.at(node).name == "height" || name == "height") {
        return;
    }
    if (is_free_name(draft_, name)) {
        for (HeightNode& other : draft_.nodes) {
            other.expression = with_name(other.expression, known_as_[node], name);
        }
        known_as_[node] = name;
    }
    draft_.nodes[node].name = name;
    take_draft();
}

void TerrainEdit::add_node()
{
    std::string name;
    for (int number = 1; name.empty() || !is_free_name(draft_, name); ++number) {
        name = fmt::format("part{}", number);
    }
    draft_.nodes.push_back({.name = name, .expression = "0", .where = {}});
    known_as_.push_back(name);
    take_draft();
    finish_change();
}

void TerrainEdit::remove_node(size_t node)
{
    draft_.nodes.erase(draft_.nodes.begin() + static_cast<std::ptrdiff_t>(node));
    known_as_.erase(known_as_.begin() + static_cast<std::ptrdiff_t>(node));
    take_draft();
    finish_change();
}

void TerrainEdit::set_settings(const TerrainDescription& settings)
{
    hold_settings(settings);
    take_draft();
}

void TerrainEdit::hold_settings(const TerrainDescription& settings)
{
    holds_settings_ = true;
    draft_.wind = settings.wind;
    draft_.meshing = settings.meshing;
    draft_.look = settings.look;
    draft_.ripples = settings.ripples;
    draft_.trails = settings.trails;
}

void TerrainEdit::finish_change()
{
    if (holds_settings_) {
        take_draft();
    }
    if (terrain_toml(terrain_.description()) != terrain_toml(history_.now())) {
        history_.push(terrain_.description());
    }
}

bool TerrainEdit::can_undo() const
{
    return history_.can_undo() || terrain_toml(draft_) != terrain_toml(history_.now());
}

void TerrainEdit::take_step(const TerrainDescription& step)
{
    draft_ = step;
    known_as_ = names_of(draft_);
    take_draft();
}

void TerrainEdit::undo()
{
    if (terrain_toml(draft_) != terrain_toml(history_.now())) {
        take_step(history_.now());
    } else if (history_.can_undo()) {
        take_step(history_.undo());
    }
}

void TerrainEdit::redo()
{
    if (history_.can_redo()) {
        take_step(history_.redo());
    }
}

void TerrainEdit::load(const std::filesystem::path& path)
{
    const TerrainDescription loaded = load_terrain(path);
    const Terrain terrain(loaded);
    file_text_ = file_text(path);
    saved_ = terrain_toml(loaded);
    history_.push(loaded);
    take_step(loaded);
}

void TerrainEdit::read_textures()
{
    take_draft();
}

bool TerrainEdit::differs_from_file() const
{
    return terrain_toml(load_terrain(draft_.name)) != saved_;
}

bool TerrainEdit::save(const std::filesystem::path& path)
{
    if (problem_) {
        throw Error(problem_->text, path.string(), "the file is as it was");
    }
    const TerrainText written = text_with(file_text_, draft_);
    try {
        const Terrain found(parse_terrain(written.text, path.string(), path.parent_path()));
    } catch (const Error& error) {
        throw Error(fmt::format("could not be read again from there: {}", error.what()), path.string(),
                    "save it beside its textures");
    }
    write_file_atomically(path, std::as_bytes(std::span(written.text)));
    file_text_ = written.text;
    saved_ = terrain_toml(draft_);
    draft_.name = path.string();
    draft_.folder = path.parent_path();
    history_.push(draft_);
    take_draft();
    return written.keeps_comments;
}

std::vector<std::filesystem::path> TerrainEdit::files() const
{
    std::vector<std::filesystem::path> files{draft_.name};
    for (const terrain::HeightTexture& texture : terrain_.program().textures) {
        if (!texture.is_mask && !texture.sand) {
            files.push_back(terrain_.description().folder / texture.name);
        }
    }
    return files;
}

} // namespace estampe::viewer
