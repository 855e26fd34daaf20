#include "base/path_text.h"
#include "rainref/simulation.h"

#include <mutex>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/floating_point.h"
#include "base/read_file.h"
#include "cache/kept_images.h"
#include "cache/prepared.h"
#include "capture/hashing.h"
#include "night_street/night_street.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "scene/json.h"
#include "simulation/describe.h"
#include "simulation/opened.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"
#include "simulation/simulation_state.h"

namespace rainref {
namespace {

/// Whether keep_images was called, and whether a simulation has been opened, after which it may not be called.
struct Keeping {
  std::mutex mutex{};
  bool is_said = false, has_begun = false;
};
Keeping& keeping() {
  static Keeping one;
  return one;
}

/// Limit of a process's cache of prepared data [byte]. The default puddle at 1280x720, with the largest sky, takes 0.3 GiB.
constexpr std::size_t remembered_bytes = std::size_t{1} << 29;

/// Called before a Simulation is opened, by any thread. From the first call on prepared data are cached, and images are kept in the folder
/// of keep_images, or else in that of the command line.
void begin_to_keep() {
  const std::lock_guard lock(keeping().mutex);
  if (std::exchange(keeping().has_begun, true)) return;
  if (!keeping().is_said) cache::keep_in(cache::folder_of_user());
  cache::remember(remembered_bytes);
}

}  // namespace

void keep_images(const std::filesystem::path& folder) {
  const FloatingPointGuard guard;
  const std::lock_guard lock(keeping().mutex);
  if (keeping().has_begun)
    throw Error(ExitCode::usage, "keep_images: expected a call before the first simulation is opened, found one that was opened");
  cache::keep_in(folder.empty() ? folder : std::filesystem::absolute(folder));
  keeping().is_said = true;
}

SceneText read_scene(const std::filesystem::path& file, std::vector<std::string> set) {
  const FloatingPointGuard guard;
  const std::filesystem::path found = simulation::find_scene(file);
  if (auto scene = simulation::scene_of_picture(found)) return {std::move(scene->toml), std::move(set), path_text(found)};
  std::vector<std::byte> bytes;
  try {
    bytes = read_file(found);
  } catch (const Error& e) {
    std::error_code none;
    if (e.code() != ExitCode::io || std::filesystem::exists(found, none)) throw;
    throw Error(e.code(), e.what() + simulation::did_you_mean_scene(file));
  }
  return {std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), std::move(set), path_text(found)};
}

std::vector<std::string> effect_names() {
  const FloatingPointGuard guard;
  std::vector<std::string> names;
  for (const effect::Effect* e : registry::effects()) names.push_back(e->name);
  return names;
}
std::string describe(const std::string& effect) {
  const FloatingPointGuard guard;
  return simulation::describe_json(effect);
}

std::shared_ptr<const scene::Scenery> street_at_night(std::uint64_t seed, bool clear_lane) {
  const FloatingPointGuard guard;
  return night_street::Street::make({seed, clear_lane});
}

Simulation::Simulation(const SceneText& scene, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  begin_to_keep();
  state_ = std::make_unique<State>(scene, executor);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

const std::string& Simulation::effect() const { return state_->opened.config().effect(); }
Variant Simulation::variant() const {
  const FloatingPointGuard guard;
  return variant_from_name(state_->opened.config().variant());
}
const SceneText& Simulation::scene_text() const { return state_->scene; }
std::string Simulation::scene_json() const {
  const FloatingPointGuard guard;
  return scene::config_json(state_->opened.config()).dump(2);
}
int Simulation::frames() const {
  const FloatingPointGuard guard;
  return static_cast<int>(state_->opened.config().integer("run.frames"));
}
const std::vector<std::string>& Simulation::warnings() const { return state_->opened.inputs().warnings; }

void Simulation::simulate(Recorder* recorder) {
  const FloatingPointGuard guard;
  state_->opened.simulate(recorder);
}
void Simulation::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  state_->opened.render(recorder);
}
void Simulation::skip(Recorder* recorder) {
  const FloatingPointGuard guard;
  state_->opened.skip(recorder);
}

std::vector<std::string> Simulation::next_frame_hashes() {
  const FloatingPointGuard guard;
  capture::HashRecorder recorder;
  state_->opened.next_frame(&recorder);
  std::vector<std::string> lines;
  for (const capture::HashLine& line : recorder.take_lines()) lines.push_back(line.text());
  return lines;
}

std::vector<std::byte> Simulation::save() const {
  const FloatingPointGuard guard;
  return state_->save();
}
void Simulation::load(std::span<const std::byte> state) {
  const FloatingPointGuard guard;
  state_->opened.load(state::Saved(state, "state"));
}
void Simulation::set(const std::string& key, const std::string& value) {
  const FloatingPointGuard guard;
  // "key=value" would be split at its first =.
  if (const std::size_t at = key.find('='); at != std::string::npos)
    throw Error(ExitCode::usage, fmt::format("'{}': expected a key such as {}, found one with =", key, key.substr(0, at)));
  SceneText changed = state_->scene;
  std::erase_if(changed.set, [&](const std::string& s) { return s.starts_with(key + "="); });
  changed.set.push_back(key + "=" + value);
  auto next = std::make_unique<State>(std::move(changed), state_->executor);
  for (const std::string& kept : {std::string("effect"), std::string("variant")}) {
    const std::string &before = state_->opened.config().text(kept), &after = next->opened.config().text(kept);
    if (before != after)
      throw Error(ExitCode::usage,
                  fmt::format("{}: cannot change while the simulation runs: expected \"{}\", found \"{}\"", key, before, after));
  }
  const std::vector<std::byte> bytes = state_->save();
  next->opened.carry_over(state::Saved(bytes, "state"), key);
  state_ = std::move(next);
}

int Simulation::frame() const { return state_->opened.frame(); }

const Image& Simulation::picture() const { return state_->opened.picture(); }
std::vector<std::string> Simulation::buffers() const {
  const FloatingPointGuard guard;
  std::vector<std::string> names;
  for (const PassOutput& b : state_->opened.buffers()) names.emplace_back(b.name);
  return names;
}
Buffer Simulation::buffer(std::string_view name) const {
  const FloatingPointGuard guard;
  std::vector<std::string> names;
  for (const PassOutput& b : state_->opened.buffers()) {
    if (b.name == name) return b.content;
    names.emplace_back(b.name);
  }
  throw Error(ExitCode::usage, fmt::format("{} has no buffer '{}'{}", effect(), name, did_you_mean(name, names)));
}

void Simulation::write_png(const std::filesystem::path& path) const {
  const FloatingPointGuard guard;
  state_->opened.write_png(path);
}
void Simulation::write_exr(const std::filesystem::path& path) const {
  const FloatingPointGuard guard;
  state_->opened.write_exr(path, false);
}

}  // namespace rainref
