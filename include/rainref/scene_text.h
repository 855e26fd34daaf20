// A scene as text, for effects that take a whole scene rather than a struct of settings.
#pragma once

#include <string>
#include <vector>

namespace rainref {

/// What a scene file says, and changes to it. Keys, units and defaults: `rainref describe EFFECT`; every key may be left out, `effect`
/// and `variant` too: they are then the effect whose constructor takes this, and "corrected".
struct SceneText {
  std::string toml{};              ///< the text of a scene file; "": every default
  std::vector<std::string> set{};  ///< "key=value" each, as `rainref run --set` takes them: they win over the text
  std::string file = "scene";      ///< what errors call the text; files that it names lie in this one's folder
};

}  // namespace rainref
