// An opened scene, on which rainref::Simulation and the command line are built.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "effect/effect.h"
#include "image_io/notes.h"
#include "scene/config.h"
#include "scene/effect_table.h"
#include "simulation/development.h"
#include "state/file.h"
#include "truth/tracing.h"

namespace rainref::simulation {

/// The effects with all keys that their scenes may have, including those of traced pictures.
const scene::EffectTable& effect_table();
/// The configuration for packs and captures: without the keys of traced pictures, which no pass uses.
scene::Config config_of_passes(const scene::Config& config);
/// Memory of the effect, its pictures and its traced pictures.
effect::RunMemory memory_of(const scene::Config& config);

/// A running scene. Calls may come in any floating-point state.
class Opened {
 public:
  /// Refuses a scene that does not fit into memory, reads its files and builds the effect. Throws Error.
  Opened(scene::Config config, const parallel::Executor& executor);
  /// The same with another street than the one at night.
  Opened(scene::Config config, const parallel::Executor& executor, scene::MakeScenery street);

  const scene::Config& config() const { return config_; }
  const effect::Inputs& inputs() const { return inputs_; }
  const effect::Effect& effect() const { return effect_; }
  const effect::Instance& effect_now() const { return *instance_; }

  void simulate(Recorder* recorder);
  /// Also traces, if the scene asks for it.
  void render(Recorder* recorder);
  /// Replaces render: effect::Instance::skip.
  void skip(Recorder* recorder);
  void next_frame(Recorder* recorder) {
    simulate(recorder);
    render(recorder);
  }
  /// Sets whether the pictures of the following frames are wanted; unwanted ones are not traced. True at first.
  void show(bool is_shown) { is_shown_ = is_shown; }
  int frame() const { return instance_->frame(); }

  /// Writes the state of this scene, with the caller's note.
  void save(const std::string& note, const state::Sink& sink) const;
  /// Throws Error(usage) if the state is of another scene (except run.frames) or of other pictures, or does not fit; nothing has then
  /// changed.
  void load(const state::Saved& saved);
  /// The same for a scene that differs in `key`. The error names `key` if the state does not fit.
  void carry_over(const state::Saved& saved, const std::string& key);

  /// The picture, of run.size. If the passes run at a multiple of it, it is their filtered mean. With options `picture.*` it is developed
  /// from the linear picture, of the passes or traced.
  const Image& picture() const { return is_made() ? made_ : picture_of_passes(); }
  /// How display makes the picture from its linear input.
  std::optional<effect::Display> display() const;
  std::vector<PassOutput> buffers() const;
  /// Notes stored in the picture's files.
  image_io::Notes notes() const;
  std::vector<std::byte> png_bytes() const;
  /// Throws Error(io). The second also writes the maps beside the picture, once. `channel`: the only one that is written; "": all. Throws
  /// Error(usage) with the nearest name if there is none of this name.
  void write_png(const std::filesystem::path& path) const;
  void write_exr(const std::filesystem::path& path, bool with_maps, std::string_view channel = {});

  /// True if there is a traced truth to compare the passes with; makes it. Throws Error(usage) if it is impossible.
  bool has_truth();
  truth::Comparison compare_truth();

 private:
  bool is_made() const { return samples_ > 1 || development_.is_on(); }
  const Image& picture_of_passes() const { return is_traced_ ? tracing_->shown() : instance_->picture(); }

  scene::Config config_, pass_config_;  // as the scene gives it, and at the size at which the passes run
  const parallel::Executor& executor_;
  const effect::Effect& effect_;
  effect::Inputs inputs_;
  std::unique_ptr<effect::Instance> instance_;
  std::unique_ptr<truth::Tracing> tracing_;  // made at the first tracing
  bool is_traced_ = false, is_shown_ = true, has_written_maps_ = false;
  Development development_;
  int samples_ = 1;  // run.supersample
  Image made_;
};

}  // namespace rainref::simulation
