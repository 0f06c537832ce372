// SPDX-License-Identifier: MIT
#include "scene/pictures/load_pictures.hpp"

#include <map>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/image_codec.hpp"

namespace estampe {
namespace {

/// Notes in the scene what is not there. Throws Error.
std::filesystem::path found_file(const std::string& name, FileFinder& finder, Scene& scene)
{
    std::optional<std::filesystem::path> file = finder.find(name);
    if (!file) {
        scene.missing_files.push_back(name);
        throw Error("no such file", name, "put the picture beside the scene's file");
    }
    return *std::move(file);
}

} // namespace

void load_pictures(Scene& scene, const std::vector<ImageSource>& sources, FileFinder& finder)
{
    std::map<std::filesystem::path, size_t> texture_of_file;
    for (size_t i = 0; i < sources.size(); ++i) {
        Image& image = scene.textures[i].image;
        if (image.rgba.size() == size_t{4} * image.width * image.height && !image.empty())
            continue;
        try {
            if (!sources[i].bytes.empty()) {
                image = decode_image(sources[i].bytes, sources[i].file);
                continue;
            }
            const std::filesystem::path file = found_file(sources[i].file, finder, scene);
            const auto [known, is_new] = texture_of_file.emplace(file, i);
            image = is_new ? load_image(file) : scene.textures[known->second].image;
        } catch (const Error& error) {
            scene.warnings.push_back(fmt::format("texture left white: {}", error.what()));
            image = {.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
        }
    }
}

} // namespace estampe
