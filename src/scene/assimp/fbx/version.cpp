// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/version.hpp"

#include <fstream>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "scene/assimp/fbx/tree.hpp"

namespace estampe::fbx {

void check_version(const std::filesystem::path& path)
{
    constexpr uint32_t oldest = 7100;
    std::vector<char> head(8192);
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<size_t>(file.gcount()));
    const uint32_t version = file_version(head);
    if (version == 0 || version >= oldest)
        return;
    throw Error(fmt::format("is FBX {}.{}, a version of 2010 or before; FBX 7.1 (2011) and later are read",
                            version / 1000, version / 100 % 10),
                path.string(),
                "convert it with Autodesk's FBX Converter, or export it again from its program");
}

} // namespace estampe::fbx
