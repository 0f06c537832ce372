// SPDX-License-Identifier: MIT
#pragma once

// Embree 3 (Debian 12) and Embree 4 (Debian 13) take different arguments to trace one ray.

#include <memory>
#include <span>

#include <glm/glm.hpp>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace estampe::bake {

/// Builds an Embree scene of triangles, from three positions per triangle; the triangle's number is the
/// `primID` of a hit. Embree uses all threads, because its thread limit would hold for the whole process.
/// Throws Error if Embree cannot start or needs more memory than is available. Cost: about 0.5 us per
/// triangle.
[[nodiscard]] std::shared_ptr<void> build_rays(std::span<const glm::vec3> corners);

/// Returns a ray from `from` along the unit vector `direction` that is `reach_m` long.
[[nodiscard]] inline RTCRay ray_of(const glm::vec3& from, const glm::vec3& direction, float reach_m)
{
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = reach_m;
    ray.mask = ~0U;
    return ray;
}

/// Finds the nearest hit of a ray with Embree.
inline void intersect(RTCScene scene, RTCRayHit& ray)
{
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
}

/// Tests with Embree whether anything blocks the ray, and sets the ray's `tfar` to minus infinity if so.
inline void occlude(RTCScene scene, RTCRay& ray)
{
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

} // namespace estampe::bake
