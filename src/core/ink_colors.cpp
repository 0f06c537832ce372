// SPDX-License-Identifier: MIT
#include "core/ink_colors.hpp"

#include <memory>

#include <lcms2.h>

namespace estampe {
namespace {

struct CloseProfile {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};

struct DeleteTransform {
    void operator()(void* transform) const { cmsDeleteTransform(transform); }
};

using ColorProfile = std::unique_ptr<void, CloseProfile>;
using ColorTransform = std::unique_ptr<void, DeleteTransform>;

/// Null where the profile is damaged or of other colours.
ColorTransform transform_of(std::span<const std::byte> bytes, bool inverted)
{
    if (bytes.empty())
        return nullptr;
    const ColorProfile profile(
        cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    if (profile == nullptr || cmsGetColorSpace(profile.get()) != cmsSigCmykData)
        return nullptr;
    const ColorProfile srgb(cmsCreate_sRGBProfile());
    return ColorTransform(cmsCreateTransform(profile.get(), inverted ? TYPE_CMYK_8_REV : TYPE_CMYK_8,
                                             srgb.get(), TYPE_RGBA_8, INTENT_RELATIVE_COLORIMETRIC,
                                             cmsFLAGS_BLACKPOINTCOMPENSATION));
}

} // namespace

void inks_to_rgb(std::span<uint8_t> pixels, bool inverted, std::span<const std::byte> profile)
{
    const ColorTransform transform = transform_of(profile, inverted);
    if (transform != nullptr)
        cmsDoTransform(transform.get(), pixels.data(), pixels.data(),
                       static_cast<cmsUInt32Number>(pixels.size() / 4));
    for (size_t i = 0; i + 3 < pixels.size(); i += 4) {
        const uint32_t flip = inverted ? 0U : 255U;
        const uint32_t black = pixels[i + 3] ^ flip;
        for (size_t channel = i; transform == nullptr && channel < i + 3; ++channel)
            pixels[channel] = static_cast<uint8_t>(((pixels[channel] ^ flip) * black + 127) / 255);
        pixels[i + 3] = 255;
    }
}

} // namespace estampe
