// Writes packs and captures: a folder of arrays and their manifest (docs/packs.md).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "capture/new_folder.h"
#include "capture/pass_case.h"
#include "capture/pass_info.h"
#include "scene/config.h"

namespace rainref::capture {

/// Writes a pack case by case, without keeping the arrays. finish() makes the complete folder visible. An older pack of rainref is replaced
/// if its folder contains nothing else; any other non-empty folder is Error(io).
///
/// An input equal to an array that was already written, for any case, is not written again: its manifest entry names that file. Outputs
/// always have their own files.
class PackWriter {
 public:
  /// `passes`: all passes that have cases. `effect` must outlive the writer.
  PackWriter(std::filesystem::path folder, const EffectInfo& effect, const scene::Config& config, const std::string& scene_name,
             bool with_inputs, const std::vector<std::string>& passes);
  ~PackWriter();
  void add(const PassCase& c);
  /// Adds a file of a foreign effect's reference, the description first.
  void add_reference(const std::string& path, std::span<const std::byte> bytes);
  /// Records what the cases exercise of a pass text: the number of alternatives, and those never taken; `is_sampled` if a sample of the
  /// invocations was counted. For readers; a judgement counts again.
  void add_coverage(const std::string& pass, int exercised, int alternatives, const std::vector<std::string>& never,
                    const std::map<std::string, std::string>& reasons, bool is_sampled);

  struct Total {
    int cases = 0, files = 0;
    std::size_t bytes = 0;
  };
  /// Writes the manifest and renames the folder. Call once, as the last call.
  Total finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref::capture
