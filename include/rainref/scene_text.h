// A scene as text, for effects that take a whole scene instead of a struct of settings.
#pragma once

#include <string>
#include <vector>

namespace rainref {

/// The text of a scene file and changes to it. Keys, units and defaults: `rainref describe EFFECT`. Every key may be left out. The default
/// of `effect` is the effect that is constructed from this text. The default of `variant` is "corrected".
struct SceneText {
  std::string toml{};              ///< the text of a scene file; "": all defaults
  std::vector<std::string> set{};  ///< "key=value" each, as for `rainref run --set`; overrides the text
  std::string file = "scene";      ///< name of the text in errors; the scene's file names are relative to its folder
};

}  // namespace rainref
