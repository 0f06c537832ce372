// SPDX-License-Identifier: MIT
#include "scene/gltf/texture.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <system_error>
#include <thread>

#include "core/image_codec.hpp"
#include "core/progress_watch.hpp"

namespace estampe::gltf {
namespace {

constexpr unsigned max_threads = 4;
constexpr double textures_from = 0.1; ///< share of a file's reading that is done when they begin
constexpr double textures_to = 0.75;
constexpr uint64_t max_total_pixels = uint64_t{1} << 29;

Wrap wrap_of(int mode)
{
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirror;
    default:
        return Wrap::repeat;
    }
}

Image white_pixel()
{
    return {.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
}

/// Calls `work(i)` for i below `count` on up to four threads, or as many as the machine starts, and here
/// `tell(done)` from time to time, which may throw to end it.
template <typename Work, typename Tell>
void for_each_in_parallel(size_t count, const Work& work, const Tell& tell)
{
    std::atomic<size_t> next = 0;
    const auto loop = [&] {
        for (size_t i = next++; i < count; i = next++) {
            work(i);
        }
    };
    const auto threads =
        std::min<size_t>({count, max_threads, std::max(1U, std::thread::hardware_concurrency())});
    std::vector<std::jthread> helpers;
    try {
        for (size_t i = 1; i < threads; ++i) {
            helpers.emplace_back(loop);
        }
    } catch (const std::system_error&) {
        // Those that there are, and this one, do it all.
    }
    for (size_t i = next++; i < count; i = next++) {
        work(i);
        try {
            tell(i + 1);
        } catch (...) {
            next = count;
            throw;
        }
    }
}

} // namespace

Index TextureTable::use(int index)
{
    const tinygltf::Texture& texture = data_.model().textures[static_cast<size_t>(index)];
    Use use{.texture = index, .image = texture.source};
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp != texture.extensions.end()) {
        use.image = webp->second.Get("source").GetNumberAsInt();
    }
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = data_.model().samplers[static_cast<size_t>(texture.sampler)];
        use.wrap_u = wrap_of(sampler.wrapS);
        use.wrap_v = wrap_of(sampler.wrapT);
    }
    const auto [entry, added] =
        index_of_.try_emplace({use.image, use.wrap_u, use.wrap_v}, static_cast<Index>(uses_.size()));
    if (added) {
        uses_.push_back(use);
    }
    return entry->second;
}

Image TextureTable::decode_one(int image, std::string& warning) const
{
    const ImageSource& source = data_.images()[static_cast<size_t>(image)];
    const std::string name = source.view >= 0 ? "" : data_.resource_name(source.uri);
    try {
        if (source.view >= 0) {
            return decode_image(data_.view(source.view), name);
        }
        if (source.uri.empty()) {
            throw Error("has neither uri nor bufferView");
        }
        return decode_image(data_.resource(source.uri), name);
    } catch (const std::exception& error) {
        warning = fmt::format("{}; the texture is drawn white", error.what());
        return white_pixel();
    }
}

std::vector<Texture> TextureTable::decode()
{
    std::map<int, size_t> slot_of;
    std::vector<int> images;
    std::vector<size_t> uses_left;
    for (const Use& use : uses_) {
        if (use.image >= 0 && slot_of.try_emplace(use.image, images.size()).second) {
            images.push_back(use.image);
            uses_left.push_back(0);
        }
        if (use.image >= 0) {
            ++uses_left[slot_of[use.image]];
        }
    }
    std::vector<Image> decoded(images.size());
    std::vector<std::string> failures(images.size());
    std::atomic<uint64_t> total_pixels = 0;
    const auto decode_next = [&](size_t i) {
        decoded[i] = decode_one(images[i], failures[i]);
        total_pixels += uint64_t{decoded[i].width} * decoded[i].height;
        if (total_pixels > max_total_pixels) {
            failures[i] =
                "the textures together are beyond the limit of 512 megapixels; this one is drawn white";
            decoded[i] = white_pixel();
        }
    };
    for_each_in_parallel(images.size(), decode_next, [&](size_t done) {
        const double share = static_cast<double>(done) / static_cast<double>(images.size());
        report_progress(std::lerp(textures_from, textures_to, share));
    });
    for (size_t i = 0; i < images.size(); ++i) {
        if (!failures[i].empty()) {
            data_.warn(fmt::format("/images/{}", images[i]), failures[i]);
        }
    }
    std::vector<Texture> textures;
    for (const Use& use : uses_) {
        Texture& texture = textures.emplace_back();
        const tinygltf::Texture& source = data_.model().textures[static_cast<size_t>(use.texture)];
        texture.name = source.name;
        texture.wrap_u = use.wrap_u;
        texture.wrap_v = use.wrap_v;
        if (use.image < 0) {
            data_.warn(fmt::format("/textures/{}", use.texture),
                       "has no image that can be read; it is drawn white");
            texture.image = white_pixel();
            continue;
        }
        const ImageSource& image = data_.images()[static_cast<size_t>(use.image)];
        texture.name = texture.name.empty() ? image.name : texture.name;
        texture.name = texture.name.empty() && image.view < 0 ? data_.resource_name(image.uri) : texture.name;
        const size_t slot = slot_of[use.image];
        texture.image = --uses_left[slot] == 0 ? std::move(decoded[slot]) : decoded[slot];
    }
    return textures;
}

} // namespace estampe::gltf
