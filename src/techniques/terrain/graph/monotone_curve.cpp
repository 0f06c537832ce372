// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/monotone_curve.hpp"

namespace estampe::terrain {

std::vector<double> monotone_curve(std::span<const glm::dvec2> points)
{
    const auto rise = [&](size_t i) {
        return (points[i + 1].y - points[i].y) / (points[i + 1].x - points[i].x);
    };
    std::vector<double> result;
    for (size_t i = 0; i < points.size(); ++i) {
        double slope = 0.0;
        if (i > 0 && i + 1 < points.size() && rise(i - 1) * rise(i) > 0.0) {
            const double before = points[i].x - points[i - 1].x;
            const double after = points[i + 1].x - points[i].x;
            // The weighted harmonic mean keeps within three times the lesser rise, which is enough.
            const double near = 2.0 * after + before;
            const double far = after + 2.0 * before;
            slope = (near + far) / (near / rise(i - 1) + far / rise(i));
        }
        result.insert(result.end(), {points[i].x, points[i].y, slope});
    }
    return result;
}

} // namespace estampe::terrain
