// SPDX-License-Identifier: MIT
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "scene/importers.hpp"
#include "scene/obj/obj_materials.hpp"
#include "support/folder.hpp"
#include "support/imported.hpp"

namespace estampe {
namespace {

using test::all_warnings;

using obj::MtlMaterial;

std::vector<MtlMaterial> parse(const std::string& text)
{
    Input input(std::as_bytes(std::span(text)), "test.mtl");
    return obj::parse_mtl(input);
}

TEST(Mtl, ColorsAndShares)
{
    const std::vector<MtlMaterial> materials =
        parse("Kd 1 1 1\nnewmtl dark  oak \n\tKd 0.25 0.5 0.75\nKe 1 2 3\nd -halo 0.5\nTr 0.1\nPr 0.3\nPm 1\n"
              "Ka 1 1 1\nKs 1 1 1\nNs 10\nillum 2\nnewmtl grey\nkd 0.5\nnewmtl odd\nKd spectral x.rfl\nd\n");
    ASSERT_EQ(materials.size(), 3U);
    EXPECT_EQ(materials[0].name, "dark  oak");
    EXPECT_EQ(materials[0].diffuse, glm::vec3(0.25F, 0.5F, 0.75F));
    EXPECT_EQ(materials[0].emissive, glm::vec3(1, 2, 3));
    EXPECT_EQ(materials[0].dissolve, 0.5);
    EXPECT_EQ(materials[0].transparency, 0.1);
    EXPECT_EQ(materials[0].roughness, 0.3);
    EXPECT_EQ(materials[0].metallic, 1.0);
    EXPECT_EQ(materials[1].diffuse, glm::vec3(0.5F));
    EXPECT_FALSE(materials[2].diffuse);
    EXPECT_FALSE(materials[2].dissolve);
}

TEST(Mtl, OptionsComeBeforeAFileNameWithBlanks)
{
    const MtlMaterial material =
        parse("newmtl m\nmap_Kd -blendu on -s 2 3 1 -o 0.5 -clamp on -mm 0 1 my old wood.png\n"
              "map_Bump -bm 0.25 -imfchan r bump.png\nmap_d -s 4 4 4 -1.png\n"
              "norm \"C:\\my maps\\n.png\"\nmap_Ke 3\n")
            .at(0);
    EXPECT_EQ(material.diffuse_map.file, "my old wood.png");
    EXPECT_EQ(material.diffuse_map.scale, glm::dvec2(2, 3));
    EXPECT_EQ(material.diffuse_map.offset, glm::dvec2(0.5, 0));
    EXPECT_TRUE(material.diffuse_map.clamps);
    EXPECT_EQ(material.bump_map.file, "bump.png");
    EXPECT_EQ(material.bump_map.bump, 0.25);
    EXPECT_EQ(material.dissolve_map.file, "-1.png");
    EXPECT_EQ(material.normal_map.file, "\"C:\\my maps\\n.png\"");
    EXPECT_EQ(material.emissive_map.file, "3");
}

class MtlImport : public testing::Test {
protected:
    void write(const std::string& name, const std::string& content) const
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << content;
    }

    /// Writes a picture of one colour.
    void paint(const std::string& name, uint32_t side, std::array<uint8_t, 4> color) const
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        Image image{.width = side, .height = side, .rgba = {}};
        for (uint32_t i = 0; i < side * side; ++i)
            image.rgba.insert(image.rgba.end(), color.begin(), color.end());
        save_png(image, folder_ / name);
    }

