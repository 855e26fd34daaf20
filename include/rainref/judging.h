// Cases of passes, and verdicts on the results of a port, in memory or in files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/simulation.h"
#include "rainref/storage.h"
#include "rainref/texture.h"

namespace rainref {

/// A member of a uniform block or of a record: a scalar, or a vector of 2 to 4 components.
struct Field {
  /// Storage type of each component, 4 bytes.
  enum Type : std::uint8_t { float32, int32, uint32 };
  std::string name, unit, sentence;
  Type type = float32;
  int components = 1;
  std::size_t offset = 0;  ///< [byte] from the start of the block or record
};

/// An input or output of a pass, laid out as for a GPU: rows without padding, row 0 = v 0, little endian. Valid as long as the cases.
struct CaseArray {
  std::string name;
  bool is_records = false;           ///< a list of records; a uniform block is one record
  Format format = Format::r8;        ///< for images
  int width = 0, height = 1;         ///< texels; for records their number, and 1
  int levels = 1;                    ///< mip levels of the image
  std::size_t element_bytes = 0;     ///< distance between texels, or between records
  std::string record;                ///< name of the record's struct in shaders: "Drop"
  std::vector<Field> fields;         ///< for records
  std::span<const std::byte> bytes;  ///< width * height * element_bytes bytes

  /// Returns the first texel of row y, or record 0. T is the storage type of one channel (float, Half, Unorm8, std::uint32_t), or the
  /// record's struct.
  template <class T>
  const T* row(int y = 0) const {
    return reinterpret_cast<const T*>(bytes.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * element_bytes);
  }
};

/// How a pass reads an input. Without a filter (`none`) it loads by integer texel. Without a mip filter it reads level 0 only.
struct CaseSampling {
  Filter filter = Filter::none, mip_filter = Filter::none;
  Address address_u = Address::clamp, address_v = Address::clamp;
  std::array<float, 4> border{};  ///< value outside the image if the address rule is border
};

/// One run of one pass.
struct CaseInfo {
  std::string id;  ///< "puddle.wave_step/0001.0"
  std::string effect, variant, pass;
  std::string formula;                       ///< name and revision: "puddle.wave_step.corrected/2"
  int frame = 0, step = 0;                   ///< step counts the substeps of a frame
  int level = -1;                            ///< mip level, if the pass runs once for each level; else -1
  float time = 0, dt = 0;                    ///< [s] start of the frame, and time step of this run
  std::vector<std::string> inputs, outputs;  ///< names
};

/// A possible cause of the failures of a pass.
struct Cause {
  std::string name, sentence;
  std::int64_t explained = 0;  ///< failing texels or records whose bits the cause reproduces
  std::int64_t of = 0;         ///< failing texels or records that were examined
  std::int64_t inside = 0;     ///< failing texels or records that the cause comes near
  bool is_likely = false;      ///< it explains nearly all of them
  /// Its lines in the port's shaders, best first: "shade.comp:57: vec3 bent = refract(view, normal, WATER_IOR);". Empty without shaders
  /// (JudgeOptions::spirv).
  std::vector<std::string> lines = {};
};

/// An element outside its envelope. Missing and surplus records are counted in the pass's `reason` instead.
struct Failure {
  std::string case_id, output;
  std::string field;                                ///< field of a record; "" for an image
  int x = 0, y = 0;                                 ///< texel; for a record, x is its number or id
  int channel = 0;                                  ///< 0 to 3
  bool is_a_number = true;                          ///< false: NaN
  double got = 0, low = 0, high = 0, expected = 0;  ///< values from low to high are accepted
  std::string text;                                 ///< place, then the values found, accepted and expected, with their bits
};

/// Verdict on a pass. An element is a channel of a texel or a field of a record.
struct PassVerdict {
  std::string pass, formula;
  std::string status;  ///< see Verdict::status
  std::string reason;  ///< "" if the status says it all
  std::string where;   ///< what the failures have in common: "only channel y of wave"; "" if nothing
  std::int64_t cases = 0;
  std::int64_t elements = 0;   ///< judged elements
  std::int64_t outside = 0;    ///< elements whose value the profile does not allow
  std::int64_t differing = 0;  ///< elements whose bits differ from the reference's
  std::int64_t vacuous = 0;    ///< sampled elements whose envelope is too wide to be useful
  std::vector<Cause> causes;   ///< best first
  std::vector<Failure> worst;  ///< worst first
  std::int64_t sampled = 0;    ///< elements whose envelope was computed: all, or a sample of a large picture
};

/// Verdict on a port.
struct Verdict {
  std::string status;          ///< "PASS", "WARN", "FAIL" or "UNTESTED"; for a pass also "DATA" or "NOT JUDGED"
  std::string reason;          ///< "" if the status says it all
  std::string first_bad_pass;  ///< the first FAIL in the order of dataflow; "" if none
  std::string profile;
  std::vector<PassVerdict> passes;  ///< in the order of execution

  /// True for PASS and WARN.
  bool is_good() const { return status == "PASS" || status == "WARN"; }
};

/// Names of the profiles that a port can be judged under: "ieee", "vulkan", ...
std::vector<std::string> profile_names();

/// Options of Judgement::of_folder.
struct FolderOptions {
  std::string profile = "vulkan";
  std::vector<std::string> passes{};  ///< judge only these; if none is named, all are judged
  bool partial = false;               ///< a pass without any file is NOT JUDGED, and its files do not count as missing
  bool strict = false;                ///< each WARN is a FAIL
  bool exhaustive = false;            ///< as in JudgeOptions
  std::filesystem::path spirv{};      ///< as in JudgeOptions
  Progress progress{};                ///< called after each run of a pass, on the thread that judges; may be null
};

/// A verdict and its reports. It may outlive the cases.
class Judgement {
 public:
  /// Judges the files that a port wrote (docs/dumps.md) for the cases of a pack, like `rainref validate PACK --port PORT`. Holds one case
  /// in memory at a time. If some files are missing or unusable, the reports list them, and the other files are judged. Reports with
  /// pictures read both folders again. Throws Error(usage) for an unknown profile or pass, Error(port_files) if nothing can be judged,
  /// Error(io).
  static Judgement of_folder(const std::filesystem::path& pack, const std::filesystem::path& port, const parallel::Executor& executor,
                             const FolderOptions& options = {});
  ~Judgement();
  Judgement(Judgement&&) noexcept;

  const Verdict& verdict() const;
  /// The reports of `rainref validate`: plain text for a log, JSON for programs (docs/reports.md lists the keys), an HTML page with
  /// pictures of the failures, and JUnit XML for continuous integration.
  std::string text() const;
  std::string json() const;
  std::string html() const;
  std::string junit() const;

 private:
  friend class Cases;
  struct State;
  explicit Judgement(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Options of write_pack.
struct PackOptions {
  std::vector<int> frames{};          ///< none: 0, 1 and 12, and a later frame for a pass that does nothing in these
  std::vector<std::string> passes{};  ///< none: every pass of the variant
  std::string seed{};                 ///< "": the scene's; else a whole number, or "random" for an unpredictable one
  Progress progress{};                ///< called after each frame; starts over if the pack is written again with more frames; may be null
};
/// What write_pack wrote.
struct PackSummary {
  std::int64_t seed = 0;  ///< the same seed in PackOptions makes the same pack; the manifest records it
  int cases = 0;
  std::vector<std::string> passes{};
  std::vector<std::string> notes{};  ///< sentences: passes left out, frames added, passes where even a null port is a PASS
};
/// Runs a scene from its first frame and writes a pack of it, like `rainref pack`. The pack appears whole or not at all, and replaces an
/// older one. Throws Error(usage) for an invalid scene or seed or an unknown pass, Error(io).
PackSummary write_pack(const SceneText& scene, const std::filesystem::path& folder, const parallel::Executor& executor,
                       const PackOptions& options = {});

/// Options of Cases::judge.
struct JudgeOptions {
  std::string profile = "vulkan";          ///< "ieee", "vulkan", "webgpu", ...: what the port's API allows
  std::string port = "outputs in memory";  ///< name of the port in reports
  std::optional<Rounding> half{};          ///< how the port rounds stores to binary16; none: inferred if the profile leaves it open
  bool strict = false;                     ///< each WARN is a FAIL
  bool exhaustive = false;                 ///< compute every envelope; otherwise the statistics of envelope widths may use a sample
  /// Folder with bindings.json and the port's SPIR-V (docs/shader.md). With it causes have lines, and the reports say who is wrong. "":
  /// none.
  std::filesystem::path spirv{};
};

/// Runs of passes with their inputs and expected outputs, in the order of execution. A port runs on them. A function that fails throws an
/// Error that names what was expected and what was found: usage for invalid arguments, port_files for a pack or outputs that cannot be
/// judged, io for files.
class Cases {
 public:
  /// Starts without cases; add_next_frame adds them. They may outlive the simulation.
  explicit Cases(const Simulation& simulation);
  /// Reads the cases of a pack (`rainref pack`) with all their values. If no pass is named, it reads the cases of all passes.
  explicit Cases(const std::filesystem::path& pack, const std::vector<std::string>& passes = {});
  ~Cases();
  Cases(Cases&&) noexcept;

  /// Simulates and renders the next frame of the simulation, which must be of the same effect and variant. Adds each run of the named
  /// passes, with copies of its inputs and outputs: some tens of MiB for a 1080p frame. If no pass is named, it adds the runs of all
  /// passes.
  void add_next_frame(Simulation& simulation, const std::vector<std::string>& passes = {});

  /// Number of cases. Their indices begin at 0.
  std::size_t size() const;
  CaseInfo info(std::size_t index) const;
  /// The uniform block: one record.
  CaseArray uniforms(std::size_t index) const;
  CaseArray input(std::size_t index, std::string_view name, int level = 0) const;
  CaseSampling sampling(std::size_t index, std::string_view input) const;
  /// The reference's output.
  CaseArray expected(std::size_t index, std::string_view output) const;

  /// Gives a port's result for an output, and copies it. For an image, `count` is its height and `row_bytes` the distance between its rows.
  /// For records, `count` is their number and `row_bytes` the size of one. If a scene key determines the length of the list, another number
  /// of records is a FAIL.
  void give(std::size_t index, std::string_view output, const void* data, std::size_t row_bytes, std::size_t count);

  /// Judges every pass that has at least one given output, and says why a pass fails. A run with a missing output is NOT JUDGED.
  Judgement judge(const parallel::Executor& executor, const JudgeOptions& options = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref
