// SPDX-License-Identifier: MIT
#include "techniques/motion_blur/alternatives/own.hpp"

#include "shaders/blur_own_comp.hpp"

namespace estampe::motion_blur {

MotionBlurLayers add_own_blur(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page,
                              const shared::MotionBlurConstants& constants)
{
    auto pass = graph.compute("motion blur", shaders::blur_own_comp);
    pass.sample(in.wash).sample(in.hatch).sample(in.lines).sample(in.sky_ink).sample(page);
    const auto write = [&](const char* name, gpu::Format format) {
        return pass.write(
            graph.image(name, {.width = in.size_px.x, .height = in.size_px.y, .format = format}));
    };
    const gpu::ImageId wash = write("motion blur/wash", gpu::Format::rgba16f);
    const gpu::ImageId hatch = write("motion blur/hatch", gpu::Format::r16f);
    const gpu::ImageId lines = write("motion blur/lines", gpu::Format::rgba8);
    pass.variant(in.has_sky ? shared::blur_has_sky : 0U).push(constants);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return {.wash = wash, .hatch = hatch, .lines = lines};
}

} // namespace estampe::motion_blur
