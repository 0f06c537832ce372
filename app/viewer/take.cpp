// SPDX-License-Identifier: MIT
#include "viewer/take.hpp"

#include <algorithm>

namespace estampe::viewer {
namespace {

Camera between(const Camera& a, const Camera& b, double share)
{
    Camera camera = a;
    const bool are_alike =
        a.orthographic_half_height_m.has_value() == b.orthographic_half_height_m.has_value();
    if (!are_alike) {
        return camera;
    }
    camera.eye = glm::mix(a.eye, b.eye, share);
    camera.target = glm::mix(a.target, b.target, share);
    const glm::dvec3 up = glm::mix(a.up, b.up, share);
    camera.up = glm::length(up) > 1e-3 ? glm::normalize(up) : a.up;
    camera.vertical_fov_rad = glm::mix(a.vertical_fov_rad, b.vertical_fov_rad, share);
    if (a.orthographic_half_height_m) {
        camera.orthographic_half_height_m =
            glm::mix(*a.orthographic_half_height_m, *b.orthographic_half_height_m, share);
    }
    return camera;
}

} // namespace

Take::Sample Take::at(double seconds) const
{
    const auto later = std::ranges::upper_bound(samples_, seconds, {}, &Sample::at_s);
    if (later == samples_.begin()) {
        return samples_.front();
    }
    const Sample& before = *(later - 1);
    if (later == samples_.end()) {
        return before;
    }
    const double length_s = later->at_s - before.at_s;
    const double share = length_s > 0.0 ? (seconds - before.at_s) / length_s : 0.0;
    Sample sample = before;
    sample.at_s = seconds;
    sample.camera = between(before.camera, later->camera, share);
    if (before.animation == later->animation && later->time_s >= before.time_s) {
        sample.time_s = glm::mix(before.time_s, later->time_s, share);
    }
    return sample;
}

} // namespace estampe::viewer
