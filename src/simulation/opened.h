// A scene that runs, for programs of rainref itself: what rainref::Simulation and the command line stand on.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "effect/effect.h"
#include "image_io/notes.h"
#include "scene/config.h"
#include "scene/effect_table.h"
#include "simulation/development.h"
#include "state/file.h"
#include "truth/tracing.h"

namespace rainref::simulation {

/// The effects with everything that their scenes may say, traced pictures included.
const scene::EffectTable& effect_table();
/// The configuration without the keys of traced pictures, which no pass takes: what packs and captures hold.
scene::Config config_of_passes(const scene::Config& config);
/// What the effect, its pictures and what is traced of it take.
effect::RunMemory memory_of(const scene::Config& config);

/// Calls may come in any floating-point state.
class Opened {
 public:
  /// Refuses what does not fit into memory, reads the scene's files and builds the effect. Throws Error.
  Opened(scene::Config config, const parallel::Executor& executor);
  /// The same before another street than the one at night.
  Opened(scene::Config config, const parallel::Executor& executor, scene::MakeScenery street);

  const scene::Config& config() const { return config_; }
  const effect::Inputs& inputs() const { return inputs_; }
  const effect::Effect& effect() const { return effect_; }

  void simulate(Recorder* recorder);
  /// Traces too, where the scene wants it.
  void render(Recorder* recorder);
  /// In place of render: effect::Instance::skip.
  void skip(Recorder* recorder);
  void next_frame(Recorder* recorder) {
    simulate(recorder);
    render(recorder);
  }
  /// Whether the pictures of the frames to come are wanted; tracing is left out of those that are not. True at first.
  void show(bool is_shown) { is_shown_ = is_shown; }
  int frame() const { return instance_->frame(); }

  /// What is held between frames, of this scene, with whatever the caller adds.
  void save(const std::string& note, const state::Sink& sink) const;
  /// Throws Error(usage) where the state is of another scene than this, run.frames aside, of other pictures, or does not fit; then nothing
  /// has changed.
  void load(const state::Saved& saved);
  /// The same of a scene that differs in `key`, which is named where its state does not fit.
  void carry_over(const state::Saved& saved, const std::string& key);

  /// Of run.size: where the passes run at a multiple of it, the filtered mean of theirs; with options `picture.*` developed from the linear
  /// one, traced or of the passes.
  const Image& picture() const { return is_made() ? made_ : picture_of_passes(); }
  /// What picture the passes' display makes of which linear one.
  std::optional<effect::Display> display() const;
  std::vector<PassOutput> buffers() const;
  /// What the files of the picture say of it.
  image_io::Notes notes() const;
  std::vector<std::byte> png_bytes() const;
  /// Throws Error(io); the second one also writes, once, the maps beside the picture.
  void write_png(const std::filesystem::path& path) const;
  void write_exr(const std::filesystem::path& path, bool with_maps);

  /// Whether there is a traced truth to compare the passes with; it is then made. Throws Error(usage) for one that cannot be.
  bool has_truth();
  truth::Comparison compare_truth();

 private:
  bool is_made() const { return samples_ > 1 || development_.is_on(); }
  const Image& picture_of_passes() const { return is_traced_ ? tracing_->shown() : instance_->picture(); }

  scene::Config config_, pass_config_;  // as the scene says, and at the size that passes run at
  const parallel::Executor& executor_;
  const effect::Effect& effect_;
  effect::Inputs inputs_;
  std::unique_ptr<effect::Instance> instance_;
  std::unique_ptr<truth::Tracing> tracing_;  // made when something is traced
  bool is_traced_ = false, is_shown_ = true, has_written_maps_ = false;
  Development development_;
  int samples_ = 1;  // run.supersample
  Image made_;
};

}  // namespace rainref::simulation
