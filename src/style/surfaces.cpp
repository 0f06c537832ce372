// SPDX-License-Identifier: MIT
#include "style/surfaces.hpp"

#include <fnmatch.h>

namespace estampe::style {

bool matches(const std::string& pattern, const std::string& name)
{
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

} // namespace estampe::style
