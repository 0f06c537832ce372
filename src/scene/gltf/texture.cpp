// SPDX-License-Identifier: MIT
#include "scene/gltf/convert.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <new>
#include <thread>

#include "core/image_codec.hpp"
#include "core/job_limits.hpp"
#include "core/long_jobs.hpp"
#include "core/read_scope.hpp"
#include "scene/gltf/data.hpp"

namespace estampe::gltf {
namespace {

constexpr unsigned max_threads = 4;
constexpr double textures_from = 0.1; ///< share of the file's load time before textures are decoded
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

/// Calls `work(i)` for each i below `count` on up to four threads, or on as many as can be started. At the
/// same time calls `tell(done)` on the calling thread to report progress. `tell` may throw to stop the work;
/// what `work` throws on any thread reaches the caller.
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
    std::vector<std::future<void>> helpers;
    try {
        for (size_t i = 1; i < threads; ++i) {
            helpers.push_back(std::async(launch_if_possible, [&loop, given = JobLimits::of_thread()] {
                const JobLimits limits(given);
                loop();
            }));
        }
        for (size_t i = next++; i < count; i = next++) {
            work(i);
            tell(i + 1);
        }
    } catch (...) {
        next = count; // The helpers end, too
        throw;
    }
    for (std::future<void>& helper : helpers) {
        helper.get();
    }
}

/// Returns for each image of the file the index of the first image with an equal source. Exporters often
/// write one picture for many materials. Decoding a picture of 8192 x 8192 pixels takes 256 MiB, so it is
/// decoded once.
std::vector<int> first_of_same(const Data& data)
{
    const auto& views = data.model().bufferViews;
    std::map<std::string_view, int> by_uri;
    std::map<std::tuple<int, size_t, size_t>, int> by_bytes;
    std::vector<int> first;
    for (size_t i = 0; i < data.images().size(); ++i) {
        const ImageSource& source = data.images()[i];
        const auto own = static_cast<int>(i);
        if (source.view >= 0) {
            const tinygltf::BufferView& view = views[static_cast<size_t>(source.view)];
            const bool is_plain = view.extensions.empty();
            const std::tuple bytes{is_plain ? view.buffer : -1 - source.view,
                                   is_plain ? view.byteOffset : size_t{0},
                                   is_plain ? view.byteLength : size_t{0}};
            first.push_back(by_bytes.try_emplace(bytes, own).first->second);
        } else {
            first.push_back(source.uri.empty() ? own : by_uri.try_emplace(source.uri, own).first->second);
        }
    }
    return first;
}

/// Returns the image in the file that a texture uses. Negative if no image of the texture has a supported
/// format.
int readable_image(const tinygltf::Texture& texture)
{
    const auto webp = texture.extensions.find("EXT_texture_webp");
    return webp != texture.extensions.end() ? webp->second.Get("source").GetNumberAsInt() : texture.source;
}

std::string_view unread_format(const tinygltf::Texture& texture)
{
    for (const auto& [extension, value] : texture.extensions) {
        if (const auto format = unread_picture_format(extension)) {
            return *format;
        }
    }
    return {};
}

} // namespace

TextureTable::TextureTable(Data& data) : data_(data), first_of_same_(first_of_same(data)) {}

Index TextureTable::use(int index)
{
    const tinygltf::Texture& texture = data_.model().textures[static_cast<size_t>(index)];
    const int image = readable_image(texture);
    Use use{.texture = index, .image = image < 0 ? -1 : first_of_same_[static_cast<size_t>(image)]};
    if (image < 0) {
        use.unread_format = unread_format(texture);
    }
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = data_.model().samplers[static_cast<size_t>(texture.sampler)];
        use.wrap_u = wrap_of(sampler.wrapS);
        use.wrap_v = wrap_of(sampler.wrapT);
    }
    const auto [entry, added] = index_of_.try_emplace(
        {use.image, image < 0 ? index : -1, use.wrap_u, use.wrap_v}, static_cast<Index>(uses_.size()));
    if (added) {
        uses_.push_back(use);
    }
    return entry->second;
}

