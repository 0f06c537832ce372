// SPDX-License-Identifier: MIT
#include <memory>

#include <webp/encode.h>
#include <webp/mux.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "output/pictures.hpp"

namespace estampe::output {
namespace {

struct Release {
    void operator()(WebPMux* mux) const { WebPMuxDelete(mux); }

    void operator()(WebPMemoryWriter* writer) const { WebPMemoryWriterClear(writer); }

    void operator()(WebPPicture* picture) const { WebPPictureFree(picture); }

    void operator()(WebPData* data) const { WebPDataClear(data); }
};

WebPConfig config_of(std::optional<int> quality)
{
    WebPConfig config;
    bool is_valid = false;
    if (quality) {
        is_valid = WebPConfigPreset(&config, WEBP_PRESET_DRAWING, static_cast<float>(*quality)) != 0;
        config.use_sharp_yuv = 1; // halves of colour are chosen so that thin lines keep theirs
    } else {
        constexpr int quick = 3;
        is_valid = WebPConfigInit(&config) != 0 && WebPConfigLosslessPreset(&config, quick) != 0;
        config.exact = 1;
    }
    if (!is_valid || WebPValidateConfig(&config) == 0) {
        throw Error("cannot encode WebP: the library is of another version");
    }
    return config;
}

/// The picture alone, without a profile.
void encode_frame(const Image& image, std::optional<int> quality, WebPMemoryWriter& writer)
{
    const WebPConfig config = config_of(quality);
    WebPPicture picture;
    if (WebPPictureInit(&picture) == 0) {
        throw Error("cannot encode WebP: the library is of another version");
    }
    const std::unique_ptr<WebPPicture, Release> freed(&picture);
    picture.width = static_cast<int>(image.width);
    picture.height = static_cast<int>(image.height);
    picture.use_argb = 1;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    const int stride = static_cast<int>(image.width) * 4;
    if (WebPPictureImportRGBA(&picture, image.rgba.data(), stride) == 0 ||
        WebPEncode(&config, &picture) == 0) {
        throw Error(fmt::format("cannot encode WebP: error {}", static_cast<int>(picture.error_code)));
    }
}

} // namespace

std::vector<std::byte> encode_webp(const Image& image, std::optional<int> quality)
{
    if (image.empty() || image.rgba.size() != uint64_t{image.width} * image.height * 4) {
        throw Error("an empty image cannot be written");
    }
    if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION) {
        throw Error(fmt::format("WebP holds no side of more than {} pixels, and the picture has {} x {}",
                                WEBP_MAX_DIMENSION, image.width, image.height),
                    {}, "write it as PNG, JPEG or OpenEXR");
    }
    if (quality && (*quality < 0 || *quality > 100)) {
        throw Error(fmt::format("a quality of {} is not 0 to 100", *quality));
    }
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    const std::unique_ptr<WebPMemoryWriter, Release> cleared(&writer);
    encode_frame(image, quality, writer);

    const std::unique_ptr<WebPMux, Release> mux(WebPMuxNew());
    const WebPData frame{writer.mem, writer.size};
    const std::vector<std::byte>& profile = srgb_profile();
    const WebPData icc{reinterpret_cast<const uint8_t*>(profile.data()), profile.size()};
    WebPData file;
    WebPDataInit(&file);
    const std::unique_ptr<WebPData, Release> freed(&file);
    if (!mux || WebPMuxSetImage(mux.get(), &frame, 0) != WEBP_MUX_OK ||
        WebPMuxSetChunk(mux.get(), "ICCP", &icc, 0) != WEBP_MUX_OK ||
        WebPMuxAssemble(mux.get(), &file) != WEBP_MUX_OK) {
        throw Error("cannot encode WebP: out of memory");
    }
    const auto* first = reinterpret_cast<const std::byte*>(file.bytes);
    return {first, first + file.size};
}

} // namespace estampe::output
