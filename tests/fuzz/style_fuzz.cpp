// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the text, a style is read or refused with an Error; one that is read can be
// written and read back.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

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

/// What is left after a text or an assignment must be a style that reads back.
void expect_whole(const estampe::features::StyleTables& tables)
{
    const auto& schema = estampe::features::style_schema();
    const std::string text = schema.to_toml(tables);
    estampe::features::StyleTables again;
    schema.read_text(again, text, "again", resolve_presets);
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
