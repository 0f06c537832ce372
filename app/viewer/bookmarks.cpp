// SPDX-License-Identifier: MIT
#include "viewer/bookmarks.hpp"

#include <cmath>
#include <span>

#include <estampe/error.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "core/file.hpp"

namespace estampe::viewer {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* remedy = "mend it, or remove it to begin anew";

Json to_json(const glm::dvec3& vector)
{
    return Json::array({vector.x, vector.y, vector.z});
}

double number_of(const Json& json)
{
    const double number = json.get<double>();
    constexpr double most = 1e15;
    if (!(std::abs(number) < most)) {
        throw Error("holds a number out of all bounds");
    }
    return number;
}

glm::dvec3 to_vector(const Json& json)
{
    if (json.size() != 3) {
        throw Error("holds a place that has not three numbers");
    }
    return {number_of(json.at(0)), number_of(json.at(1)), number_of(json.at(2))};
}

Bookmark to_bookmark(const Json& json)
{
    Bookmark bookmark{.name = json.at("name").get<std::string>()};
    bookmark.camera.eye = to_vector(json.at("eye"));
    bookmark.camera.target = to_vector(json.at("target"));
    bookmark.camera.up = to_vector(json.at("up"));
    bookmark.camera.vertical_fov_rad = glm::radians(number_of(json.at("fov_deg")));
    bookmark.camera.near_m = number_of(json.at("near_m"));
    if (json.contains("half_height_m")) {
        bookmark.camera.orthographic_half_height_m = number_of(json.at("half_height_m"));
    }
    bookmark.time_s = number_of(json.at("time_s"));
    bookmark.animation = json.at("animation").get<Index>();
    return bookmark;
}

Json to_json(const Bookmark& bookmark)
{
    Json json;
    json["name"] = bookmark.name;
    json["eye"] = to_json(bookmark.camera.eye);
    json["target"] = to_json(bookmark.camera.target);
    json["up"] = to_json(bookmark.camera.up);
    json["fov_deg"] = glm::degrees(bookmark.camera.vertical_fov_rad);
    json["near_m"] = bookmark.camera.near_m;
    if (bookmark.camera.orthographic_half_height_m) {
        json["half_height_m"] = *bookmark.camera.orthographic_half_height_m;
    }
    json["time_s"] = bookmark.time_s;
    json["animation"] = bookmark.animation;
    return json;
}

} // namespace

std::filesystem::path bookmarks_path(const std::filesystem::path& scene)
{
    std::filesystem::path path = scene;
    path += ".views.json";
    return path;
}

std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20U;
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) {
        return {};
    }
    const std::vector<std::byte> bytes = read_file(path, largest_bytes);
    const auto* first = reinterpret_cast<const char*>(bytes.data());
    std::vector<Bookmark> bookmarks;
    try {
        const Json json = Json::parse(first, first + bytes.size());
        for (const Json& item : json.at("views")) {
            bookmarks.push_back(to_bookmark(item));
        }
    } catch (const nlohmann::json::exception& error) {
        throw Error(std::string("is no file of bookmarks: ") + error.what(), path.string(), remedy);
    } catch (const Error& error) {
        throw Error(error.what(), path.string(), remedy);
    }
    return bookmarks;
}

void save_bookmarks(const std::vector<Bookmark>& bookmarks, const std::filesystem::path& path)
{
    if (bookmarks.empty()) {
        std::error_code problem;
        std::filesystem::remove(path, problem);
        return;
    }
    Json json;
    json["views"] = Json::array();
    for (const Bookmark& bookmark : bookmarks) {
        json["views"].push_back(to_json(bookmark));
    }
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    write_file_atomically(path, std::as_bytes(std::span(text)));
}

} // namespace estampe::viewer
