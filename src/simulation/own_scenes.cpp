#include "simulation/own_scenes.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "base/path_text.h"
#include "image_io/codec_folder.h"
#include "rainref/error.h"
#include "base/code_file.h"

namespace rainref::simulation {
namespace {

namespace fs = std::filesystem;

/// The folders of that name, relative to the location of this code's file, because an installation may be moved. A build folder links to
/// the scenes of the sources.
std::vector<fs::path> own_folders(const std::string& name = "scenes") {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& here, const char* from_here) {
    std::error_code error;
    const fs::path folder = fs::canonical((here / utf8_path(from_here)).parent_path() / utf8_path(name), error);
    if (!error && std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  };
  constexpr const char* from_any = "../share/rainref/scenes";
  const fs::path here = code_file().parent_path();
  for (const char* from_here : {RAINREF_SCENES_FROM_PROGRAM, RAINREF_SCENES_FROM_LIBRARY, from_any}) add(here, from_here);
  if (const fs::path module = utf8_path(image_io::codec_folder()); !module.empty())
    for (const char* from_here : {RAINREF_SCENES_FROM_MODULE, from_any}) add(module, from_here);
  return folders;
}

std::vector<std::string> scenes_below(const fs::path& root) {
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(root, fs::directory_options::skip_permission_denied, none))
    if (entry.path().extension() == ".toml") found.push_back(path_text(entry.path()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<std::string> own_scenes() {
  for (const fs::path& folder : own_folders()) {
    std::vector<std::string> found = scenes_below(folder);
    for (std::string& file : found) file = path_text(utf8_path(file).lexically_relative(folder));
    if (!found.empty()) return found;
  }
  return {};
}

fs::path own_scene(const fs::path& named) {
  if (named.empty() || named.is_absolute()) return {};
  fs::path name = named.lexically_normal();
  if (*name.begin() == "scenes") name = name.lexically_relative("scenes");
  if (*name.begin() == "..") return {};
  if (name.extension() != ".toml") name += ".toml";
  std::error_code none;
  for (const fs::path& folder : own_folders())
    if (fs::is_regular_file(folder / name, none)) return folder / name;
  return {};
}

fs::path own_data(const std::string& name) {
  const std::vector<fs::path> folders = own_folders(name);
  return folders.empty() ? fs::path() : folders.front();
}

fs::path find_scene(const fs::path& named) {
  std::error_code none;
  if (fs::exists(named, none)) return named;
  fs::path own = own_scene(named);
  return own.empty() ? named : own;
}

std::vector<std::string> known_scenes() {
  std::vector<std::string> found = scenes_below("scenes");
  return found.empty() ? own_scenes() : found;
}

std::string did_you_mean_scene(const fs::path& wrong) {
  std::vector<std::string> names, files;  // the compared names, and their files
  const auto add = [&](std::string name, const std::string& file) {
    names.push_back(std::move(name));
    files.push_back(file);
  };
  std::error_code none;
  const fs::path beside = wrong.parent_path();
  std::vector<std::string> siblings;
  for (const auto& entry : fs::directory_iterator(beside.empty() ? "." : beside, none)) {
    if (entry.path().extension() == ".toml") siblings.push_back(path_text(beside / entry.path().filename()));
  }
  std::sort(siblings.begin(), siblings.end());
  for (const std::string& file : siblings) add(file, file);
  for (const std::string& file : known_scenes()) {
    add(file, file);
    // "puddle/default.toml", "scenes/puddle/default.toml", in any folder; "default.toml" alone would match any effect's.
    const fs::path path = utf8_path(file), in_effect = path.parent_path().filename() / path.filename();
    add(path_text(in_effect), file);
    add(path_text("scenes" / in_effect), file);
  }
  const std::string near = nearest_name(path_text(wrong.lexically_normal()), names);
  if (near.empty()) return "";
  return fmt::format("; did you mean '{}'?", files[static_cast<std::size_t>(std::find(names.begin(), names.end(), near) - names.begin())]);
}

}  // namespace rainref::simulation
