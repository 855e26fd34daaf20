// The verbs of the command line. Each returns an exit code or throws Error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/validate_reports.h"
#include "port_dump/import_image.h"

namespace rainref::cli {

/// Options that `run`, `hash` and `pack` share.
struct SceneOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< from --preset and --set, then --frames and --size
  int threads = 0;                     ///< 0: one for each processor
};

struct RunOptions {
  SceneOptions scene;
  std::filesystem::path output;  ///< empty: out/<name of the scene>
  std::filesystem::path film;    ///< of the frames from `first` on, every K-th with `every`; empty: none
  int first = 0;                 ///< earlier frames are simulated but not rendered
  int every = 0;                 ///< 0: the last frame only
  int checkpoint_every = 0;      ///< frames between checkpoints; 0: none
  bool overwrite = false;        ///< deletes what an earlier run left in the folder
  bool resume = false;           ///< from a checkpoint, if there is one
  bool png = true, exr = false;
  bool json = false;
  bool keep_images = true;     ///< keeps the start images of default scenes in the user's cache folder
  bool compare_truth = false;  ///< with the traced truth, for the frames that are written
  enum Capture : std::uint8_t { none, passes, all } capture = none;
};

struct PackOptions {
  SceneOptions scene;
  std::filesystem::path output;
  std::vector<int> frames;          ///< ascending
  bool may_add_frames = false;      ///< for passes that a null port would pass with these frames
  std::vector<std::string> passes;  ///< empty: every pass of the variant
  bool shows_coverage = false;      ///< lists the alternatives of each pass's text that no case takes
  bool has_random_seed = false;     ///< says which
};

/// `pack --spirv`.
struct ForeignPackOptions {
  std::filesystem::path effect, inputs, output;
  int threads = 0;
};

/// `import`.
struct ImportRequest {
  std::filesystem::path file, pack, output;  ///< output: the port's folder
  std::string as;                            ///< "puddle.display/0012.0/out.picture"
  port_dump::ImportHints hints;
};

struct ValidateRequest {
  std::filesystem::path pack, port;
  std::filesystem::path shadow;  ///< dumps of a port's own run, judged in place of `port`; "": a pack is judged
  SceneOptions scene;            ///< with `shadow`: the scene that the port ran; empty: a manifest is beside the dumps
  std::string profile = "vulkan";
  std::vector<std::string> only;   ///< only these passes; empty: all
  std::vector<std::string> fused;  ///< passes that one shader computes: "ground_noise+shade"
  bool partial = false;            ///< a pass without files of the port is not judged, and its files are not reported as missing
  std::filesystem::path spirv;     ///< a folder with bindings.json: executes the port's own shaders to find out who is wrong; "": no
  bool no_causes = false;          ///< no search for causes
  double causes_within = 0;        ///< time limit in seconds for the causes of a pass; 0: none
  std::string exec;                ///< the port's own command, run first; "": `port` already holds its outputs
  double timeout_s = 600;          ///< for each run of the command
  int repeat = 1;                  ///< number of runs of the command
  bool allow_untested = false;
  bool strict = false;        ///< each WARN fails
  bool exhaustive = false;    ///< computes every envelope
  bool foreign_host = false;  ///< with `shadow`: a host's choices that differ from the scene are notes
  bool verbose = false;       ///< all details of each pass
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

/// `effect`: what is listed is of this one; "": of all.
int list(const std::string& effect, bool json);
/// `name`: an effect or a scene. `group`: only the keys of an effect that begin so; "": all of it. `overrides`: for a scene.
int describe(const std::string& name, const std::string& group, bool json, const LayoutRequest& layout,
             const std::vector<std::string>& overrides = {});
int describe_shaders(const std::vector<std::filesystem::path>& shaders);
int run(const RunOptions& options);
int hash(const SceneOptions& options);
int pack(const PackOptions& options);
int pack(const ForeignPackOptions& options);
/// `pack --flat`: a pack's inputs and uniforms as raw bytes, in a folder of their own.
int flat_pack(const std::filesystem::path& pack, const std::filesystem::path& output);
int diff(const std::filesystem::path& a, const std::filesystem::path& b);
/// `import`: writes a file of a debugger or an engine into a port's folder, and says how it was read.
int import_file(const ImportRequest& request);
int validate(const ValidateRequest& request);
int mutate(const MutateRequest& request);
int selftest();
/// Judges a wrong port and the right one, into a folder.
int demo(const std::filesystem::path& output);

}  // namespace rainref::cli
