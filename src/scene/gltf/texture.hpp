// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// Gathers the textures that materials use, then decodes each of their pictures once.
class TextureTable {
public:
    explicit TextureTable(Data& data);

    /// The scene's index of the file's texture `index`. Two textures of the same picture and wrap modes are
    /// one.
    [[nodiscard]] Index use(int index);

    /// All textures in use. A picture that is missing, damaged or of a format that is not read becomes one
    /// white pixel, with a warning; files that could not be opened are added to `missing_files`.
    [[nodiscard]] std::vector<Texture> decode(std::vector<std::string>& missing_files);

    /// Whether a texture of the scene was replaced by a white pixel. Known after decode().
    [[nodiscard]] bool is_lost(Index texture) const;

private:
    struct Use {
        int texture = -1;
        int image = -1; ///< negative: none that can be read
        std::string_view unread_format;
        Wrap wrap_u = Wrap::repeat;
        Wrap wrap_v = Wrap::repeat;
    };

    struct Decoded {
        Image image;
        std::string failure; ///< empty: it was read
        bool is_missing = false;
        size_t uses_left = 0;
    };

    [[nodiscard]] Decoded decode_one(int image) const;
    [[nodiscard]] std::map<int, Decoded> decode_all();
    void warn_of_unread(const Use& use);

    Data& data_;
    std::vector<int> first_of_same_; ///< per image of the file, the first with the same file or bytes
    std::map<std::tuple<int, int, Wrap, Wrap>, Index> index_of_;
    std::vector<Use> uses_;
    std::vector<bool> lost_;
};

} // namespace estampe::gltf
