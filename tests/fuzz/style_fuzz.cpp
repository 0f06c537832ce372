// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the text, a style is read or refused with an Error; one that is read can be
// written and read back.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <estampe/error.hpp>
#include <estampe/style.hpp>

#include "features/common/style_tables.hpp"

namespace {

/// Presets may be named, files may not: they are not the input's.
estampe::style::Source resolve_presets(const std::string& name, const std::string& from)
{
    if (name.find('/') != std::string::npos || name.find('.') != std::string::npos) {
        throw estampe::Error("is a file", name);
    }
    return estampe::style::resolve(name, from);
}

/// Calls `visit(section, line)` for each line of a style's text. `section` is the line [NAME] above.
template <typename Visit>
void for_lines(std::string_view text, const Visit& visit)
{
    std::string_view section;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        section = line.starts_with('[') ? line : section;
        visit(section, line);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
}

/// The lines of a style's text that differ from those of the default style, below the headers of their
/// sections.
std::string changed_lines(const std::string& text)
{
    using Line = std::pair<std::string_view, std::string_view>;
    static const std::string defaults =
        estampe::features::style_schema().to_toml(estampe::features::StyleTables());
    static const std::set<Line> known = [] {
        std::set<Line> lines;
        for_lines(defaults, [&](auto section, auto line) { lines.emplace(section, line); });
        return lines;
    }();
    std::string changed;
    std::string_view last;
    for_lines(text, [&](auto section, auto line) {
        if (known.contains({section, line})) {
            return;
        }
        if (section != last && section != line) {
            changed.append(section).append("\n");
            last = section;
        }
        changed.append(line).append("\n");
    });
    return changed;
}

/// What is left after a text or an assignment must be a style that reads back. Only what differs from the
/// default style is read, because reading a whole style takes ten times as long as reading an input.
void expect_whole(const estampe::features::StyleTables& tables)
{
    const auto& schema = estampe::features::style_schema();
    const std::string text = schema.to_toml(tables);
    estampe::features::StyleTables again;
    schema.read_text(again, changed_lines(text), "again", resolve_presets);
    if (schema.to_toml(again) != text) {
        std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto& schema = estampe::features::style_schema();
    estampe::features::StyleTables tables;
    try {
        if (text.starts_with('!')) { // lines for --set
            for (size_t at = 1; at < text.size();) {
                const size_t end = std::min(text.size(), text.find('\n', at));
                schema.set(tables, text.substr(at, end - at));
                at = end + 1;
            }
        } else {
            schema.read_text(tables, text, "fuzz.toml", resolve_presets);
        }
    } catch (const estampe::Error&) {
    }
    expect_whole(tables);
    return 0;
}
