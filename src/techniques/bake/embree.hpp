// SPDX-License-Identifier: MIT
#pragma once

// Embree 3, as in Debian 12, and Embree 4, as in Debian 13, ask for one ray in two ways.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace estampe::bake {

/// Finds the nearest thing that the ray hits.
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

/// Sets the ray's end to minus infinity where something lies on it.
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