    Scene load(const std::string& library_line, const std::string& material = "m") const
    {
        write("test.obj", library_line + "\nusemtl " + material +
                              "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
        return load_obj(folder_ / "test.obj");
    }

    Scene load_material(const std::string& statements) const
    {
        write("test.mtl", "newmtl m\n" + statements);
        return load("mtllib test.mtl");
    }

    test::Folder folder_;
};

const Material& first_material(const Scene& scene)
{
    return scene.materials.at(scene.meshes.at(0).primitives.at(0).material);
}

const Image& picture(const Scene& scene, const TextureRef& texture)
{
    return scene.textures.at(texture.texture).image;
}

TEST_F(MtlImport, MaterialsAsTheyWereBefore)
{
    EXPECT_EQ(first_material(load_material("Kd 0.2 0.4 0.6\nd 0.5\n")).alpha_mode, AlphaMode::blend);
    EXPECT_EQ(first_material(load_material("Kd 0.2 0.4 0.6\nd 0.5\n")).base_color,
              glm::vec4(0.2F, 0.4F, 0.6F, 0.5F));
    EXPECT_EQ(first_material(load_material("Kd 1 1 1\nTr 0.75\n")).base_color.w, 0.25F);
    EXPECT_EQ(first_material(load_material("Kd 1 1 1\nTr 1\nd 1\n")).alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(first_material(load_material("Ns 5\n")).base_color, glm::vec4(0.6F, 0.6F, 0.6F, 1.0F));
    EXPECT_EQ(first_material(load_material("Ns 5\n")).metallic, 0.0F);
    EXPECT_EQ(first_material(load_material("Ns 5\n")).roughness, 1.0F);
    EXPECT_EQ(first_material(load_material("Pr 0.25\nPm 0.5\n")).roughness, 0.25F);
    const Scene hidden = load_material("d 0\n");
    EXPECT_EQ(first_material(hidden).base_color.w, 1.0F);
    EXPECT_NE(all_warnings(hidden).find("opacity 0 would hide it"), std::string::npos);
}

TEST_F(MtlImport, LibrariesAndPicturesAreAmongTheFilesRead)
{
    write_file_atomically(folder_ / "oak.png", encode_png({.width = 1, .height = 1, .rgba = {1, 2, 3, 255}}));
    const Scene scene = load_material("map_Kd oak.png\nmap_Ke missing.png\n");
    std::set<std::string> names;
    for (const std::filesystem::path& file : scene.files)
        names.insert(file.filename().string());
    EXPECT_TRUE(names.contains("oak.png"));
    EXPECT_EQ(std::ranges::count_if(names, [](const std::string& name) { return name.ends_with(".mtl"); }),
              1);
    EXPECT_EQ(names.size(), scene.files.size()) << "each once";
    EXPECT_FALSE(names.contains("missing.png"));
}

TEST_F(MtlImport, MissingLibrariesAndMaterialsAreNamed)
{
    const Scene scene = load("mtllib nowhere.mtl");
    EXPECT_NE(all_warnings(scene).find("\"nowhere.mtl\" is not there"), std::string::npos);
    EXPECT_EQ(scene.missing_files, std::vector<std::string>{"nowhere.mtl"});
    EXPECT_EQ(scene.warnings.size(), 1U);
    EXPECT_EQ(first_material(scene).name, "m") << "styles address it all the same";
    write("other.mtl", "newmtl other\n");
    EXPECT_NE(
        all_warnings(load("mtllib other.mtl", "oak")).find("material \"oak\" is in no material library"),
        std::string::npos);
    EXPECT_NE(all_warnings(load("", "oak")).find("\"oak\""), std::string::npos);
}

TEST_F(MtlImport, LibrariesAreFoundAsTheyAreNamed)
{
    write("Materials/My Wood.MTL", "newmtl m\nKd 0 0 1\n");
    write("second.mtl", "newmtl n\nKd 0 1 0\n");
    for (const char* const line :
         {"mtllib materials/my wood.mtl", "mtllib \"materials\\my wood.mtl\"",
          "mtllib Materials/My Wood.MTL second.mtl", "mtllib second.mtl materials/my wood.mtl",
          "mtllib second.mtl\nmtllib ./Materials/My Wood.MTL"}) {
        const Scene scene = load(line);
        EXPECT_EQ(first_material(scene).base_color, glm::vec4(0, 0, 1, 1)) << line;
        EXPECT_EQ(all_warnings(scene), "") << line;
    }
    write("test.mtl", "newmtl m\nKd 1 0 0\n");
    EXPECT_EQ(first_material(load("mtllib renamed.mtl")).base_color, glm::vec4(1, 0, 0, 1))
        << "the library of the file's own name";
}

TEST_F(MtlImport, TexturesAreFoundBesideEitherFile)
{
    paint("maps/Leaf.PNG", 2, {9, 9, 9, 255});
    paint("library/bark.png", 3, {9, 9, 9, 255});
    paint("stone.png", 4, {9, 9, 9, 255});
    const auto side = [this](const std::string& name) {
        write("library/l.mtl", "newmtl m\nmap_Kd " + name + "\n");
        const Scene scene = load("mtllib library/l.mtl");
        EXPECT_EQ(all_warnings(scene), "") << name;
        return picture(scene, first_material(scene).base_color_texture).width;
    };
    EXPECT_EQ(side("maps/leaf.png"), 2U);
    EXPECT_EQ(side("bark.png"), 3U);
    EXPECT_EQ(side("C:\\somewhere\\STONE.png"), 4U);
    EXPECT_EQ(side("/home/ann/maps/leaf.png"), 2U);
    EXPECT_EQ(side("\"bark.png\""), 3U);
}

TEST_F(MtlImport, AMissingTextureIsNamedOnceAndLeftWhite)
{
    const Scene scene = load_material("Kd 0 0 0\nmap_Kd C:\\old\\wood.png\nmap_d C:\\old\\wood.png\n");
    EXPECT_EQ(first_material(scene).base_color, glm::vec4(1.0F));
    EXPECT_EQ(picture(scene, first_material(scene).base_color_texture),
              (Image{.width = 1, .height = 1, .rgba = {255, 255, 255, 255}}));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("wood.png"), std::string::npos);
    EXPECT_EQ(first_material(scene).alpha_mode, AlphaMode::opaque);
}

TEST_F(MtlImport, OpacityGoesIntoTheAlphaOfTheColors)
{
    paint("color.png", 2, {200, 100, 50, 255});
    paint("hole.png", 4, {0, 0, 0, 255});
    paint("alpha.png", 2, {10, 10, 10, 128});
    const Scene holes = load_material("map_Kd color.png\nmap_d hole.png\n");
    EXPECT_EQ(first_material(holes).alpha_mode, AlphaMode::mask);
    const Image& image = picture(holes, first_material(holes).base_color_texture);
    EXPECT_EQ(image.width, 4U);
    EXPECT_EQ(image.rgba.at(0), 200);
    EXPECT_EQ(image.rgba.at(3), 0) << "black is a hole";
    const Scene alpha = load_material("map_d alpha.png\n");
    EXPECT_EQ(picture(alpha, first_material(alpha).base_color_texture).rgba.at(3), 128) << "alpha goes first";
    EXPECT_EQ(picture(alpha, first_material(alpha).base_color_texture).rgba.at(0), 255);
}

TEST_F(MtlImport, NormalsAndHeights)
{
    paint("normal.png", 2, {128, 128, 255, 255});
    const Scene normals = load_material("map_Bump -bm 0.5 normal.png\n");
    EXPECT_EQ(picture(normals, first_material(normals).normal_texture).rgba.at(2), 255);
    EXPECT_EQ(first_material(normals).normal_scale, 0.5F);
    EXPECT_FALSE(normals.meshes.at(0).primitives.at(0).tangents.empty());
    // A ramp that rises to the right.
    Image ramp{.width = 4, .height = 1, .rgba = {}};
    for (const uint8_t height : std::array<uint8_t, 4>{0, 60, 120, 180})
        ramp.rgba.insert(ramp.rgba.end(), {height, height, height, 255});
    save_png(ramp, folder_ / "ramp.png");
    const Scene heights = load_material("bump -clamp on ramp.png\n");
    const Image& made = picture(heights, first_material(heights).normal_texture);
    EXPECT_LT(made.rgba.at(4), 100) << "leans to the left";
    EXPECT_NEAR(made.rgba.at(5), 128, 1);
    EXPECT_GT(made.rgba.at(6), 200);
    EXPECT_EQ(first_material(load_material("bump nowhere.png\n")).normal_texture.texture, no_index);
}

TEST_F(MtlImport, TexturesAreScaledAndMovedFromTheBottom)
{
    paint("wood.png", 2, {1, 2, 3, 255});
    const Scene scene = load_material("map_Kd -s 2 4 -o 0.25 0.125 wood.png\n");
    const glm::mat3& transform = first_material(scene).base_color_texture.uv_transform;
    const glm::vec2 in_file(0.3F, 0.6F);
    const glm::vec3 turned_over = transform * glm::vec3(in_file.x, 1.0F - in_file.y, 1.0F);
    EXPECT_NEAR(turned_over.x, 2.0F * in_file.x + 0.25F, 1e-6F);
    EXPECT_NEAR(turned_over.y, 1.0F - (4.0F * in_file.y + 0.125F), 1e-6F);
    EXPECT_EQ(scene.textures.at(0).wrap_u, Wrap::repeat);
}

TEST_F(MtlImport, EmissionIsRead)
{
    paint("glow.png", 2, {255, 200, 0, 255});
    EXPECT_EQ(first_material(load_material("Ke 0.5 0 0\n")).emissive, glm::vec3(0.5F, 0, 0));
    const Scene scene = load_material("map_Ke glow.png\n");
    EXPECT_EQ(first_material(scene).emissive, glm::vec3(1.0F));
    EXPECT_EQ(picture(scene, first_material(scene).emissive_texture).width, 2U);
    EXPECT_EQ(first_material(load_material("map_Ke nowhere.png\n")).emissive, glm::vec3(0.0F))
        << "a white picture would make it glow all over";
}

TEST_F(MtlImport, OnePictureServesSeveralTextures)
{
    paint("wood.png", 2, {1, 2, 3, 255});
    const Scene scene = load_material("map_Kd wood.png\nmap_Ke -clamp on ./WOOD.png\nbump wood.png\n");
    ASSERT_EQ(scene.textures.size(), 3U);
    EXPECT_EQ(scene.textures[0].image, scene.textures[1].image);
    EXPECT_EQ(scene.textures[1].wrap_v, Wrap::clamp);
    EXPECT_EQ(picture(scene, first_material(scene).normal_texture).rgba.at(2), 255) << "flat";
    write("test.mtl", "newmtl m\nmap_Kd wood.png\nnewmtl n\nmap_Kd Wood.png\n");
    EXPECT_EQ(load("mtllib test.mtl").textures.size(), 1U);
}

TEST_F(MtlImport, PipesAndDevicesAreNotWaitedFor)
{
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder_ / "endless");
    std::filesystem::create_directory(folder_ / "folder");
    for (const std::string name : {"pipe", "endless", "folder", "/dev/zero", "../../../../../dev/zero",
                                   "../../../../../proc/kmsg", "/proc/self/mem", "/etc/passwd"}) {
        std::filesystem::remove(folder_ / "test.mtl"); // it would be read in place of the missing library
        EXPECT_NE(all_warnings(load("mtllib " + name)).find("is not there"), std::string::npos) << name;
        const Scene painted = load_material("map_Kd " + name + "\n");
        EXPECT_EQ(picture(painted, first_material(painted).base_color_texture).width, 1U) << name;
        EXPECT_EQ(painted.warnings.size(), 1U) << name;
    }
}

} // namespace
} // namespace estampe
