#include "simulation/picture_notes.h"

#include <array>
#include <fstream>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/hashing.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "scene/toml.h"
#include "scene/value_text.h"

namespace rainref::simulation {
namespace {

constexpr const char* scene_key = "rainref:scene";
constexpr const char* generation_key = "rainref:golden_generation";

bool names_file(const scene::Config::Entry& e) {
  const auto* text = std::get_if<std::string>(&e.value);
  return text && !text->empty() && e.parameter.type == scene::Type::text && effect::names_files(e.parameter.key);
}

std::string scene_text(const scene::Config& config, int frame) {
  std::string out;
  for (const scene::Config::Entry& e : config.entries()) {
    const std::string& key = e.parameter.key;
    // A picture does not depend on the number of frames after it.
    if (key == "run.frames")
      out += fmt::format("{} = {}\n", key, frame + 1);
    else if (names_file(e))
      out += fmt::format("{} = {}\n", key, scene::value_text(path_text(utf8_path(std::get<std::string>(e.value)).filename())));
    else if (e.parameter.is_required || key == "effect" || key == "variant" || key == "seed" ||
             e.value != e.parameter.default_in(config.variant()))
      out += fmt::format("{} = {}\n", key, scene::value_text(e.value));
  }
  return out;
}

Hash128 scene_hash(const scene::Config& config, const effect::Inputs& inputs) {
  Hasher hasher;
  for (const scene::Config::Entry& e : config.entries())
    if (e.parameter.key != "run.frames" && !names_file(e))
      hasher.add(fmt::format("{} = {}\n", e.parameter.key, scene::value_text(e.value)));
  hasher.add(inputs_text(inputs));
  return hasher.finish();
}

/// Throws if a file name in the scene has a folder. rainref writes none, so someone else wrote this note, perhaps to make the user open a
/// file that the writer may not read.
void refuse_folders(const std::string& scene, const std::string& picture) {
  for (const scene::RawEntry& e : scene::read_toml(scene, picture)) {
    const auto* text = std::get_if<std::string>(&e.value.data);
    if (!text || path_text(utf8_path(*text).filename()) == *text) continue;
    throw Error(ExitCode::usage,
                fmt::format("'{}': {}: expected the name of a file beside the picture, as rainref writes it there, found {}", picture,
                            e.key, e.value.text()));
  }
}

}  // namespace

std::string inputs_text(const effect::Inputs& inputs) {
  std::string text;
  for (const effect::InputFile& f : inputs.files) text += fmt::format("{} {} {} {}\n", f.key, f.hash, f.first, f.count);
  return text;
}

image_io::Notes picture_notes(const scene::Config& config, const effect::Inputs& inputs, int frame, const Image& picture) {
  return {{"rainref:version", version()},
          {generation_key, std::to_string(golden_generation)},
          {"rainref:effect", config.effect()},
          {"rainref:variant", config.variant()},
          {"rainref:seed", std::to_string(config.integer("seed"))},
          {"rainref:frame", std::to_string(frame)},
          {scene_key, scene_text(config, frame)},
          {"rainref:scene_hash", scene_hash(config, inputs).text()},
          {"rainref:picture_hash", capture::hash_of(picture).text()}};
}

std::optional<SceneOfPicture> scene_of_picture(const std::filesystem::path& file) {
  std::array<char, 8> first{};
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return std::nullopt;  // the reader of the scene reports the error
  std::ifstream(file, std::ios::binary).read(first.data(), first.size());
  if (!image_io::may_have_notes(std::as_bytes(std::span(first)))) return std::nullopt;
  const std::vector<std::byte> bytes = read_file(file);
  const std::string name = fmt::format("'{}'", path_text(file));
  std::optional<std::string> scene = image_io::find_note(name, bytes, scene_key);
  if (!scene)
    throw Error(
        ExitCode::usage,
        fmt::format("{}: expected a scene, or a picture with the scene in it as rainref writes them; found a picture without", name));
  refuse_folders(*scene, path_text(file));
  return SceneOfPicture{std::move(*scene), image_io::find_note(name, bytes, generation_key).value_or("")};
}

std::string scene_text(const std::filesystem::path& file) {
  if (auto made = scene_of_picture(file)) return std::move(made->toml);
  return scene::read_scene(file);
}

}  // namespace rainref::simulation
