// SPDX-License-Identifier: MIT
#include "features/common/named_objects.hpp"

#include "style/surfaces.hpp"

namespace estampe::features {

bool is_named(const Scene& scene, Index node, const std::string& pattern)
{
    for (; node != no_index; node = scene.nodes[node].parent) {
        if (style::matches(pattern, scene.nodes[node].name)) {
            return true;
        }
    }
    return false;
}

} // namespace estampe::features
