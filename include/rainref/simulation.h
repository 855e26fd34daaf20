// Any effect, as a scene says it: one interface over all of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/scene_text.h"
#include "rainref/variant.h"

namespace rainref {

namespace scene {
class Scenery;  // src/scene/scenery.h
}

/// What an effect holds under a name: an image, or records.
using Buffer = std::variant<BufferView, RecordView>;

/// The text of a scene file, with changes to it. Where there is no such file, of the scene of this name that came with rainref
/// ("puddle/default.toml": `rainref list`). Of a PNG or EXR that rainref wrote: the scene that is in it, up to that frame. Throws Error(io)
/// when it cannot be read, Error(usage) for another picture.
SceneText read_scene(const std::filesystem::path& file, std::vector<std::string> set = {});

/// Where made images that are the same in every run (the street around a puddle) are kept for later runs, by every simulation of this
/// process; an empty path: nowhere. Without this call as `rainref run` keeps them: in $XDG_CACHE_HOME/rainref, or ~/.cache/rainref. No bit
/// hangs on it. Throws Error(usage) once a simulation was opened.
void keep_images(const std::filesystem::path& folder);

/// The street at night that scenes without pictures show, for windshield::Surroundings. clear_lane: no car stands in the lane that one
/// drives along.
std::shared_ptr<const scene::Scenery> street_at_night(std::uint64_t seed = 1, bool clear_lane = false);

/// A scene that runs. Every buffer has the same bits whatever the executor's threads, the SIMD target and the caller's floating-point
/// state, and the bits of `rainref hash` of the same scene.
class Simulation {
 public:
  /// Opens a scene; `effect` must be said in its text or in `set`, `variant` is "corrected" unless said. Its files are read, pictures
  /// that it does not name are made, and what does not fit into memory is refused first. Throws Error, naming place, key, expected and
  /// found: usage for what no scene may say and what cannot run, io for files. The executor must outlive the simulation.
  Simulation(const SceneText& scene, const parallel::Executor& executor);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  /// "puddle", ...: a name of `rainref list`.
  const std::string& effect() const;
  Variant variant() const;
  /// Every key of the scene with its value, as JSON: {"key": value, ...}.
  std::string scene_json() const;
  /// The frames that the scene asks for (run.frames). More may be simulated.
  int frames() const;
  /// What is doubtful about the scene's files, a sentence each.
  const std::vector<std::string>& warnings() const;

  /// To the next frame: 0, 1, 2 ... Nothing is rendered.
  void simulate(Recorder* recorder = nullptr);
  /// The frame that was simulated last; a traced picture of it where the scene wants one. Once for each frame at most where textures have
  /// a past (windshield).
  void render(Recorder* recorder = nullptr);
  /// Both: one call for each frame of a film.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }
  /// In place of render, once for a frame, where its picture is not wanted: what render would leave for later frames, whose pictures are
  /// the same. To come to frame n quickly: simulate and skip the frames before it.
  void skip(Recorder* recorder = nullptr);
  /// Frames simulated so far.
  int frame() const;

  /// What is held between frames: load() into a simulation of the same scene goes on with the same bits, whatever it did before. Without
  /// pictures: these come with the next render.
  std::vector<std::byte> save() const;
  /// Throws Error(usage) for bytes that are no state, damaged, of another golden generation, of another scene (run.frames may differ),
  /// of other pictures, or with numbers that cannot be; the simulation then is as it was.
  void load(std::span<const std::byte> state);
  /// Gives a key of the scene another value, as TOML writes it ("rain.rate", "30"), from the next frame on: save, rebuild, load. Each
  /// texel and each drop keeps its numbers, the frame its number. Throws Error as the constructor does, and Error(usage) naming the key
  /// where the state does not fit the new scene: effect, variant, sizes, storage, fewer drops than there are; the simulation then is
  /// as it was.
  void set(const std::string& key, const std::string& value);

  /// The picture that was rendered last: rgba8 display code, row 0 = bottom.
  const Image& picture() const;
  /// Names of what is held between frames, in the order of the passes: those of `rainref describe`.
  std::vector<std::string> buffers() const;
  /// One of them, row 0 = bottom, valid until the next call that is not const: planes and strides of an image, or records. Throws
  /// Error(usage) with the nearest name.
  Buffer buffer(std::string_view name) const;

  /// The picture, 8 bits RGB. Throws Error(io); nothing half-written stays.
  void write_png(const std::filesystem::path& path) const;
  /// Radiance and what belongs to it as named channels, half and float as the effect stores them. Throws like write_png.
  void write_exr(const std::filesystem::path& path) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref
