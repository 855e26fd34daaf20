// The scenes that the page of `rainref view` offers.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace rainref::cli {

/// The bundled scenes, and the scene that the user named. Nothing else is served, and a scene's own files are read by the program alone.
class SceneList {
 public:
  /// `named`: as typed; `file`: what it leads to.
  SceneList(const std::string& named, const std::filesystem::path& file);

  /// The name of the user's scene in the page's address: "puddle/default.toml" if it is bundled, else the name of its file.
  const std::string& first() const { return first_; }
  /// {"scenes": [{path, effect, variant, sentence, files, keys, file}], "presets": [{name, kind, sentence, keys: {effect: [[key,
  /// value]]}}]}, as the page reads it (src/web/scene_index.mjs). `file`: what commands call it. One that cannot be read has no effect;
  /// opening it says why.
  std::string json() const;
  /// The file of a scene, by its name; "" if there is none.
  std::filesystem::path file(std::string_view name) const;

 private:
  struct Entry {
    std::filesystem::path file;
    std::string shown;
  };
  std::map<std::string, Entry, std::less<>> scenes_;
  std::string first_;
};

}  // namespace rainref::cli
