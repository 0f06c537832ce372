// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/tree.hpp"

#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/assimp/fbx/document.hpp"

namespace estampe::fbx {
namespace {

template <typename Number>
std::string bytes_of(Number number)
{
    return {reinterpret_cast<const char*>(&number), sizeof number};
}

std::string text_value(const std::string& text)
{
    return "S" + bytes_of(static_cast<uint32_t>(text.size())) + text;
}

/// Builds a binary FBX file with offsets of 32 or 64 bits.
class Binary {
public:
    explicit Binary(uint32_t version) : wide_(version >= 7500)
    {
        file_ = std::string("Kaydara FBX Binary  \0\x1a\0", 23) + bytes_of(version);
    }

    void open(const std::string& name, uint32_t count, const std::string& values)
    {
        starts_.push_back(file_.size());
        const auto word = [this](uint64_t value) {
            return wide_ ? bytes_of(value) : bytes_of(static_cast<uint32_t>(value));
        };
        file_ += word(0) + word(count) + word(values.size());
        file_ += static_cast<char>(name.size());
        file_ += name + values;
    }

    void close(bool has_children)
    {
        if (has_children)
            end_list();
        const auto end = static_cast<uint64_t>(file_.size());
        std::memcpy(file_.data() + starts_.back(), &end, wide_ ? 8 : 4);
        starts_.pop_back();
    }

    void end_list() { file_.append(wide_ ? 25 : 13, '\0'); }

