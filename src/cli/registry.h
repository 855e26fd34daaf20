// The effects that this build has, behind one interface.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "capture/pass_info.h"
#include "rainref/executor.h"
#include "rainref/recorder.h"
#include "scene/effect_table.h"
#include "scene/config.h"

namespace rainref::cli {

/// A running effect.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// Advances by one frame, then renders it.
  virtual void frame(Recorder* recorder) = 0;
  /// The picture as display code, row 0 = bottom.
  virtual const Image& picture() const = 0;
  /// The layers of an EXR, top row first.
  virtual void write_exr(const std::filesystem::path& path) const = 0;
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
  /// Reads the scene's input files, which are added to `inputs`, and builds the effect.
  std::function<std::unique_ptr<Simulation>(const scene::Config&, const parallel::Executor&, std::vector<InputFile>& inputs)> make;
};

const std::vector<EffectEntry>& effects();
const EffectEntry& effect(std::string_view name);
const scene::EffectTable& effect_table();

}  // namespace rainref::cli
