// The cases of one scene or pack, and a port's outputs for them. rainref::Cases and handles of rainref.h hold it.
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

/// A run of a pass, and a port's outputs for it. Both are immutable once set, because judgements share them.
struct Run {
  std::shared_ptr<const capture::PassCase> c;
  std::string id, formula;
  std::vector<std::shared_ptr<const capture::Array>> given{};  ///< one for each output; null: not given
  std::vector<std::vector<std::string>> notes{};               ///< notes of each output for the report, one sentence each

  bool has_any() const;  ///< any output
  /// Throw Error(usage) that names the nearest name, or the valid count.
  const capture::CaseInput& input(std::size_t index) const;
  std::size_t input_index(std::string_view name) const;
  const capture::CaseOutput& output(std::size_t index) const;
  std::size_t output_index(std::string_view name) const;
};

/// Error(usage) unless the index is below the count: "case 7: expected one of 3, counted from 0".
void require_index(std::size_t index, std::size_t count, const char* what);

class CaseList {
 public:
  /// No cases yet; for the effect and variant of a simulation.
  explicit CaseList(const Simulation& simulation);
  /// The cases of a pack for these passes; for every pass if none is named. Error(usage) for a capture without inputs.
  CaseList(const std::filesystem::path& pack, const std::vector<std::string>& passes);

  /// Runs the next frame of a simulation of the same effect and variant, and adds all of its runs of these passes, or none.
  void add_next_frame(Simulation& simulation, const std::vector<std::string>& passes);
  /// Copies an output's rows or records; Error(usage) if they cannot be that output.
  void give(std::size_t index, std::size_t output, const void* data, std::size_t row_bytes, std::size_t count);
  /// The same for an image whose texels may have another type and more channels (judging/given_image.h); sets its name.
  void give_image(std::size_t index, std::size_t output, port_dump::StoredImage image);

  const std::string& effect() const { return effect_; }
  const std::string& variant() const { return variant_; }
  const std::string& scene() const { return scene_; }
  const std::vector<capture::PackPass>& passes() const { return passes_; }  ///< in the order of execution
  const std::vector<capture::PackEdge>& edges() const { return edges_; }
  const capture::Pack* pack() const { return pack_.get(); }  ///< null: made from a simulation
  const std::vector<Run>& runs() const { return runs_; }     ///< in the order of execution
  const Run& run(std::size_t index) const;                   ///< Error(usage) if the index is too large
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
