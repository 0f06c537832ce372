// SPDX-License-Identifier: MIT
#include "techniques/bake/embree.hpp"

#include <algorithm>
#include <cstdint>

#include <estampe/error.hpp>

namespace estampe::bake {

std::shared_ptr<void> build_rays(std::span<const glm::vec3> corners)
{
    RTCDevice device = rtcNewDevice(nullptr);
    if (device == nullptr) {
        throw Error("Embree does not start on this processor");
    }
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* places = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners.size() / 3));
    if (places == nullptr || indices == nullptr) {
        rtcReleaseGeometry(geometry);
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
        throw Error("the scene is too large to follow rays through");
    }
    std::copy(corners.begin(), corners.end(), places);
    for (uint32_t i = 0; i < corners.size(); ++i) {
        indices[i] = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return {scene, [device](void* built) {
                rtcReleaseScene(static_cast<RTCScene>(built));
                rtcReleaseDevice(device);
            }};
}

} // namespace estampe::bake