bool TextureTable::is_lost(Index texture) const
{
    return texture < lost_.size() && lost_[texture];
}

TextureTable::Decoded TextureTable::decode_one(int image) const
{
    const ImageSource& source = data_.images()[static_cast<size_t>(image)];
    const std::string name = source.view >= 0 ? "" : data_.resource_name(source.uri);
    Decoded decoded;
    try {
        if (source.view < 0 && source.uri.empty()) {
            throw Error("has neither uri nor bufferView");
        }
        if (source.view >= 0) {
            decoded.image = decode_image(data_.view(source.view), name);
            return decoded;
        }
        decoded.is_missing = !is_data_uri(source.uri);
        const std::vector<std::byte> bytes = data_.resource(source.uri);
        decoded.is_missing = false;
        decoded.image = decode_image(bytes, name);
    } catch (const std::bad_alloc&) {
        throw; // Another picture for want of memory would be wrong
    } catch (const OutsideScope& error) {
        decoded.refusal = error.what();
    } catch (const std::exception& error) {
        decoded.failure = fmt::format("{}; drawn without it", error.what());
        decoded.image = white_pixel();
    }
    return decoded;
}

std::map<int, TextureTable::Decoded> TextureTable::decode_all()
{
    std::map<int, Decoded> all;
    for (const Use& use : uses_) {
        if (use.image >= 0) {
            ++all[use.image].uses_left;
        }
    }
    std::vector<std::pair<const int, Decoded>*> entries;
    entries.reserve(all.size());
    for (auto& entry : all) {
        entries.push_back(&entry);
    }
    std::atomic<uint64_t> total_pixels = 0;
    const auto decode_next = [&](size_t i) {
        auto& [image, slot] = *entries[i];
        const size_t uses = slot.uses_left;
        slot = decode_one(image);
        slot.uses_left = uses;
        total_pixels += uint64_t{slot.image.width} * slot.image.height * uses;
        if (total_pixels > max_total_pixels) {
            slot.failure =
                "the textures together are beyond the limit of 512 megapixels; drawn without this one";
            slot.image = white_pixel();
        }
    };
    for_each_in_parallel(entries.size(), decode_next, [&](size_t done) {
        const double share = static_cast<double>(done) / static_cast<double>(entries.size());
        report_progress(std::lerp(textures_from, textures_to, share));
    });
    return all;
}

void TextureTable::warn_of_unread(const Use& use)
{
    const std::string place = fmt::format("/textures/{}", use.texture);
    if (use.unread_format.empty()) {
        data_.warn(place, "has no image that can be read; drawn without it");
        return;
    }
    data_.warn(place, fmt::format("texture {} is {}, which is not read; drawn without it", use.texture,
                                  use.unread_format));
}

std::vector<Texture> TextureTable::decode(std::vector<std::string>& missing_files)
{
    std::map<int, Decoded> decoded = decode_all();
    for (const auto& [image, result] : decoded) {
        if (!result.refusal.empty()) {
            data_.fail(fmt::format("/images/{}/uri", image), result.refusal);
        }
        if (!result.failure.empty()) {
            data_.warn(fmt::format("/images/{}", image), result.failure);
        }
        if (result.is_missing) {
            missing_files.push_back(data_.resource_name(data_.images()[static_cast<size_t>(image)].uri));
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
            warn_of_unread(use);
            texture.image = white_pixel();
            lost_.push_back(true);
            continue;
        }
        const ImageSource& image = data_.images()[static_cast<size_t>(use.image)];
        texture.name = texture.name.empty() ? image.name : texture.name;
        texture.name = texture.name.empty() && image.view < 0 ? data_.resource_name(image.uri) : texture.name;
        Decoded& slot = decoded.at(use.image);
        texture.image = --slot.uses_left == 0 ? std::move(slot.image) : slot.image;
        lost_.push_back(!slot.failure.empty());
    }
    return textures;
}

} // namespace estampe::gltf