    [[nodiscard]] const std::string& bytes() const { return file_; }

private:
    std::string file_;
    std::vector<size_t> starts_;
    bool wide_;
};

std::string sample(uint32_t version)
{
    Binary file(version);
    file.open("Objects", 0, "");
    file.open("Geometry", 1, "L" + bytes_of(int64_t{7}));
    file.open("Vertices", 1,
              "d" + bytes_of(uint32_t{3}) + bytes_of(uint32_t{1}) + bytes_of(uint32_t{4}) + "zlib");
    file.close(false);
    file.close(true);
    file.open("Model", 3,
              "L" + bytes_of(int64_t{1} << 40) + text_value(std::string("box\0\1Model", 10)) +
                  text_value("Mesh"));
    file.open("Properties70", 0, "");
    file.open("P", 7,
              text_value("PreRotation") + text_value("Vector3D") + text_value("Vector") + text_value("") +
                  "D" + bytes_of(1.5) + "I" + bytes_of(int32_t{-2}) + "F" + bytes_of(0.25F));
    file.close(false);
    file.close(true);
    file.close(true);
    file.close(true);
    file.end_list();
    return file.bytes();
}

TEST(FbxTree, BothBinaryFormsAreRead)
{
    for (const uint32_t version : {7400U, 7700U}) {
        std::string file = sample(version);
        const Tree tree = read_tree(file);
        EXPECT_EQ(tree.version, version);
        const Document document = read_document(tree);
        ASSERT_EQ(document.models.size(), 1U);
        const auto& [id, model] = *document.models.begin();
        EXPECT_EQ(id, int64_t{1} << 40);
        EXPECT_EQ(model.name, "box");
        EXPECT_EQ(model.properties.vector("PreRotation"), glm::dvec3(1.5, -2.0, 0.25));
        hide_pivots(tree, file);
        EXPECT_EQ(read_document(read_tree(file)).models.begin()->second.properties.vector("PreRotation"),
                  std::nullopt);
        EXPECT_EQ(file.size(), sample(version).size());
    }
}

TEST(FbxTree, TextIsRead)
{
    const std::string file =
        "; FBX 7.3.0 project file\n"
        "FBXHeaderExtension:  {\n\tFBXVersion: 7300\n\tCreator: \"a; b { c\"\n}\n"
        "Objects:  {\n\tGeometry: 1, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *3 {\n\t\t\ta: "
        "1,2,\n3\n\t\t}\n\t}\n"
        "\tModel: 12, \"Model::it\", \"Camera\" { ; a comment }\n\t\tProperties70:  {\n"
        "\t\t\tP: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A+\",-1e2,+2.5,3\n"
        "\t\t\tP: \"text\", \"KString\", \"\", \"\", \"x\"\n\t\t}\n\t\tShading: Y\n\t}\n}\n"
        "Connections:  {\n\n\tC: \"OO\",12,0\n}\n";
    const Tree tree = read_tree(file);
    EXPECT_EQ(tree.version, 7300U);
    const Document document = read_document(tree);
    EXPECT_EQ(document.creator, "a; b { c");
    EXPECT_EQ(document.roots, std::vector<int64_t>{12});
    const Model& model = document.models.at(12);
    EXPECT_EQ(model.name, "it");
    EXPECT_EQ(model.properties.vector("Lcl Translation"), glm::dvec3(-100.0, 2.5, 3.0));
    EXPECT_EQ(model.properties.text("text"), "x");
}

TEST(FbxTree, TemplatesAreWhatObjectsDoNotSay)
{
    const std::string file =
        "Definitions:  {\nObjectType: \"Model\" {\nPropertyTemplate: \"FbxNode\" {\nProperties70:  {\n"
        "P: \"RotationActive\", \"bool\", \"\", \"\",0\nP: \"RotationOrder\", \"enum\", \"\", "
        "\"\",3\n}\n}\n}\n}\n"
        "Objects:  {\nModel: 1, \"Model::a\", \"Null\" {\nProperties70:  {\n"
        "P: \"RotationActive\", \"bool\", \"\", \"\",1\n}\n}\n}\n";
    const Properties properties = read_document(read_tree(file)).models.at(1).properties;
    EXPECT_EQ(properties.number("RotationActive"), 1.0);
    EXPECT_EQ(properties.number("RotationOrder"), 3.0);
    EXPECT_TRUE(properties.sets("RotationActive"));
    EXPECT_FALSE(properties.sets("RotationOrder"));
}

TEST(FbxTree, CutFilesAreRefusedOrReadAsFarAsTheyGo)
{
    for (const std::string& whole : {sample(7400), sample(7500)})
        for (size_t size = 0; size < whole.size(); ++size) {
            std::string cut = whole.substr(0, size);
            cut.shrink_to_fit();
            try {
                (void)read_document(read_tree(cut));
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find("damaged"), std::string::npos);
            }
        }
}

TEST(FbxTree, WrongBytesAreRefusedOrRead)
{
    std::mt19937 random(1);
    for (const std::string& whole : {sample(7400), sample(7500)})
        for (int i = 0; i < 20000; ++i) {
            std::string other = whole;
            for (int k = 0; k < 2; ++k)
                other[27 + random() % (other.size() - 27)] = static_cast<char>(random());
            try {
                const Tree tree = read_tree(other);
                (void)read_document(tree);
                hide_pivots(tree, other);
            } catch (const Error&) {
                continue;
            }
        }
}

TEST(FbxTree, NestingHasALimit)
{
    std::string text = "Objects: {\nModel: 1 {\n";
    for (int i = 0; i < 100000; ++i)
        text += "a: {\n";
    EXPECT_THROW((void)read_tree(text), Error);
    Binary deep(7400);
    for (int i = 0; i < 100; ++i)
        deep.open("GlobalSettings", 0, "");
    for (int i = 0; i < 100; ++i)
        deep.close(true);
    EXPECT_THROW((void)read_tree(deep.bytes()), Error);
}

TEST(FbxTree, VersionsAreFound)
{
    const auto version = [](const std::string& text) { return file_version(text); };
    EXPECT_EQ(version("FBXHeaderExtension:  {\nFBXVersion: 6100\n"), 6100U);
    EXPECT_EQ(version("; FBX 7.1.0 project file\n"), 7100U);
    EXPECT_EQ(version(sample(7500)), 7500U);
    EXPECT_EQ(version("Kaydara FBX"), 0U);
    EXPECT_EQ(version("FBXVersion: soon"), 0U);
    EXPECT_EQ(version(""), 0U);
}

} // namespace
} // namespace estampe::fbx
