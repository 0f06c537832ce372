// SPDX-License-Identifier: MIT
#include "style/names.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "core/text.hpp"
#include "style/toml.hpp"

namespace estampe::style {

size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<size_t> before(b.size() + 1);
    std::vector<size_t> previous(b.size() + 1);
    std::vector<size_t> current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replace = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U);
            current[j] = std::min({replace, previous[j] + 1, current[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                current[j] = std::min(current[j], before[j - 2] + 1);
            }
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> candidates)
{
    constexpr size_t longest_word = 100;
    if (word.size() > longest_word) {
        return {};
    }
    const std::string* best = nullptr;
    size_t best_distance = 0;
    for (const std::string& candidate : candidates) {
        const size_t distance = edit_distance(word, candidate);
        const size_t tolerance = std::max<size_t>(1, std::max(word.size(), candidate.size()) / 3);
        if (distance <= tolerance && (best == nullptr || distance < best_distance)) {
            best = &candidate;
            best_distance = distance;
        }
    }
    return best == nullptr ? std::string() : *best;
}

std::vector<std::string> between_commas(std::string_view text)
{
    std::vector<std::string> parts;
    std::istringstream stream{std::string(text)};
    for (std::string part; std::getline(stream, part, ',');) {
        if (const std::string_view inner = trimmed(part, " "); !inner.empty()) {
            parts.emplace_back(inner);
        }
    }
    return parts;
}

} // namespace estampe::style
