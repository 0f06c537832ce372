// SPDX-License-Identifier: MIT
#include "frame/between_commas.hpp"

#include <sstream>

namespace estampe::frame {

std::vector<std::string> between_commas(std::string_view text)
{
    std::vector<std::string> parts;
    std::istringstream stream{std::string(text)};
    for (std::string part; std::getline(stream, part, ',');) {
        const size_t first = part.find_first_not_of(' ');
        if (first != std::string::npos) {
            parts.push_back(part.substr(first, part.find_last_not_of(' ') + 1 - first));
        }
    }
    return parts;
}

} // namespace estampe::frame
