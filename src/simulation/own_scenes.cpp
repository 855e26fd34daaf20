#include "simulation/own_scenes.h"

#include <algorithm>
#include <system_error>

#include "simulation/own_file.h"

namespace rainref::simulation {
namespace {

namespace fs = std::filesystem;

/// The folders `scenes`, from where that file lies: an installation may be moved. A build folder links the sources'.
std::vector<fs::path> own_folders() {
  const fs::path here = own_file().parent_path();
  std::vector<fs::path> folders;
  for (const char* from_here : {RAINREF_SCENES_FROM_PROGRAM, RAINREF_SCENES_FROM_LIBRARY, "../share/rainref/scenes"}) {
    std::error_code error;
    const fs::path folder = fs::canonical(here / from_here, error);
    if (!error && std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  }
  return folders;
}

}  // namespace

std::vector<std::string> own_scenes() {
  std::vector<std::string> found;
  for (const fs::path& folder : own_folders()) {
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, none))
      if (entry.path().extension() == ".toml") found.push_back(entry.path().lexically_relative(folder).string());
    if (!found.empty()) break;
  }
  std::sort(found.begin(), found.end());
  return found;
}

fs::path find_scene(const fs::path& named) {
  std::error_code none;
  if (named.empty() || named.is_absolute() || fs::exists(named, none)) return named;
  fs::path name = named.lexically_normal();
  if (*name.begin() == "scenes") name = name.lexically_relative("scenes");
  if (*name.begin() == "..") return named;
  if (name.extension() != ".toml") name += ".toml";
  for (const fs::path& folder : own_folders())
    if (fs::is_regular_file(folder / name, none)) return folder / name;
  return named;
}

}  // namespace rainref::simulation
