// The runs that are expected of a port's own simulation: their passes, the inputs of each, and where the inputs come from.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pack_read.h"
#include "capture/pass_info.h"

namespace rainref::judge {

/// An expected run of a pass. Its arrays have shape and levels, but no values.
struct PlannedRun {
  capture::PassCase c;                    ///< c.uniforms: the reference's
  std::vector<std::string> input_hashes;  ///< content_hash() of the reference's inputs
  /// Paths of inputs and uniforms in a manifest, which several runs may share: relative to the folder, inputs without extension, one for
  /// each mip level; none and "" if the manifest names none.
  std::vector<std::vector<std::string>> input_stems;
  std::string uniform_file;
};

/// Hash of an array's shape and values.
std::string content_hash(const capture::Array& array);
/// Copies one mip level to an image of its own.
capture::Array level_of(const capture::Array& array, int level);

struct ShadowPlan {
  std::string effect, variant, scene;
  std::vector<capture::PackPass> passes;  ///< in the order of execution
  std::vector<capture::PackEdge> edges;
  std::vector<PlannedRun> runs;  ///< in the order of execution
  std::set<int> frames;          ///< frames whose runs are all known
  /// True if `runs` is complete for these frames; else a port may have dumped other frames too.
  bool from_scene = false;
  /// Inputs for which is_given() holds, by content_hash(), if the plan is from a scene. They take no more memory than the port's own on
  /// disk.
  std::map<std::string, capture::Array> given;

  /// Makes a plan from a manifest beside the dumps: each of its cases is expected. With `shares_files`, inputs and uniforms may be in the
  /// manifest's files; else each run has its own.
  static ShadowPlan of_manifest(const capture::Pack& pack, bool shares_files);
  /// Makes a plan for a run of a scene; all cases of the frames must be passed to add().
  static ShadowPlan of_effect(const capture::EffectInfo& effect, const std::string& variant, const std::string& scene);
  void add(const capture::PassCase& run, const capture::EffectInfo& effect);
  /// Takes the paths of files that runs share from a manifest beside the dumps. Throws Error(usage) if it is of another effect or variant.
  void take_files(const ShadowPlan& manifest);

  const PlannedRun* find(std::string_view id) const;
  /// First run of a pass, or null.
  const PlannedRun* example(std::string_view pass) const;
  /// Source of an input; null if the graph does not name it.
  const capture::PackEdge* edge(std::string_view pass, std::string_view input) const;
  /// True if the host gives an input: no pass writes it, or it is part of the initial state.
  bool is_given(const PlannedRun& run, std::string_view input) const;
  /// "the scene" or "the manifest": the source of the expected host values.
  const char* source_word() const { return from_scene ? "the scene" : "the manifest"; }
  /// The run whose output an input is; null if the host gives it, or if that run is in a frame that is not known. A pass that runs once for
  /// each mip level writes each level in another run; `level` selects one.
  const PlannedRun* source(const PlannedRun& run, std::string_view input, int level = 0) const;
};

/// A dumped run of a pass: its folder is `id`.
struct DumpedRun {
  std::string id, pass;
  int frame = 0, step = 0, level = -1;
};
/// Finds the runs in a port's folder: in the given order of passes, then by frame, step and level. Throws Error(port_files) for a folder of
/// another pass of the effect, or with an invalid name.
std::vector<DumpedRun> dumped_runs(const std::filesystem::path& folder, const std::string& effect, const std::vector<std::string>& passes);

}  // namespace rainref::judge
