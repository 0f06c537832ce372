// SPDX-License-Identifier: MIT
#include "techniques/bake/canvas.hpp"

#include <algorithm>

namespace estampe::bake {

std::vector<uint32_t> fill_beside(Canvas& canvas, const std::vector<uint32_t>& wanted)
{
    std::vector<uint32_t> filled;
    std::vector<glm::vec3> means;
    for (const uint32_t place : wanted) {
        glm::vec3 sum(0.0F);
        float count = 0.0F;
        canvas.around(place, [&](uint32_t other) {
            if (canvas.known[other]) {
                sum += canvas.light[other];
                count += 1.0F;
            }
        });
        if (count > 0.0F) {
            filled.push_back(place);
            means.push_back(sum / count);
        }
    }
    for (size_t i = 0; i < filled.size(); ++i) {
        canvas.light[filled[i]] = means[i];
        canvas.known[filled[i]] = true;
    }
    return filled;
}

std::vector<uint32_t> unknown_beside(const Canvas& canvas, const std::vector<uint32_t>& texels)
{
    std::vector<uint32_t> found;
    for (const uint32_t place : texels) {
        canvas.around(place, [&](uint32_t other) {
            if (!canvas.known[other]) {
                found.push_back(other);
            }
        });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

} // namespace estampe::bake
