// SPDX-License-Identifier: MIT
#include "style/material_kind.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "style/parameter.hpp"

namespace estampe::style {
namespace {

constexpr std::string_view kind_prefix = "kind:";

/// Words that name a kind. A star means that a word may go on in any way; otherwise only an s may follow,
/// because "tin" is no beginning of "tint".
struct KindWords {
    std::string_view kind;
    std::string_view words;
};

constexpr auto kind_words = std::to_array<KindWords>(
    {{"stone", "stone* marble* granit* rock brick* concrete* cement* plaster* stucco* masonry* limestone* "
               "sandstone* slate cobble* pierre marbre* brique* roche beton* stein ziegel*"},
     {"wood", "wood* timber* plank* oak pine walnut* mahogany* bark trunk bois chene holz*"},
     {"cloth",
      "cloth* fabric* textile* linen* wool* cotton* velvet* silk* denim* curtain* carpet* rug shirt* "
      "trouser* pants dress jacket* flag banner* tissu* rideau* drapeau* stoff"},
     {"metal",
      "metal* steel* iron chrome* brass* bronze* copper* gold silver* alumin* tin acier* fer cuivre* "
      "laiton* stahl* eisen*"},
     {"skin", "skin flesh* face peau visage* haut"},
     {"sand", "sand sandy dune* gravel* sable gravier*"},
     {"water", "water* ocean* sea river* lake* wave eau mer wasser*"},
     {"leaves", "leaf* leaves foliage* grass* ivy hedge* bush feuille* herbe* blatt* laub*"}});

bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_capital(char c)
{
    return c >= 'A' && c <= 'Z';
}

/// The words of a name in small letters: "OldBrick_wall.001" has old, brick and wall.
std::vector<std::string> words_of(std::string_view name)
{
    std::vector<std::string> words;
    char before = ' ';
    for (const char c : name) {
        const bool begins = !is_letter(before) || (is_capital(c) && !is_capital(before));
        if (is_letter(c) && begins) {
            words.emplace_back();
        }
        if (is_letter(c)) {
            words.back() += is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c;
        }
        before = c;
    }
    return words;
}

/// Whether `known`, which may end in a star, is a word of a name.
bool is_word(std::string_view known, std::string_view word)
{
    if (known.ends_with('*')) {
        return word.starts_with(known.substr(0, known.size() - 1));
    }
    return word == known || (word.starts_with(known) && word.substr(known.size()) == "s");
}

bool has_word(std::string_view words, std::string_view word)
{
    while (!words.empty()) {
        const size_t end = std::min(words.find(' '), words.size());
        if (is_word(words.substr(0, end), word)) {
            return true;
        }
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

} // namespace

std::optional<std::string_view> kind_of(const MaterialFacts& material)
{
    std::optional<std::string_view> kind;
    for (const std::string& word : words_of(material.name)) {
        const auto* const found = std::ranges::find_if(
            kind_words, [&](const KindWords& known) { return has_word(known.words, word); });
        kind = found != kind_words.end() ? std::optional(found->kind) : kind;
    }
    if (kind) {
        return kind;
    }
    if (material.is_foliage) {
        return "leaves";
    }
    // A glTF file that says nothing of metal has a metallic factor of 1 and a roughness of 1.
    constexpr float least_metallic = 0.5F;
    constexpr float most_roughness = 0.75F;
    const bool is_metal = material.metallic >= least_metallic && material.roughness <= most_roughness;
    return is_metal ? std::optional<std::string_view>("metal") : std::nullopt;
}

std::optional<std::string_view> named_kind(std::string_view pattern)
{
    if (!pattern.starts_with(kind_prefix)) {
        return std::nullopt;
    }
    return pattern.substr(kind_prefix.size());
}

bool means(const std::string& pattern, const std::string& name, std::optional<std::string_view> kind)
{
    const auto wanted = named_kind(pattern);
    return wanted ? kind == wanted : matches(pattern, name);
}

} // namespace estampe::style
