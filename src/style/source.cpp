// SPDX-License-Identifier: MIT
#include <cstring>
#include <system_error>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/file.hpp"
#include "style/presets.hpp"
#include "style/raw.hpp"
#include "style/sheet.hpp"
#include "style/suggest.hpp"

namespace estampe::style {
namespace {

constexpr std::string_view preset_prefix = "preset ";

bool looks_like_a_file(const std::string& name)
{
    return name.find('/') != std::string::npos || name.ends_with(".toml");
}

[[noreturn]] void fail_unknown(const std::string& name)
{
    const std::vector<std::string> presets = preset_names();
    const std::string meant = nearest(name, presets);
    const std::string known =
        presets.empty() ? "there are no presets" : fmt::format("presets are {}", fmt::join(presets, ", "));
    throw Error(fmt::format("no preset or style file {}", in_quotes(name)), {},
                meant.empty() ? known : fmt::format("did you mean {}?", in_quotes(meant)));
}

} // namespace

Source load_source(const std::filesystem::path& path)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes);
    std::string text(bytes.size(), '\0');
    std::memcpy(text.data(), bytes.data(), bytes.size());
    return {path.string(), std::move(text)};
}

Source resolve(const std::string& preset_or_file, const std::string& from)
{
    if (const auto text = preset_text(preset_or_file)) {
        return {std::string(preset_prefix) + preset_or_file, std::string(*text)};
    }
    std::filesystem::path path = preset_or_file;
    if (!from.empty() && !from.starts_with(preset_prefix)) {
        path = (std::filesystem::path(from).parent_path() / path).lexically_normal();
    }
    std::error_code problem;
    if (!looks_like_a_file(preset_or_file) && !std::filesystem::exists(path, problem)) {
        fail_unknown(preset_or_file);
    }
    return load_source(path);
}

} // namespace estampe::style
