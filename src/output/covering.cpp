// SPDX-License-Identifier: MIT
#include "output/covering.hpp"

namespace estampe::output {
namespace {

/// The least share of a layer that can turn `below` into `wanted`, whatever its colour.
double least_alpha(double below, double wanted, double top)
{
    if (wanted > below) {
        return (wanted - below) / std::max(top - below, wanted - below);
    }
    return below > wanted ? (below - wanted) / below : 0.0;
}

/// The alpha by which a pigment comes nearest to what is wanted; where it differs too little from what is
/// below to tell, its share of the pixel.
double pigment_alpha(const Laid& laid, const Wanted& wanted, const glm::dvec3& pigment, double share, int top)
{
    const glm::dvec3 way = laid.exact - pigment;
    const double least_way = 0.02 * top;
    const double length_2 = glm::dot(way, way);
    return length_2 > least_way * least_way ? glm::dot(laid.exact - wanted.exact, way) / length_2 : share;
}

} // namespace

glm::ivec4 covering(Laid& laid, const Wanted& wanted, const glm::vec4& paint, const Arithmetic& in)
{
    if (paint.w <= 0.0F) {
        return glm::ivec4(0);
    }
    const int top = in.top();
    const glm::dvec3 pigment = in.encoded(glm::vec3(paint) / paint.w);
    double least = 0.0;
    for (int i = 0; i < 3; ++i) {
        least = std::max({least, least_alpha(laid.exact[i], wanted.exact[i], top),
                          least_alpha(laid.rounded[i], wanted.rounded[i], top)});
    }
    const double share =
        std::max(least, pigment_alpha(laid, wanted, pigment, static_cast<double>(paint.w), top));
    const int alpha = std::clamp(
        std::max(static_cast<int>(std::ceil(least * top - 1e-9)), in.nearest(share * top)), 0, top);
    if (alpha == 0) {
        return glm::ivec4(0);
    }
    glm::ivec4 pixel(0, 0, 0, alpha);
    for (int i = 0; i < 3; ++i) {
        const auto result = [&](int color) { return in.over(laid.rounded[i], color, alpha); };
        const int own = in.nearest(pigment[i]);
        const bool serves = result(own) == wanted.rounded[i] &&
                            std::abs(in.over(laid.exact[i], own, alpha) - wanted.exact[i]) <= 0.5;
        const double ideal = laid.exact[i] + (wanted.exact[i] - laid.exact[i]) * top / alpha;
        pixel[i] = serves ? own : tuned(in.nearest(ideal), wanted.rounded[i], top, result);
        laid.exact[i] = in.over(laid.exact[i], pixel[i], alpha);
        laid.rounded[i] = result(pixel[i]);
    }
    return pixel;
}

glm::ivec4 straight(const glm::vec4& page, const glm::vec3& paper, const Arithmetic& in)
{
    const float alpha = std::min(page.w, 1.0F);
    Wanted wanted{.exact = in.encoded(glm::vec3(page) + (1.0F - alpha) * paper)};
    Laid laid{.exact = in.encoded(paper)};
    for (int i = 0; i < 3; ++i) {
        wanted.rounded[i] = in.nearest(wanted.exact[i]);
        laid.rounded[i] = in.nearest(laid.exact[i]);
    }
    if (page.w >= 1.0F) {
        return {wanted.rounded, in.top()};
    }
    return covering(laid, wanted, page, in);
}

} // namespace estampe::output
