// Opening scenes and running them.
#include <map>
#include <mutex>

#include "base/path_text.h"
#include "c_library/call.h"
#include "c_library/handles.h"
#include "rainref/judging.h"
#include "rainref/version.h"

using namespace rainref;
using c_library::call;
using c_library::required;
using c_library::sized;

namespace {

/// Opens the result of `scene`, with the options' changes.
template <class Scene>
int open(const rr_open_options* options, rr_simulation** simulation, const Scene& scene) {
  return call([&] {
    required(simulation, "simulation") = nullptr;
    const rr_open_options o = options ? sized(options, "rr_open_options") : rr_open_options{sizeof o, nullptr, nullptr, 0, 0};
    *simulation =
        std::make_unique<rr_simulation>(scene(o, c_library::texts(o.set, o.set_count, "rr_open_options.set")), o.threads).release();
  });
}

}  // namespace

const char* rr_version(void) { return version(); }
uint32_t rr_golden_generation(void) { return golden_generation; }

const char* rr_effect_name(size_t index) {
  const char* name = nullptr;
  call([&] {
    static const std::vector<std::string> names = effect_names();
    if (index < names.size()) name = names[index].c_str();
  });
  return name;
}
const char* rr_profile_name(size_t index) {
  const char* name = nullptr;
  call([&] {
    static const std::vector<std::string> names = profile_names();
    if (index < names.size()) name = names[index].c_str();
  });
  return name;
}
int rr_describe(const char* effect, const char** json) {
  return call([&] {
    required(json, "json") = nullptr;
    const std::string name = &required(effect, "effect");
    static std::mutex mutex;
    static std::map<std::string, std::string> made;
    const std::lock_guard lock(mutex);
    std::string& text = made[name];
    try {
      if (text.empty()) text = describe(name);
    } catch (...) {
      made.erase(name);
      throw;
    }
    *json = text.c_str();
  });
}

int rr_keep_images(const char* folder) {
  return call([&] { keep_images(utf8_path(folder ? folder : "")); });
}
int rr_open(const char* toml, const rr_open_options* options, rr_simulation** simulation) {
  return open(options, simulation, [&](const rr_open_options& o, std::vector<std::string> set) {
    return SceneText{&required(toml, "toml"), std::move(set), o.file ? o.file : SceneText().file};
  });
}
int rr_open_file(const char* path, const rr_open_options* options, rr_simulation** simulation) {
  return open(options, simulation, [&](const rr_open_options&, std::vector<std::string> set) {
    return read_scene(utf8_path(&required(path, "path")), std::move(set));
  });
}
void rr_close(rr_simulation* simulation) {
  call([&] { delete simulation; });
}

int rr_get_info(rr_simulation* simulation, rr_simulation_info* info) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    rr_simulation_info& to = sized(info, "rr_simulation_info");
    s.scene_json = s.running.scene_json();
    to = {sizeof to,          s.running.effect().c_str(), name(s.running.variant()),   s.running.frame(),
          s.running.frames(), s.buffers.size(),           s.running.warnings().size(), s.scene_json.c_str()};
  });
}
const char* rr_warning(const rr_simulation* simulation, size_t index) {
  return simulation && index < simulation->running.warnings().size() ? simulation->running.warnings()[index].c_str() : nullptr;
}

int rr_simulate(rr_simulation* simulation) {
  return call([&] { required(simulation, "simulation").running.simulate(); });
}
int rr_render(rr_simulation* simulation) {
  return call([&] { required(simulation, "simulation").running.render(); });
}
int rr_next_frame(rr_simulation* simulation) {
  return call([&] { required(simulation, "simulation").running.next_frame(); });
}
int rr_next_frame_hashes(rr_simulation* simulation, const char** lines) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    required(lines, "lines") = nullptr;
    *lines = c_library::joined(s.running.next_frame_hashes(), s.hash_lines);
  });
}
int rr_write_png(rr_simulation* simulation, const char* path) {
  return call([&] { required(simulation, "simulation").running.write_png(utf8_path(&required(path, "path"))); });
}
int rr_write_exr(rr_simulation* simulation, const char* path) {
  return call([&] { required(simulation, "simulation").running.write_exr(utf8_path(&required(path, "path"))); });
}
