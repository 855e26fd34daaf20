// Cases of one scene or pack, and what a port gave for them: what rainref::Cases and the handles of rainref.h hold.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pack_read.h"
#include "capture/pass_case.h"
#include "port_dump/stored_image.h"
#include "rainref/simulation.h"

namespace rainref::judging {

/// A run of a pass, and what a port gave for it. Both are never changed once they are there: judgements hold them too.
struct Run {
  std::shared_ptr<const capture::PassCase> c;
  std::string id, formula;
  std::vector<std::shared_ptr<const capture::Array>> given{};  ///< one for each output; null: not given
  std::vector<std::vector<std::string>> notes{};               ///< what the report says of each, a sentence each

  bool has_any() const;  ///< of these
  /// Throw Error(usage): naming the nearest one, or how many there are.
  const capture::CaseInput& input(std::size_t index) const;
  std::size_t input_index(std::string_view name) const;
  const capture::CaseOutput& output(std::size_t index) const;
  std::size_t output_index(std::string_view name) const;
};

/// Error(usage) unless the index is below the count: "case 7: expected one of 3, counted from 0".
void require_index(std::size_t index, std::size_t count, const char* what);

class CaseList {
 public:
  /// None yet, of the effect and variant of a simulation.
  explicit CaseList(const Simulation& simulation);
  /// Those of a pack that are of these passes; of every pass where none is named. Error(usage) for a capture without inputs.
  CaseList(const std::filesystem::path& pack, const std::vector<std::string>& passes);

  /// The next frame of a simulation of the same effect and variant: all of its runs of these passes are added, or none.
  void add_next_frame(Simulation& simulation, const std::vector<std::string>& passes);
  /// A copy of an output's rows or records; Error(usage) where it cannot be that output.
  void give(std::size_t index, std::size_t output, const void* data, std::size_t row_bytes, std::size_t count);
  /// The same of an image whose texels may be of another type and have more channels (judging/given_image.h); it gets its name here.
  void give_image(std::size_t index, std::size_t output, port_dump::StoredImage image);

  const std::string& effect() const { return effect_; }
  const std::string& variant() const { return variant_; }
  const std::string& scene() const { return scene_; }
  const std::vector<capture::PackPass>& passes() const { return passes_; }  ///< in the order of execution
  const std::vector<capture::PackEdge>& edges() const { return edges_; }
  const capture::Pack* pack() const { return pack_.get(); }  ///< null: of a simulation
  const std::vector<Run>& runs() const { return runs_; }     ///< in the order of execution
  const Run& run(std::size_t index) const;                   ///< Error(usage) past the last
  const capture::PackPass& pass_of(const Run& run) const;

 private:
  std::vector<std::string> wanted(const std::vector<std::string>& passes) const;
  void add(capture::PassCase c);

  std::string effect_, variant_, scene_;
  std::vector<capture::PackPass> passes_;
  std::vector<capture::PackEdge> edges_;
  std::shared_ptr<const capture::Pack> pack_;
  std::vector<Run> runs_;
};

}  // namespace rainref::judging
