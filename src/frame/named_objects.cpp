// SPDX-License-Identifier: MIT
#include "frame/named_objects.hpp"

#include "style/surfaces.hpp"

namespace estampe::frame {

bool is_named(const Scene& scene, Index node, const std::string& pattern)
{
    for (; node != no_index; node = scene.nodes[node].parent) {
        if (style::matches(pattern, scene.nodes[node].name)) {
            return true;
        }
    }
    return false;
}

} // namespace estampe::frame
