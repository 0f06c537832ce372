// SPDX-License-Identifier: MIT
#include "viewer/parameter_search.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace estampe::viewer {
namespace {

std::string small(std::string text)
{
    std::ranges::transform(text, text.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

} // namespace

bool matches(const style::Sheet::Section& section, const style::Parameter& parameter,
             const std::string& search)
{
    const std::string text = small(section.name + "." + parameter.key + " " + parameter.help);
    std::istringstream words(small(search));
    std::string word;
    while (words >> word) {
        if (text.find(word) == std::string::npos) {
            return false;
        }
    }
    return true;
}

bool matches(const style::Sheet::Section& section, const std::string& search)
{
    return std::ranges::any_of(section.parameters, [&](const style::Parameter& parameter) {
        return matches(section, parameter, search);
    });
}

} // namespace estampe::viewer
