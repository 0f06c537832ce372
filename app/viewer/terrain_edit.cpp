// SPDX-License-Identifier: MIT
#include "viewer/terrain_edit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "style/toml.hpp"
#include "techniques/terrain/graph/language.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe::viewer {
namespace {

struct Place {
    size_t line = 0;   ///< Number of the line, from 0
    size_t column = 0; ///< Number of the column, from 0
};

/// Returns the line and column that stand at the end of a text "file:line:column".
Place place_of(const std::string& where)
{
    const size_t last = where.rfind(':');
    const size_t before = where.rfind(':', last - 1);
    Place place;
    std::from_chars(where.data() + before + 1, where.data() + last, place.line);
    std::from_chars(where.data() + last + 1, where.data() + where.size(), place.column);
    return {place.line - 1, place.column - 1};
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// Returns the column at which the value that begins at `from` ends.
size_t end_of_value(const std::string& line, size_t from)
{
    const char first = line.at(from);
    if (first == '"' || first == '\'') {
        size_t at = from + 1;
        while (at < line.size() && line[at] != first) {
            at += first == '"' && line[at] == '\\' ? 2 : 1;
        }
        return std::min(at + 1, line.size());
    }
    const size_t comment = std::min(line.find('#', first == '[' ? line.find(']', from) : from), line.size());
    return line.find_last_not_of(" \t\r", comment - 1) + 1;
}

/// The values of a terrain file: pairs of "section.key" and the text of the value, in the order of the file.
using Values = std::vector<std::pair<std::string, std::string>>;

/// Returns every value of a terrain, including default values.
Values values_of(const TerrainDescription& terrain)
{
    const std::string text = terrain_toml(terrain);
    const std::vector<std::string> lines = lines_of(text);
    Values values;
    for (const style::Entry& entry : style::parse_toml(text, "terrain").entries) {
        const Place place = place_of(entry.value_where);
        values.emplace_back(entry.section + "." + entry.key, lines.at(place.line).substr(place.column));
    }
    return values;
}

/// The lines of a terrain file, which can be changed one by one.
class Lines {
public:
    explicit Lines(const std::string& text) : lines_(lines_of(text))
    {
        const style::Document document = style::parse_toml(text, "terrain");
        for (const style::Document::Header& section : document.sections) {
            ends_[section.name] = place_of(section.where).line;
        }
        for (const style::Entry& entry : document.entries) {
            const Place place = place_of(entry.value_where);
            places_[entry.section + "." + entry.key] = place;
            ends_[entry.section] = std::max(ends_[entry.section], place.line);
        }
    }

    void set(const std::string& name, const std::string& value)
    {
        if (const auto found = places_.find(name); found != places_.end()) {
            std::string& line = lines_.at(found->second.line);
            const size_t from = found->second.column;
            line.replace(from, end_of_value(line, from) - from, value);
            return;
        }
        const size_t dot = name.find('.');
        const std::string section = name.substr(0, dot);
        const std::string line = name.substr(dot + 1) + " = " + value;
        if (const auto end = ends_.find(section); end != ends_.end()) {
            added_[end->second].push_back(line);
        } else {
            sections_[section].push_back(line);
        }
    }

    /// Changes the key of a value within its section of the file.
    void rename(const std::string& name, const std::string& key)
    {
        std::string& line = lines_.at(places_.at(name).line);
        const size_t from = line.find_first_not_of(" \t");
        line.replace(from, line.find('=') - from, key + " ");
    }

    void remove(const std::string& name) { removed_.push_back(places_.at(name).line); }

    [[nodiscard]] std::string text() const
    {
        std::string text;
        for (size_t i = 0; i < lines_.size(); ++i) {
            if (std::ranges::find(removed_, i) == removed_.end()) {
                text += lines_[i] + "\n";
            }
            if (const auto added = added_.find(i); added != added_.end()) {
                for (const std::string& line : added->second) {
                    text += line + "\n";
                }
            }
        }
        for (const auto& [section, lines] : sections_) {
            text += "\n[" + section + "]\n";
            for (const std::string& line : lines) {
                text += line + "\n";
            }
        }
        return text;
    }

private:
    std::vector<std::string> lines_;
    std::map<std::string, Place> places_; ///< Positions of the values in the file
    std::map<std::string, size_t> ends_;  ///< Number of the last line of each section
    std::map<size_t, std::vector<std::string>> added_;
    std::map<std::string, std::vector<std::string>> sections_;
    std::vector<size_t> removed_;
};

std::optional<std::string> value_of(const Values& values, const std::string& name)
{
    const auto found = std::ranges::find(values, name, &Values::value_type::first);
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

Values sorted(Values values)
{
    std::ranges::sort(values);
    return values;
}

/// Returns the text `before` of a terrain file with changed values. Returns nothing if `before` is not a
/// terrain's text, or if the changed text does not describe `wanted`; for example when values span several
/// lines.
std::optional<std::string> changed_text(const std::string& before, const Values& wanted)
{
    try {
        const Values held = values_of(parse_terrain(before, "terrain"));
        Lines lines(before);
        Values gone;
        std::ranges::copy_if(held, std::back_inserter(gone),
                             [&](const auto& entry) { return !value_of(wanted, entry.first); });
        for (const auto& [name, value] : wanted) {
            const auto known_as = std::ranges::find(gone, value, &Values::value_type::second);
            if (!value_of(held, name) && known_as != gone.end()) {
                lines.rename(known_as->first, name.substr(name.find('.') + 1));
                gone.erase(known_as);
            } else if (value_of(held, name) != value) {
                lines.set(name, value);
            }
        }
        for (const auto& [name, value] : gone) {
            lines.remove(name);
        }
        std::string text = lines.text();
        const bool is_as_wanted = sorted(values_of(parse_terrain(text, "terrain"))) == sorted(wanted);
        return is_as_wanted ? std::optional(std::move(text)) : std::nullopt;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

} // namespace

bool is_terrain(const std::filesystem::path& path)
{
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const size_t first = line.find_first_not_of(" \t");
        if (first != std::string::npos &&
            (line.compare(first, 9, "[terrain]") == 0 || line.compare(first, 8, "terrain.") == 0)) {
            return true;
        }
    }
    return false;
}

TerrainText text_with(const std::string& before, const TerrainDescription& terrain)
{
    const Values wanted = values_of(terrain);
    if (std::optional<std::string> text = changed_text(before, wanted)) {
        return {.text = std::move(*text)};
    }
    return {.text = terrain_toml(terrain), .keeps_comments = before.find('#') == std::string::npos};
}

namespace {

std::string file_text(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes, scope);
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

/// Replaces a node's name in an expression where the name is a whole word outside of quotes.
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

/// Returns whether a node of the terrain can take this name.
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
        file_text_ = file_text(draft_.name, draft_.scope);
    } catch (const Error&) {
        // The file's text is unknown, so a new text is generated when the terrain is saved.
        file_text_.clear();
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
        // The node's number, by which an error message refers to the node.
        tried.nodes[i].where = std::to_string(i);
    }
    try {
        terrain_ = Terrain(std::move(tried));
        problem_.reset();
        ++revision_;
    } catch (const Error& error) {
        Problem problem{.text = error.what()};
        const std::string& where = error.where();
        if (const auto node = number_from<size_t>(where); node && *node < draft_.nodes.size()) {
            problem.node = *node;
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

ReadScope TerrainEdit::scope_of(const std::filesystem::path& path) const
{
    return draft_.scope.is_limited() ? ReadScope::beside(path) : ReadScope();
}

void TerrainEdit::load(const std::filesystem::path& path)
{
    const ReadScope scope = scope_of(path);
    const TerrainDescription loaded = load_terrain(path, scope);
    const Terrain terrain(loaded);
    file_text_ = file_text(path, scope);
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
    return terrain_toml(load_terrain(draft_.name, draft_.scope)) != saved_;
}

bool TerrainEdit::save(const std::filesystem::path& path)
{
    if (problem_) {
        throw Error(problem_->text, path.string(), "the file is as it was");
    }
    const TerrainText written = text_with(file_text_, draft_);
    try {
        TerrainDescription moved = parse_terrain(written.text, path.string(), path.parent_path());
        moved.scope = scope_of(path);
        const Terrain found(moved);
    } catch (const Error& error) {
        throw Error(fmt::format("could not be read again from there: {}", error.what()), path.string(),
                    "save it beside its textures");
    }
    write_file_atomically(path, std::as_bytes(std::span(written.text)));
    file_text_ = written.text;
    saved_ = terrain_toml(draft_);
    draft_.name = path.string();
    draft_.folder = path.parent_path();
    draft_.scope = scope_of(path);
    history_.push(draft_);
    take_draft();
    return written.keeps_comments;
}

std::vector<std::filesystem::path> TerrainEdit::files() const
{
    std::vector<std::filesystem::path> files{draft_.name};
    const std::vector<std::filesystem::path> pictures = terrain_.files();
    files.insert(files.end(), pictures.begin(), pictures.end());
    return files;
}

} // namespace estampe::viewer
