// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include <estampe/scene.hpp>

#include "scene/obj/mtl.hpp"
#include "scene/pictures/file_finder.hpp"

namespace estampe::obj {

/// Makes the textures of materials. A picture is decoded once, and one that cannot be found or read is left
/// out with a warning that names it, once.
class Textures {
public:
    explicit Textures(Scene& scene) : scene_(scene) {}

    /// Whether the picture can be read.
    [[nodiscard]] bool has(const MtlMap& map, FileFinder& finder)
    {
        return picture(map.file, finder) != nullptr;
    }

    /// The picture as it is; one white pixel when it cannot be read, so that the material's colour shows.
    [[nodiscard]] TextureRef color(const MtlMap& map, FileFinder& finder);

    /// The colours of one picture with the opacity of another in the alpha channel: that is how a Material
    /// has it. Opacity is the other's alpha where it has any, or else its brightness. `color_map` may name no
    /// file: white.
    [[nodiscard]] TextureRef color_with_opacity(const MtlMap& color_map, const MtlMap& opacity_map,
                                                FileFinder& finder);

    /// A picture of normals; one of heights is turned into normals. Nothing when it cannot be read.
    [[nodiscard]] TextureRef normals(const MtlMap& map, FileFinder& finder);

private:
    enum class Use : uint8_t { color, opacity, normals };

    using Key = std::tuple<std::string, std::string, Use, bool>;

    /// A file's picture. It moves to the first texture that shows it as it is, for pictures are large.
    struct Picture {
        std::optional<Image> image; ///< nothing: cannot be read, or has moved
        Index texture = no_index;   ///< where it has moved to
    };

    [[nodiscard]] Picture& decoded(const std::string& name, FileFinder& finder);
    [[nodiscard]] const Image* picture(const std::string& name, FileFinder& finder);
    [[nodiscard]] std::string place_of(const std::string& name, FileFinder& finder);
    [[nodiscard]] std::optional<TextureRef> known(const Key& key, const MtlMap& map) const;
    [[nodiscard]] TextureRef add(const Key& key, const MtlMap& map, Image image);

    Scene& scene_;
    std::map<std::string, Picture> pictures_; ///< by place, or by name where there is none
    std::map<Key, Index> textures_;
};

} // namespace estampe::obj
