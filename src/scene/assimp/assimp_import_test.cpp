// SPDX-License-Identifier: MIT
#include "scene/importers.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe {
namespace {

class AssimpImport : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    Scene load(const std::string& name, const std::string& content) const
    {
        return load_with_assimp(write(name, content));
    }

    void expect_error(const std::string& name, const std::string& content) const
    {
        try {
            const Scene scene = load(name, content);
            ADD_FAILURE() << name << " was read: " << scene.meshes.size() << " meshes";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }

    test::Folder folder_;
};

TEST_F(AssimpImport, MissingFileIsNamed)
{
    try {
        (void)load_with_assimp(folder_ / "absent.dae");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("absent.dae"), std::string::npos);
    }
    EXPECT_THROW((void)load_with_assimp(folder_.path()), Error);
}

TEST_F(AssimpImport, BrokenFbxAndDaeFiles)
{
    expect_error("empty.fbx", "");
    expect_error("noise.fbx", "Kaydara FBX Binary  \x00\x1a\x00 and then nothing of use");
    expect_error("empty.dae", "");
    expect_error("cut.dae", "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><library_geometries>");
    expect_error("hollow.dae", "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"></COLLADA>");
}

} // namespace
} // namespace estampe
