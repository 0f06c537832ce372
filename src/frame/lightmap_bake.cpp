// SPDX-License-Identifier: MIT
// The public door to baking.
#include <estampe/bake.hpp>

#include <utility>

#include "features/lighting/light_links.hpp"
#include "frame/baking.hpp"
#include "scene/static_triangles.hpp"
#include "scene/visibility.hpp"

namespace estampe {
namespace {

Scene shown(Scene scene)
{
    hide_invisible(scene);
    return scene;
}

bake::BakeSettings lit_settings(const Scene& scene, const Style& style, const BakeSettings& wanted)
{
    bake::BakeSettings settings{.size = wanted.size,
                                .samples = wanted.samples,
                                .bounces = wanted.bounces,
                                .seed = wanted.seed,
                                .smooth = wanted.smooth};
    frame::set_light(settings, scene, style.tables(), {.direct = wanted.direct, .sky = wanted.sky});
    return settings;
}

} // namespace

struct LightmapBake::Impl {
    Impl(Scene own_scene, const Style& style, const BakeSettings& settings)
        : scene(features::lit_by_style(shown(std::move(own_scene)), style.tables().light)),
          bake(scene, lit_settings(scene, style, settings))
    {
    }

    Scene scene;
    bake::Bake bake; ///< reads the scene
};

LightmapBake::LightmapBake(Scene scene, const Style& style, const BakeSettings& settings)
    : impl_(std::make_unique<Impl>(std::move(scene), style, settings))
{
}

LightmapBake::~LightmapBake() = default;

LightmapBake::LightmapBake(LightmapBake&&) noexcept = default;

LightmapBake& LightmapBake::operator=(LightmapBake&&) noexcept = default;

bool LightmapBake::work(double seconds)
{
    return impl_->bake.work(seconds);
}

double LightmapBake::done() const
{
    return impl_->bake.done();
}

bool LightmapBake::load_progress(const std::filesystem::path& path)
{
    return impl_->bake.load_progress(path);
}

void LightmapBake::save_progress(const std::filesystem::path& path) const
{
    impl_->bake.save_progress(path);
}

Lightmap LightmapBake::map() const
{
    return impl_->bake.map();
}

size_t LightmapBake::texel_count() const
{
    return impl_->bake.texel_count();
}

float LightmapBake::texels_per_m() const
{
    return impl_->bake.texels_per_m();
}

bool LightmapBake::leaves_out_moving() const
{
    return has_moving_parts(impl_->scene);
}

} // namespace estampe
