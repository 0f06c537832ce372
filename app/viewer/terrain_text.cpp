// SPDX-License-Identifier: MIT
#include "viewer/terrain_text.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include <estampe/error.hpp>

#include "style/raw.hpp"

namespace estampe::viewer {
namespace {

struct Place {
    size_t line = 0;   ///< from 0
    size_t column = 0; ///< from 0
};

/// The end of "file:line:column".
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

/// Where the value that begins at `from` ends in its line.
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

/// "section.key" and what its line says, in the order of the text.
using Values = std::vector<std::pair<std::string, std::string>>;

/// Every value of a terrain, the ones that are as usual too.
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

/// The lines of a file, to be changed one by one.
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

    /// Another key for the same value, in the same section.
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
    std::map<std::string, Place> places_; ///< of values
    std::map<std::string, size_t> ends_;  ///< the last line of each section
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

/// Nothing where the text is no terrain's, or comes out otherwise than wanted, as with values over several
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

} // namespace estampe::viewer
