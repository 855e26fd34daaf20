// Any effect by name, through the one interface over all of them: opened from parameters, advanced, rendered, its buffers read.
#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include "rainref/error.h"
#include "rainref/simulation.h"

using namespace rainref;

namespace {

void tell(const std::string& effect, std::vector<std::string> keys, const parallel::Executor& executor) {
  keys.insert(keys.end(), {"effect=" + effect, "run.size=[32, 18]"});
  Simulation scene({.set = keys}, executor);
  scene.simulate();
  scene.next_frame();
  std::printf("%s %d:", scene.effect().c_str(), scene.frame());
  for (const std::string& name : scene.buffers()) {
    const auto held = scene.buffer(name);
    if (const auto* image = std::get_if<BufferView>(&held))
      std::printf(" %s=%dx%d", name.c_str(), image->width(), image->height());
    else
      std::printf(" %s=%s", name.c_str(), std::get<RecordView>(held).record_bytes > 0 ? "records" : "nothing");
  }
  std::printf("\n");
  scene.write_png(effect + ".png");
}

}  // namespace

int main() try {
  const parallel::Executor executor(2);
  tell("puddle", {"environment.width=64"}, executor);  // the street around, as coarse as pictures this small need it
  tell("windshield", {"scene.size=[64, 36]"}, executor);
  for (const char* effect : {"edge_splash", "screen_drops", "rainy_glass"}) tell(effect, {}, executor);
  Simulation({.set = {"effect=pudle"}}, executor);
  return 1;
} catch (const Error& e) {
  std::printf("%d %s\n", static_cast<int>(e.code()), e.what());
  return e.code() == ExitCode::usage ? 0 : 1;
}
