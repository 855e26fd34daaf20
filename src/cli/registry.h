// The effects that this build has, behind one interface.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "capture/pass_info.h"
#include "cli/run_memory.h"
#include "rainref/executor.h"
#include "rainref/recorder.h"
#include "scene/effect_table.h"
#include "scene/config.h"

namespace rainref::cli {

/// A running effect.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// Advances by one frame, then renders it, whatever floating-point state the caller has.
  void frame(Recorder* recorder);
  /// Whether the pictures of the frames to come are wanted; tracing is left out of those that are not. True at first.
  virtual void show(bool) {}
  /// The picture as display code, row 0 = bottom.
  virtual const Image& picture() const = 0;
  /// The layers of an EXR, top row first.
  virtual void write_exr(const std::filesystem::path& path) const = 0;
  /// Whether there is a traced truth to compare the passes with.
  virtual bool has_truth() const { return false; }
  /// Compares the rendered frame with it and writes pictures of the differences, whose names begin with `stem`; gives the numbers.
  virtual nlohmann::ordered_json compare_truth(const std::filesystem::path& stem);

 private:
  virtual void advance(Recorder* recorder) = 0;
};

/// A file that a scene named, as it was decoded.
struct InputFile {
  std::string key, path, decoded_hash;
  bool lossy;
};

struct EffectEntry {
  std::string name;
  std::vector<std::string> variants;
  std::span<const scene::Parameter> parameters;
  const capture::EffectInfo* info;
  /// Reads the scene's input files, which are added to `inputs`, and builds the effect, whatever floating-point state the caller has.
  std::function<std::unique_ptr<Simulation>(const scene::Config&, const parallel::Executor&, std::vector<InputFile>& inputs)> make;
  /// What that takes, and the frames of the run. `make` refuses what does not fit.
  RunMemory (*memory)(const scene::Config&) = nullptr;
};

/// The name under which a simulation reports what it traced; no pass of an effect, so no pack holds it.
inline constexpr std::string_view traced_pass = "compositor";
/// The configuration without the keys of traced pictures, which no pass takes: what packs and captures hold.
scene::Config config_of_passes(const scene::Config& config);

const std::vector<EffectEntry>& effects();
const EffectEntry& effect(std::string_view name);
const scene::EffectTable& effect_table();

}  // namespace rainref::cli
