// `rainref view`: the live page (src/web/pages), served to a browser on this machine; its scene runs in this program.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"

namespace rainref::cli {

struct ViewRequest {
  SceneOptions scene;                ///< what the page opens; --size, --preset and --set are its overrides
  std::string named;                 ///< the scene as typed
  std::string size = "640x360";      ///< of the picture
  std::vector<std::string> presets;  ///< names, or lists of them
  std::vector<std::string> set;      ///< "key=value"
  int port = 0;                      ///< 0: any free one
  bool opens_browser = true;
};

/// Prints the address and serves until the process ends. Throws Error.
[[noreturn]] void view(const ViewRequest& request);

}  // namespace rainref::cli
