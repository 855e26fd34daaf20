// Cases of passes, and verdicts on what a port gives for them: all of it in memory, without files.
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

/// A quantity of a uniform block or of a record: a scalar, or a vector of 2 to 4.
struct Field {
  /// What each component is stored as, in 4 bytes.
  enum Type : std::uint8_t { float32, int32, uint32 };
  std::string name, unit, sentence;
  Type type = float32;
  int components = 1;
  std::size_t offset = 0;  ///< [byte] from the start of the block or record
};

/// An array that a pass takes or gives, as a GPU takes it: rows without padding, row 0 = v 0, little endian. Valid as long as the cases.
struct CaseArray {
  std::string name;
  bool is_records = false;           ///< of records, or a uniform block, which is one record
  Format format = Format::r8;        ///< of an image
  int width = 0, height = 1;         ///< texels; of records their number, and 1
  int levels = 1;                    ///< mip levels of the image
  std::size_t element_bytes = 0;     ///< from a texel to the next, or from a record to the next
  std::string record;                ///< the name of the records' struct in shaders: "Drop"
  std::vector<Field> fields;         ///< of records
  std::span<const std::byte> bytes;  ///< width * height * element_bytes of them

  /// The first texel of row y, or record 0. T is the storage type of one channel (float, Half, Unorm8, std::uint32_t), or the record's
  /// struct.
  template <class T>
  const T* row(int y = 0) const {
    return reinterpret_cast<const T*>(bytes.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * element_bytes);
  }
};

/// How a pass reads an input: a filter of `none` loads by integer texel, a mip filter of `none` level 0 only.
struct CaseSampling {
  Filter filter = Filter::none, mip_filter = Filter::none;
  Address address_u = Address::clamp, address_v = Address::clamp;
  std::array<float, 4> border{};  ///< what a lookup outside gives where an address rule is border
};

/// One run of one pass.
struct CaseInfo {
  std::string id;  ///< "puddle.wave_step/0001.0"
  std::string effect, variant, pass;
  std::string formula;                       ///< name and revision: "puddle.wave_step.corrected/2"
  int frame = 0, step = 0;                   ///< step counts the substeps in a frame
  int level = -1;                            ///< the mip level, where the pass runs once for each; else -1
  float time = 0, dt = 0;                    ///< [s] of the frame's start, and that this run advances
  std::vector<std::string> inputs, outputs;  ///< their names
};

/// What would explain the failures of a pass.
struct Cause {
  std::string name, sentence;
  std::int64_t explained = 0;  ///< failing texels, or records, whose bits it gives
  std::int64_t of = 0;         ///< failing ones that were looked at
  std::int64_t inside = 0;     ///< that it comes near
  bool is_likely = false;      ///< it explains nearly all
  /// Lines of the port's shaders where it is, the best first: "shade.comp:57: vec3 bent = refract(view, normal, WATER_IOR);". Empty without
  /// shaders (JudgeOptions::spirv).
  std::vector<std::string> lines = {};
};

/// An element outside what is allowed. Records that are missing or too many are in the pass's `reason`.
struct Failure {
  std::string case_id, output;
  std::string field;                                ///< of a record's; ""
  int x = 0, y = 0;                                 ///< texel; of a record x is its number or id
  int channel = 0;                                  ///< 0 to 3
  bool is_a_number = true;                          ///< false: NaN
  double got = 0, low = 0, high = 0, expected = 0;  ///< low to high is accepted
  std::string text;                                 ///< place, what was got, accepted and expected, with their bits
};

