// The options of `rainref view`.
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "cli/option_values.h"
#include "cli/scene_flags.h"
#include "cli/verbs.h"
#include "cli/view/view.h"

namespace rainref::cli {

Verb view_verb(CLI::App& app) {
  struct Flags {
    SceneFlags scene;
    std::optional<std::string> port;
    bool opens_browser = true;
  };
  CLI::App& verb = *app.add_subcommand("view", "Show a scene live in a browser on this machine, with a slider for each parameter");
  const auto f = std::make_shared<Flags>();
  add_scene_flags(verb, f->scene, false);
  verb.get_option("SCENE")->required(false);
  verb.add_flag("!--no-browser", f->opens_browser, "Open no browser, only print the address");
  verb.add_option("--port", f->port, "Port at 127.0.0.1 (default: a free one)")->type_name("N");
  verb.footer(
      "The page is served to this machine alone, at an address that nobody can guess. Without SCENE it shows puddle/default.toml, and "
      "without\n"
      "--size pictures of 640x360.\n"
      "Example: rainref view puddle/default.toml --preset storm --set rain.rate=20\n"
      "On a machine without a screen, by ssh -L 8000:127.0.0.1:8000: rainref view puddle/default.toml --no-browser --port 8000");
  return {&verb, [f] {
            ViewRequest request;
            if (f->scene.scene.empty()) f->scene.scene = "puddle/default.toml";
            request.named = f->scene.scene;
            request.presets = f->scene.presets;
            request.set = f->scene.set;
            if (!f->scene.size) f->scene.size = request.size;
            request.scene = resolve(f->scene);
            request.size = *f->scene.size;
            if (f->port) request.port = whole_number(*f->port, "--port", 1, 65535);
            request.opens_browser = f->opens_browser;
            view(request);
            return 0;
          }};
}

}  // namespace rainref::cli
