// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// Gathers the textures that materials use, then decodes each of their images once.
class TextureTable {
public:
    explicit TextureTable(Data& data) : data_(data) {}

    /// The scene's index of the file's texture `index`. Two textures of the same image and wrap modes are
    /// one.
    [[nodiscard]] Index use(int index);

    /// All textures in use. An image that is missing or damaged becomes one white pixel, with a warning.
    [[nodiscard]] std::vector<Texture> decode();

private:
    struct Use {
        int texture = -1;
        int image = -1;
        Wrap wrap_u = Wrap::repeat;
        Wrap wrap_v = Wrap::repeat;
    };

    [[nodiscard]] Image decode_one(int image, std::string& warning) const;

    Data& data_;
    std::map<std::tuple<int, Wrap, Wrap>, Index> index_of_;
    std::vector<Use> uses_;
};

} // namespace estampe::gltf