/// What is said of a pass; counts are of channels of texels, or of fields of records.
struct PassVerdict {
  std::string pass, formula;
  std::string status;  ///< as Verdict::status
  std::string reason;  ///< "" where the status says all
  std::string where;   ///< what the failures share: "only channel y of wave"; ""
  std::int64_t cases = 0;
  std::int64_t elements = 0;   ///< judged
  std::int64_t outside = 0;    ///< of these not what the profile allows
  std::int64_t differing = 0;  ///< not the reference's bits
  std::int64_t vacuous = 0;    ///< of the sampled: without a bound that says anything
  std::vector<Cause> causes;   ///< the best first
  std::vector<Failure> worst;  ///< the worst first
  std::int64_t sampled = 0;    ///< whose bounds were asked: all, or a sample of a large picture
};

/// What is said of a port.
struct Verdict {
  std::string status;          ///< "PASS", "WARN", "FAIL", "UNTESTED"; of a pass also "DATA", "NOT JUDGED"
  std::string reason;          ///< "" where the status says all
  std::string first_bad_pass;  ///< in the order of dataflow; ""
  std::string profile;
  std::vector<PassVerdict> passes;  ///< in the order of execution

  /// Whether it is PASS or WARN.
  bool is_good() const { return status == "PASS" || status == "WARN"; }
};

/// A verdict and its reports. It may outlive the cases.
class Judgement {
 public:
  ~Judgement();
  Judgement(Judgement&&) noexcept;

  const Verdict& verdict() const;
  /// The reports of `rainref validate`: for a log, for programs (docs/reports.md lists the keys), and a page with pictures of what fails.
  std::string text() const;
  std::string json() const;
  std::string html() const;

 private:
  friend class Cases;
  struct State;
  explicit Judgement(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// How Cases::judge judges.
struct JudgeOptions {
  std::string profile = "vulkan";          ///< "ieee", "vulkan", "webgpu", ...: what the port's API allows
  std::string port = "outputs in memory";  ///< what reports call the port
  std::optional<Rounding> half{};          ///< how the port rounds stores to binary16; none: found out where the profile leaves it open
  bool strict = false;                     ///< each WARN is a FAIL
  bool exhaustive = false;                 ///< every envelope is computed, where widths and shares are otherwise a sample's
  /// A folder with bindings.json and the port's SPIR-V (docs/shader.md): causes have lines, and the reports say who is wrong. "": none.
  std::filesystem::path spirv{};
};

/// Runs of passes with what they took and gave, in the order of execution: what a port is run on. Every function throws Error, naming what
/// was expected and found: usage for arguments, port_files for a pack or for outputs that cannot be judged, io for files.
class Cases {
 public:
  /// None yet; add_next_frame adds some. They may outlive the simulation.
  explicit Cases(const Simulation& simulation);
  /// The cases of a pack (`rainref pack`), with all their values. No pass named: every one.
  explicit Cases(const std::filesystem::path& pack, const std::vector<std::string>& passes = {});
  ~Cases();
  Cases(Cases&&) noexcept;

  /// Simulates and renders the simulation's next frame, which must be of the same effect and variant. Each run of the named passes is
  /// added, with copies of its inputs and outputs: some tens of MiB for a frame of 1080p. No pass named: every one.
  void add_next_frame(Simulation& simulation, const std::vector<std::string>& passes = {});

  /// How many there are; the others count them from 0.
  std::size_t size() const;
  CaseInfo info(std::size_t index) const;
  /// The uniform block: one record.
  CaseArray uniforms(std::size_t index) const;
  CaseArray input(std::size_t index, std::string_view name, int level = 0) const;
  CaseSampling sampling(std::size_t index, std::string_view input) const;
  /// What the reference gives.
  CaseArray expected(std::size_t index, std::string_view output) const;

  /// What a port gave for an output; a copy is taken. Of an image `count` is its height, `row_bytes` from one of its rows to the next; of
  /// records their number and their size. Where the list's length is a key's, another number of records is a FAIL.
  void give(std::size_t index, std::string_view output, const void* data, std::size_t row_bytes, std::size_t count);

  /// Judges every pass that anything was given for, and says why one fails. A run with an output that was not given is NOT JUDGED.
  Judgement judge(const parallel::Executor& executor, const JudgeOptions& options = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref
