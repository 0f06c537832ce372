// SPDX-License-Identifier: MIT
#include "support/embree_scene.hpp"

#include <algorithm>

#include "techniques/bake/embree.hpp"

namespace estampe::test {

struct EmbreeScene::Impl {
    struct Source {
        Index node = no_index;
        const Primitive* primitive = nullptr;
    };

    Impl() : device(rtcNewDevice("threads=1")), scene(rtcNewScene(device))
    {
        // Without the robust flag, rays slip through between neighbouring triangles.
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    }

    ~Impl()
    {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void add(const PosedPrimitive& posed);

    RTCDevice device;
    RTCScene scene;
    std::vector<Source> sources; ///< one per geometry, in the order of the geometries' numbers
};

namespace {

RTCRay make_ray(const glm::dvec3& from, const glm::dvec3& direction, double far_m)
{
    const glm::vec3 o(from);
    const glm::vec3 d(direction);
    return {.org_x = o.x,
            .org_y = o.y,
            .org_z = o.z,
            .tnear = 0.0F,
            .dir_x = d.x,
            .dir_y = d.y,
            .dir_z = d.z,
            .time = 0.0F,
            .tfar = static_cast<float>(far_m),
            .mask = ~0U,
            .id = 0,
            .flags = 0};
}

} // namespace

void EmbreeScene::Impl::add(const PosedPrimitive& posed)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), posed.positions.size()));
    for (const glm::dvec3& p : posed.positions) {
        for (int k = 0; k < 3; ++k) {
            *positions++ = static_cast<float>(p[k]);
        }
    }
    const auto& indices = posed.primitive->indices;
    auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), indices.size() / 3));
    std::copy_n(indices.begin(), indices.size() / 3 * 3, corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(sources.size()));
    rtcReleaseGeometry(geometry);
    sources.push_back({.node = posed.node, .primitive = posed.primitive});
}

EmbreeScene::EmbreeScene(const Scene& scene, double time_s,
                         const std::function<bool(const PosedPrimitive&)>& counts)
    : impl_(std::make_unique<Impl>())
{
    visit_posed(scene, pose_scene(scene, time_s), [&](const PosedPrimitive& posed) {
        const bool has_triangles =
            posed.primitive->topology == Topology::triangles && posed.primitive->indices.size() >= 3;
        if (has_triangles && (!counts || counts(posed))) {
            impl_->add(posed);
        }
    });
    rtcCommitScene(impl_->scene);
}

EmbreeScene::~EmbreeScene() = default;

bool EmbreeScene::is_blocked(const glm::dvec3& from, const glm::dvec3& direction, double far_m) const
{
    RTCRay ray = make_ray(from, direction, far_m);
    bake::occlude(impl_->scene, ray);
    return ray.tfar < 0.0F;
}

bool EmbreeScene::is_between(const glm::dvec3& from, const glm::dvec3& to) const
{
    const double distance_m = glm::length(to - from);
    return distance_m > 0.0 && is_blocked(from, (to - from) / distance_m, distance_m);
}

std::optional<EmbreeScene::Hit> EmbreeScene::first_hit(const glm::dvec3& from, const glm::dvec3& direction,
                                                       double far_m) const
{
    RTCRayHit found{.ray = make_ray(from, direction, far_m), .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    bake::intersect(impl_->scene, found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    const Impl::Source& source = impl_->sources[found.hit.geomID];
    const glm::dvec3 normal(static_cast<double>(found.hit.Ng_x), static_cast<double>(found.hit.Ng_y),
                            static_cast<double>(found.hit.Ng_z));
    return Hit{.distance_m = static_cast<double>(found.ray.tfar),
               .normal = glm::normalize(normal),
               .node = source.node,
               .primitive = source.primitive,
               .triangle = found.hit.primID,
               .weight = {static_cast<double>(found.hit.u), static_cast<double>(found.hit.v)}};
}

} // namespace estampe::test
