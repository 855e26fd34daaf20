// One interface to all effects: it runs the effect that a scene names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
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

/// A named buffer of an effect: an image, or records.
using Buffer = std::variant<BufferView, RecordView>;

/// Names of the effects, in the order of `rainref list`: "puddle", ...
std::vector<std::string> effect_names();
/// Returns the output of `rainref describe EFFECT --json`: parameters with units, ranges and defaults; passes; buffers; layouts. Throws
/// Error(usage) with the nearest effect.
std::string describe(const std::string& effect);

/// A callback that learns how much is done, and the total. It may throw to stop the work: the caller gets the exception, and no partial
/// file stays.
using Progress = std::function<void(int done, int of)>;

/// Options of Simulation::film.
struct FilmOptions {
  int frames = 0;       ///< number of frames to simulate; 0: the remaining frames of run.frames
  int every = 1;        ///< the film shows the frames whose number is a multiple of this
  Progress progress{};  ///< called after each frame; may be null
};

/// Reads a scene file and adds changes to it. If there is no such file, reads the bundled scene with that name (`rainref list`). From a PNG
/// or EXR that rainref wrote it reads the stored scene, up to that frame. Throws Error(io) if the file cannot be read, and Error(usage) for
/// another picture.
SceneText read_scene(const std::filesystem::path& file, std::vector<std::string> set = {});

/// Sets the folder where this process keeps generated images that are the same in every run, such as the street around a puddle. An empty
/// path: it keeps none. Without this call the folder is that of `rainref run`: $XDG_CACHE_HOME/rainref, or ~/.cache/rainref. Does not
/// affect results. Throws Error(usage) once a simulation has been opened.
void keep_images(const std::filesystem::path& folder);

/// Returns the street at night, which scenes without pictures show, for windshield::Surroundings. clear_lane: no car stands in the lane of
/// the camera's car.
std::shared_ptr<const scene::Scenery> street_at_night(std::uint64_t seed = 1, bool clear_lane = false);

/// A running scene. The bits of every buffer do not depend on the number of threads, the SIMD target or the caller's floating-point state.
/// `rainref hash` prints the hashes of the same bits.
class Simulation {
 public:
  /// Opens a scene. Its text or `set` must give `effect`; `variant` defaults to "corrected". Refuses a scene that does not fit into memory.
  /// Then reads the scene's files, and generates the pictures that the scene does not name. Throws Error with the place, the key, what was
  /// expected and what was found: usage for an invalid scene or one that cannot run, io for files. The executor must outlive the
  /// simulation.
  Simulation(const SceneText& scene, const parallel::Executor& executor);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  /// "puddle", ...: a name of `rainref list`.
  const std::string& effect() const;
  Variant variant() const;
  /// The text of the scene with all changes so far. A new simulation of this text begins as this one would begin now.
  const SceneText& scene_text() const;
  /// Every key of the scene with its value, as JSON: {"key": value, ...}.
  std::string scene_json() const;
  /// Number of frames that the scene asks for (run.frames). More may be simulated.
  int frames() const;
  /// Sentences about doubtful properties of the scene's files.
  const std::vector<std::string>& warnings() const;

  /// Simulates the next frame (0, 1, 2 ...) without rendering it.
  void simulate(Recorder* recorder = nullptr);
  /// Renders the last simulated frame, by ray tracing if the scene asks for it. Call it at most once for each frame if textures carry over
  /// between frames (windshield).
  void render(Recorder* recorder = nullptr);
  /// Does both: one call for each frame of an animation.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }
  /// Simulates and renders the next frame, and returns the lines of `rainref hash`: "frame pass buffer hash".
  std::vector<std::string> next_frame_hashes();
  /// Call it instead of render for a frame whose picture is not needed. It updates only what later frames need, so their pictures stay the
  /// same. To reach frame n quickly, simulate and skip the frames before it.
  void skip(Recorder* recorder = nullptr);
  /// Frames simulated so far.
  int frame() const;

  /// Returns the state kept between frames. After load() a simulation of the same scene continues with the same bits, whatever it did
  /// before. The state holds no pictures; the next render makes them.
  std::vector<std::byte> save() const;
  /// Loads a state. Throws Error(usage) if the bytes are not a state, are damaged, hold impossible numbers, or belong to another golden
  /// generation, another scene (run.frames may differ) or other pictures. The simulation is then unchanged.
  void load(std::span<const std::byte> state);
  /// Changes the value of a key from the next frame on. The value is written as in TOML: ("rain.rate", "30"). Texels, drops and the frame
  /// number stay: the state is saved, the simulation rebuilt, and the state loaded. Throws Error as the constructor does. Throws
  /// Error(usage) with the key if the state does not fit the new scene: effect, variant, sizes, storage, fewer drops than exist. The
  /// simulation is then unchanged.
  void set(const std::string& key, const std::string& value);

  /// The last rendered picture: rgba8 display code, row 0 = bottom.
  const Image& picture() const;
  /// Names of the buffers kept between frames, in the order of the passes, as in `rainref describe`.
  std::vector<std::string> buffers() const;
  /// Returns one of these buffers: planes and strides of an image with row 0 at the bottom, or records. Valid until the next non-const
  /// call. Throws Error(usage) with the nearest name.
  Buffer buffer(std::string_view name) const;

  /// Writes the picture as 8-bit RGB. Throws Error(io); no partial file stays.
  void write_png(const std::filesystem::path& path) const;
  /// Writes radiance and its auxiliary images as named channels, in half or float as the effect stores them. Throws like write_png.
  void write_exr(const std::filesystem::path& path) const;
  /// Simulates the next frames and writes a film of them, like `rainref run --film`. ffmpeg makes the film: .mp4, .webm or .gif, with
  /// run.fps / every pictures a second. The last frame is rendered in any case. Throws Error(usage) for the name or the rate, or if there
  /// is no frame to show. Throws Error(io) if ffmpeg is missing or fails. The film appears whole or not at all.
  void film(const std::filesystem::path& path, const FilmOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref
