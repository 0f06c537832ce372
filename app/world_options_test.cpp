// SPDX-License-Identifier: MIT
#include "worlds.hpp"

#include <fstream>
#include <initializer_list>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "batch.hpp"
#include "drawing.hpp"
#include "options.hpp"
#include "report.hpp"
#include "support/folder.hpp"
#include "world/test_world.hpp"

namespace estampe::app {
namespace {

class AppWorlds : public testing::Test {
protected:
    AppWorlds() { worlds::test::know_box(); }

    static Command typed(std::initializer_list<const char*> words)
    {
        std::vector<const char*> all{"estampe"};
        all.insert(all.end(), words);
        return read_command_line(static_cast<int>(all.size()), all.data()).value();
    }

    static DrawOptions drawn(std::initializer_list<const char*> words)
    {
        return std::get<RenderCommand>(typed(words)).draw;
    }

    /// The error message for a wrong command line.
    static std::string refusal(std::initializer_list<const char*> words)
    {
        try {
            std::ignore = typed(words);
        } catch (const UsageError& problem) {
            return problem.what();
        }
        return "taken";
    }

    /// The error message for a wrong batch job.
    std::string refusal_of_job(const std::string& lines)
    {
        try {
            std::ignore = command_of(job(lines), {});
        } catch (const Error& problem) {
            return problem.what();
        }
        return "taken";
    }

    BatchJob job(const std::string& lines)
    {
        const std::string file = (folder_.path() / "jobs.toml").string();
        std::ofstream(file) << "[[job]]\n" << lines;
        return read_jobs(file).front();
    }

    test::Folder folder_;
};

TEST_F(AppWorlds, AreFoundByNameWhereNoFileHasIt)
{
    ASSERT_NE(world_of("box"), nullptr);
    EXPECT_EQ(world_of("box")->name, "box");
    EXPECT_EQ(world_of("bix"), nullptr);
    EXPECT_EQ(world_of("./box"), nullptr);
    EXPECT_EQ(world_of(""), nullptr);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    std::ofstream("box") << "a file";
    EXPECT_EQ(world_of("box"), nullptr) << "a file has precedence";
    std::filesystem::remove("box");
    std::filesystem::create_directory("box");
    EXPECT_NE(world_of("box"), nullptr) << "a folder is no scene";
    std::filesystem::current_path(before);
}

TEST_F(AppWorlds, UnknownNamesAreAnsweredWithWhatThereIs)
{
    const auto refused = [](const char* name) {
        try {
            std::ignore = load_scene_of({.scene = name});
        } catch (const Error& problem) {
            return std::string(problem.what());
        }
        return std::string("taken");
    };
    EXPECT_EQ(refused("boxx"), "boxx: is neither a file nor a world; did you mean the world box?");
    EXPECT_NE(refused("no-such-place").find("is neither a file nor a world; the worlds: "),
              std::string::npos);
    EXPECT_NE(refused("no-such-place").find("box"), std::string::npos);
    EXPECT_EQ(refused("nosuch.glb").find("world"), std::string::npos) << "a file is meant";
}

TEST_F(AppWorlds, OptionsGoToTheWorld)
{
    const DrawOptions draw = drawn({"render", "box", "-o", "a.png", "--world", "width=2.5"});
    EXPECT_EQ(draw.world, std::vector<std::string>{"width=2.5"});
    const Scene scene = load_scene_of(draw);
    EXPECT_EQ(scene.meshes.at(1).primitives.at(0).positions.at(1).x, 1.25F);
    EXPECT_EQ(refusal({"view", "box", "--world", "width=2"}), "taken");
    EXPECT_EQ(refusal({"info", "box", "--world", "width=2"}), "taken");
    EXPECT_EQ(refusal({"graph", "box", "-o", "a.dot", "--world", "width=2"}), "taken");
    EXPECT_EQ(refusal({"bake", "box", "-o", "a.exr", "--world", "width=2", "--seed", "3"}), "taken");
}

TEST_F(AppWorlds, MistakesInOptionsAreTold)
{
    const auto render = [](const char* scene, const char* assignment) {
        return refusal({"render", scene, "-o", "a.png", "--world", assignment});
    };
    EXPECT_EQ(render("box", "colour=red"), "--world: the world has no option \"colour\"; its options: width");
    EXPECT_EQ(render("box", "width=5"), "--world: width=5: 5 is out of range; allowed: 0.5 to 4");
    EXPECT_EQ(render("box", "5"), "--world: \"5\" is not of the form KEY=VALUE; its options: width");
    EXPECT_EQ(render("fox.glb", "width=2")
                  .find("--world: works only with a world; \"fox.glb\" is not one; the "
                        "worlds: "),
              0U);
    EXPECT_NE(render("fox.glb", "width=2").find("box"), std::string::npos);
}

TEST_F(AppWorlds, SeedIsShortForAnOptionOfThatName)
{
    worlds::Description seeded = worlds::test::box_description();
    if (worlds::registry().find("seeded-box") == nullptr) {
        seeded.name = "seeded-box";
        seeded.options.push_back({.key = "seed", .allowed = worlds::WholeRange{}, .initial = "1"});
        worlds::registry().add(seeded);
    }
    EXPECT_EQ(drawn({"render", "seeded-box", "-o", "a.png", "--seed", "7"}).world,
              drawn({"render", "seeded-box", "-o", "a.png", "--world", "seed=7"}).world);
    EXPECT_EQ(refusal({"render", "box", "-o", "a.png", "--seed", "7"}),
              "--seed: the world box has no option \"seed\"; its options: width");
    EXPECT_EQ(
        refusal({"render", "fox.glb", "-o", "a.png", "--seed", "7"}).find("--seed: works only with a world"),
        0U);
    EXPECT_EQ(refusal({"render", "seeded-box", "-o", "a.png", "--seed", "7", "--world", "seed=8"}),
              "--seed: is short for --world seed=N, which is given too; leave one of the two out");
    for (const char* const beyond : {"-1", "18446744073709551616", "1e3"}) {
        EXPECT_NE(
            refusal({"render", "seeded-box", "-o", "a.png", "--seed", beyond}).find("is not a whole number"),
            std::string::npos)
            << beyond;
    }
}

TEST_F(AppWorlds, OptionsOfTheProgramThatBelongToAWorldAreAnsweredWithHowToWriteThem)
{
    EXPECT_NE(refusal({"render", "box", "-o", "a.png", "--width", "2"}).find("; write --world width=2"),
              std::string::npos);
    EXPECT_NE(refusal({"render", "box", "-o", "a.png", "--width=2"}).find("; write --world width=2"),
              std::string::npos);
    EXPECT_NE(refusal({"view", "box", "--width"}).find("; write --world width=VALUE"), std::string::npos);
    EXPECT_NE(refusal({"view", "box", "--depht", "2"}).find("; see estampe view --help"), std::string::npos);
    EXPECT_NE(refusal({"tam", "-o", "a.tam", "--width", "2"}).find("; see estampe tam --help"),
              std::string::npos)
        << "a command that takes no world";
    EXPECT_NE(refusal({"render", "box", "--width", "2", "--size"}).find("see estampe render --help"),
              std::string::npos)
        << "another mistake comes first";
}

TEST_F(AppWorlds, OnlyAWorldWithAFilmHasAFilmOfItsOwn)
{
    EXPECT_EQ(refusal({"render", "box", "-o", "a.mp4", "--film"}), "taken");
    const std::string said = refusal({"render", "fox.glb", "-o", "a.mp4", "--film"});
    EXPECT_EQ(said.find("--film: works only with a world that has a film of its own; \"fox.glb\" has none"),
              0U);
    EXPECT_NE(said.find("box"), std::string::npos);
}

TEST_F(AppWorlds, JobsOfABatchHaveThem)
{
    const RenderCommand command =
        command_of(job("scene = \"box\"\noutput = \"a.png\"\nworld = [\"width=3\", \"width=4\"]\n"), {});
    EXPECT_EQ(command.draw.world, (std::vector<std::string>{"width=3", "width=4"}));
    EXPECT_NE(refusal_of_job("scene = \"box\"\noutput = \"a.png\"\nworld = \"depth=3\"\n")
                  .find("its options: width"),
              std::string::npos);
    EXPECT_NE(refusal_of_job("scene = \"box\"\noutput = \"a.png\"\nwidth = 3\n")
                  .find("\"width\" is an option of a world; write world = \"width=VALUE\""),
              std::string::npos);
}

TEST_F(AppWorlds, ASceneIsKeptForJobsThatAskForTheSame)
{
    const auto is_kept = [](const char* a, const char* b) {
        return load_the_same({.scene = "box", .world = {a}}, {.scene = "box", .world = {b}});
    };
    EXPECT_TRUE(is_kept("width=2", "width=2.0"));
    EXPECT_FALSE(is_kept("width=2", "width=3"));
}

TEST_F(AppWorlds, HelpListsThem)
{
    const std::string text = report_worlds(false);
    EXPECT_NE(text.find("box\n"), std::string::npos);
    EXPECT_NE(text.find("width=0.5..4: Width of the box in metres [1]"), std::string::npos);
    const nlohmann::ordered_json json = nlohmann::ordered_json::parse(report_worlds(true));
    EXPECT_EQ(json.size(), worlds::registry().all().size());
    EXPECT_TRUE(std::holds_alternative<InfoCommand>(typed({"info"}))) << "which prints the list";
}

} // namespace
} // namespace estampe::app
