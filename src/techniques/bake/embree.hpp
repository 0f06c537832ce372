// SPDX-License-Identifier: MIT
#pragma once

// Embree 3 (Debian 12) and Embree 4 (Debian 13) take different arguments to trace one ray.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace estampe::bake {

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
