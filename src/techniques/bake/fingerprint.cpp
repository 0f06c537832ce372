// SPDX-License-Identifier: MIT
#include "techniques/bake/fingerprint.hpp"

#include "core/hash.hpp"

namespace estampe::bake {
namespace {

void add_texture(Hash& hash, const TextureRef& reference)
{
    hash.add(reference.texture);
    hash.add(reference.uv_set);
    hash.add(reference.uv_transform);
}

void add_links(Hash& hash, const LightLinks& links)
{
    hash.add(links.lit_by);
    hash.add(links.casts_for);
    hash.add(links.receives_shadows);
}

void add_material(Hash& hash, const Material& material)
{
    hash.add(material.base_color);
    add_texture(hash, material.base_color_texture);
    hash.add(material.emissive);
    add_texture(hash, material.emissive_texture);
    hash.add(material.alpha_mode);
    hash.add(material.alpha_cutoff);
    hash.add(material.double_sided);
    hash.add(material.unlit);
    add_links(hash, material.links);
}

void add_lamp(Hash& hash, const Lamp& lamp)
{
    hash.add(lamp.kind);
    hash.add(lamp.position);
    hash.add(lamp.direction);
    hash.add(lamp.color);
    hash.add(lamp.range_m);
    hash.add(lamp.cone_scale);
    hash.add(lamp.cone_offset);
    hash.add(lamp.side);
    hash.add(lamp.unit_volume);
    hash.add(lamp.groups);
    hash.add(lamp.casters);
    hash.add(lamp.baked);
}

} // namespace

uint64_t work_fingerprint(const Scene& scene, const StaticTriangles& triangles, const BakeSettings& settings)
{
    Hash hash;
    for (const StaticDraw& draw : triangles.draws) {
        hash.add(draw.triangle_count);
        hash.add(draw.material);
        add_links(hash, scene.nodes[draw.node].links);
    }
    hash.add_all(triangles.positions);
    hash.add_all(triangles.normals);
    hash.add_all(triangles.uvs[0]);
    hash.add_all(triangles.uvs[1]);
    hash.add_all(triangles.colors);
    for (const Material& material : scene.materials) {
        add_material(hash, material);
    }
    for (const Texture& texture : scene.textures) {
        hash.add_all(texture.image.rgba);
        hash.add(texture.image.width);
        hash.add(texture.wrap_u);
        hash.add(texture.wrap_v);
    }
    hash.add(settings.size);
    hash.add(settings.samples);
    hash.add(settings.bounces);
    hash.add(settings.seed);
    hash.add(settings.sky);
    hash.add(settings.ground);
    hash.add(settings.exposure);
    for (const Lamp& lamp : settings.lamps) {
        add_lamp(hash, lamp);
    }
    return hash.value();
}

} // namespace estampe::bake
