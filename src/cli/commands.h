// The verbs of the command line. Each returns an exit code or throws Error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/validate_reports.h"

namespace rainref::cli {

/// Options that `run`, `hash` and `pack` share.
struct SceneOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< of --set, then of --frames and --size
  int threads = 0;                     ///< 0: one for each processor
};

struct RunOptions {
  SceneOptions scene;
  std::filesystem::path output;  ///< empty: out/<name of the scene>
  std::filesystem::path film;    ///< of the frames from `first` on, each K-th with `every`; empty: none
  int first = 0;                 ///< frames before it are simulated and not rendered
  int every = 0;                 ///< 0: the last frame only
  int checkpoint_every = 0;      ///< frames between states that a killed run can go on from; 0: none
  bool overwrite = false;        ///< what an earlier run left in the folder goes
  bool resume = false;           ///< from such a state, where there is one
  bool png = true, exr = false;
  bool json = false;
  bool keep_images = true;     ///< what default scenes begin with, in the user's cache folder
  bool compare_truth = false;  ///< against the traced truth, on the frames that are written
  enum Capture : std::uint8_t { none, passes, all } capture = none;
};

struct PackOptions {
  SceneOptions scene;
  std::filesystem::path output;
  std::vector<int> frames;          ///< ascending
  bool may_add_frames = false;      ///< of passes that a port which does nothing passes in these
  std::vector<std::string> passes;  ///< empty: every pass of the variant
  bool shows_coverage = false;      ///< lists what of each pass's text no case takes
};

/// `pack --spirv`.
struct ForeignPackOptions {
  std::filesystem::path effect, inputs, output;
  int threads = 0;
};

struct ValidateRequest {
  std::filesystem::path pack, port;
  std::filesystem::path shadow;  ///< dumps of a port's own run, judged instead of `port`; "": a pack is judged
  SceneOptions scene;            ///< with `shadow`: the scene that the port ran; empty: a manifest lies beside the dumps
  std::string profile = "vulkan";
  std::vector<std::string> only;  ///< these passes alone; empty: all
  bool partial = false;           ///< a pass without files of the port is not judged, and nothing of it is missing
  std::filesystem::path spirv;    ///< a folder with bindings.json: the port's own shaders are asked who is wrong; "": they are not
  bool no_causes = false;         ///< what went wrong is not looked for
  double causes_within = 0;       ///< seconds of that for a pass; 0: as long as it takes
  std::string exec;               ///< the port's own command, run first; "": `port` holds its outputs
  double timeout_s = 600;         ///< of each run of it
  int repeat = 1;                 ///< runs of it
  bool allow_untested = false;
  bool strict = false;        ///< each WARN fails
  bool exhaustive = false;    ///< every envelope is computed
  bool foreign_host = false;  ///< with `shadow`: what the host chose otherwise than the scene is a note
  bool verbose = false;       ///< all that is known of each pass
  int threads = 0;
  std::string command;  ///< as typed, for the report
  ReportOptions reports;
};
struct MutateRequest {
  std::filesystem::path pack;
  std::string profile = "vulkan";
  std::vector<std::string> only;
  bool all = false;
  int threads = 0;
};

/// `describe --layout`.
struct LayoutRequest {
  std::optional<std::string> language, pass, variant;
};

int list(bool json);
int describe(const std::string& effect, bool json, const LayoutRequest& layout);
int describe_shaders(const std::vector<std::filesystem::path>& shaders);
int run(const RunOptions& options);
int hash(const SceneOptions& options);
int pack(const PackOptions& options);
int pack(const ForeignPackOptions& options);
int diff(const std::filesystem::path& a, const std::filesystem::path& b);
int validate(const ValidateRequest& request);
int mutate(const MutateRequest& request);
int selftest();

}  // namespace rainref::cli
