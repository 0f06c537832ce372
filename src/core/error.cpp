// SPDX-License-Identifier: MIT
#include <estampe/error.hpp>

#include <algorithm>

namespace estampe {
namespace {

std::string one_line(const std::string& what_failed, const std::string& where, const std::string& remedy)
{
    std::string line = where.empty() ? what_failed : where + ": " + what_failed;
    if (!remedy.empty()) {
        line += "; " + remedy;
    }
    // Names that come from files may contain line breaks or terminal escapes, which must not reach the
    // terminal.
    std::replace_if(
        line.begin(), line.end(), [](char character) { return static_cast<unsigned char>(character) < 0x20; },
        ' ');
    return line;
}

} // namespace

Error::Error(const std::string& what_failed, const std::string& where, const std::string& remedy)
    : std::runtime_error(one_line(what_failed, where, remedy)), where_(where), remedy_(remedy)
{
}

} // namespace estampe
