// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scene/mending/repair.hpp"

namespace estampe {
namespace {

constexpr double clear_below = 0.05;
constexpr double solid_above = 0.9;

/// How a material's alpha is spread over the surfaces that it covers, by area.
struct AlphaShares {
    double area = 0.0;
    double clear = 0.0;
    double solid = 0.0;
    double wholly_solid = 0.0; ///< to the last of 8 bits
};

double wrapped(double t, Wrap wrap)
{
    if (!std::isfinite(t)) {
        return 0.0;
    }
    if (wrap == Wrap::clamp) {
        return std::clamp(t, 0.0, 1.0);
    }
    const double part = t - std::floor(t);
    const bool is_odd = std::fmod(std::abs(std::floor(t)), 2.0) == 1.0;
    return wrap == Wrap::mirror && is_odd ? 1.0 - part : part;
}

/// Alpha of the texel at a place, 0 to 1.
double alpha_at(const Texture& texture, const glm::dvec2& uv)
{
    const auto texel = [](double t, uint32_t count) {
        return std::min(static_cast<uint32_t>(t * count), count - 1);
    };
    const uint32_t x = texel(wrapped(uv.x, texture.wrap_u), texture.image.width);
    const uint32_t y = texel(wrapped(uv.y, texture.wrap_v), texture.image.height);
    return texture.image.rgba[4 * (size_t{y} * texture.image.width + x) + 3] / 255.0;
}

/// Walks over the triangles of one material.
class AlphaMeter {
public:
    AlphaMeter(const Scene& scene, Index material) : scene_(scene), material_(scene.materials[material])
    {
        size_t triangles = 0;
        const auto of_material = [&](const auto& visit) {
            for (const Mesh& mesh : scene.meshes) {
                for (const Primitive& primitive : mesh.primitives) {
                    if (primitive.material == material && primitive.topology == Topology::triangles) {
                        visit(primitive);
                    }
                }
            }
        };
        of_material([&](const Primitive& primitive) { triangles += primitive.indices.size() / 3; });
        // Enough of them to tell; each is looked at in as many places as make about as many in all.
        constexpr size_t enough = 1U << 17U;
        const size_t stride = std::max<size_t>(1, triangles / enough);
        places_ = std::clamp<size_t>(enough / std::max<size_t>(triangles, 1), 4, 4096);
        of_material([&](const Primitive& primitive) {
            for (size_t t = 0; t < primitive.indices.size() / 3; t += stride) {
                add(primitive, &primitive.indices[3 * t]);
            }
        });
    }

    [[nodiscard]] const AlphaShares& shares() const { return shares_; }

private:
    void add(const Primitive& primitive, const uint32_t* corners)
    {
        const glm::dvec3 a = primitive.positions[corners[0]];
        const double area = glm::length(glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                                   glm::dvec3(primitive.positions[corners[2]]) - a));
        for (size_t i = 0; i < places_; ++i) {
            // Roberts' sequence, folded from the square into the triangle.
            double u = std::fmod(0.7548776662466927 * static_cast<double>(i + 1), 1.0);
            double v = std::fmod(0.5698402909980532 * static_cast<double>(i + 1), 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            count(alpha(primitive, corners, {1.0 - u - v, u, v}), area / static_cast<double>(places_));
        }
    }

    [[nodiscard]] double alpha(const Primitive& primitive, const uint32_t* corners,
                               const glm::dvec3& weights) const
    {
        auto alpha = static_cast<double>(material_.base_color.w);
        const TextureRef& ref = material_.base_color_texture;
        const auto& uvs = primitive.uvs[std::min(ref.uv_set, 1U)];
        glm::dvec2 uv(0.0);
        double color = 0.0;
        for (int k = 0; k < 3; ++k) {
            uv += uvs.empty() ? glm::dvec2(0.0) : weights[k] * glm::dvec2(uvs[corners[k]]);
            color += primitive.colors.empty()
                         ? weights[k]
                         : weights[k] * static_cast<double>(primitive.colors[corners[k]].w);
        }
        if (ref.texture != no_index) {
            const glm::dvec3 placed = glm::dmat3(ref.uv_transform) * glm::dvec3(uv, 1.0);
            alpha *= alpha_at(scene_.textures[ref.texture], glm::dvec2(placed));
        }
        return alpha * color;
    }

    void count(double alpha, double area)
    {
        shares_.area += area;
        shares_.clear += alpha < clear_below ? area : 0.0;
        shares_.solid += alpha > solid_above ? area : 0.0;
        shares_.wholly_solid += alpha > 0.995 ? area : 0.0;
    }

    const Scene& scene_;
    const Material& material_;
    size_t places_ = 4;
    AlphaShares shares_;
};

} // namespace

void find_cut_out_materials(Scene& scene)
{
    // Leaves and fences are clear or solid but for their soft borders; hair is soft over half of its width.
    constexpr double much = 0.4;
    constexpr double some = 0.01;
    constexpr double a_part = 0.1;
    for (Index index = 0; index < scene.materials.size(); ++index) {
        Material& material = scene.materials[index];
        if (material.alpha_mode != AlphaMode::blend || material.transmission) {
            continue;
        }
        const AlphaShares shares = AlphaMeter(scene, index).shares();
        if (!(shares.area > 0.0)) {
            continue;
        }
        material.has_clear_parts = shares.clear >= some * shares.area;
        if (shares.wholly_solid == shares.area) {
            material.alpha_mode = AlphaMode::opaque;
        } else if (material.has_clear_parts && shares.solid >= a_part * shares.area &&
                   shares.clear + shares.solid >= much * shares.area) {
            material.alpha_mode = AlphaMode::mask;
            material.alpha_cutoff = 0.5F;
        }
    }
}

} // namespace estampe
