// What a port's own run should look like: which runs of which passes, what each takes and from where.
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

/// A run of a pass as it should be. Its arrays have shape and levels, but no values.
struct PlannedRun {
  capture::PassCase c;                    ///< c.uniforms: the reference's
  std::vector<std::string> input_hashes;  ///< content_hash() of the reference's inputs
  /// Where a manifest says that inputs and uniforms lie, which may be shared with other runs: paths below the folder,
  /// those of inputs without their extension, one for each mip level; none and "" where none says.
  std::vector<std::vector<std::string>> input_stems;
  std::string uniform_file;
};

/// A hash of an array's shape and values.
std::string content_hash(const capture::Array& array);
/// One mip level as an image of its own.
capture::Array level_of(const capture::Array& array, int level);

struct ShadowPlan {
  std::string effect, variant, scene;
  std::vector<capture::PackPass> passes;  ///< in the order of execution
  std::vector<capture::PackEdge> edges;
  std::vector<PlannedRun> runs;  ///< in the order of execution
  std::set<int> frames;          ///< whose runs are all known
  /// Whether `runs` is all that there can be in these frames; else a port may have dumped other frames too.
  bool from_scene = false;
  /// By content_hash(): the inputs that is_given() names, of a scene. They take no more memory than the port's own on disk.
  std::map<std::string, capture::Array> given;

  /// From a manifest that lies beside the dumps: each of its cases should be there. With `shares_files` inputs and
  /// uniforms may lie where the manifest says, else each run has all of its own.
  static ShadowPlan of_manifest(const capture::Pack& pack, bool shares_files);
  /// For a run of the scene, whose cases go to add(), every case of the frames in question.
  static ShadowPlan of_effect(const capture::EffectInfo& effect, const std::string& variant, const std::string& scene);
  void add(const capture::PassCase& run, const capture::EffectInfo& effect);
  /// Where files lie that a manifest beside the dumps shares between runs. Error(usage) when it is of another effect or
  /// variant.
  void take_files(const ShadowPlan& manifest);

  const PlannedRun* find(std::string_view id) const;
  /// The first run of a pass, or null.
  const PlannedRun* example(std::string_view pass) const;
  /// Where an input comes from; null for one that the graph does not name.
  const capture::PackEdge* edge(std::string_view pass, std::string_view input) const;
  /// Whether the host gives an input: no pass writes it, or it is the state that the run begins with.
  bool is_given(const PlannedRun& run, std::string_view input) const;
  /// "the scene" or "the manifest": what says what a host is to give.
  const char* source_word() const { return from_scene ? "the scene" : "the manifest"; }
  /// The run whose output an input is, or null: it is the host's, or the run lies in frames that are not known. A pass that
  /// runs once for each mip level gives each level of its input by a run of its own; `level` asks for one.
  const PlannedRun* source(const PlannedRun& run, std::string_view input, int level = 0) const;
};

/// A run of a pass that a port dumped: its folder is `id`.
struct DumpedRun {
  std::string id, pass;
  int frame = 0, step = 0, level = -1;
};
/// The runs in a port's folder, pass by pass in the order given, then by frame, step and level. Throws Error(port_files)
/// for a folder of another pass of the effect, or of a run without a proper name.
std::vector<DumpedRun> dumped_runs(const std::filesystem::path& folder, const std::string& effect, const std::vector<std::string>& passes);

}  // namespace rainref::judge
