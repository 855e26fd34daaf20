// Packs and captures on disk: a folder of arrays and the manifest that describes them (docs/packs.md).
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

/// Writes a pack case by case; arrays are not kept. The folder appears with finish(), whole. An older pack of rainref
/// that lies there is replaced, if it holds nothing else; any other folder that is not empty is Error(io).
///
/// An input that is equal to an array already written, of this case or another, is not written again: its manifest
/// entry names that file. Outputs always have files of their own.
class PackWriter {
 public:
  /// `passes`: those that cases may be of. `effect` must outlive the writer.
  PackWriter(std::filesystem::path folder, const EffectInfo& effect, const scene::Config& config, const std::string& scene_name,
             bool with_inputs, const std::vector<std::string>& passes);
  ~PackWriter();
  void add(const PassCase& c);
  /// A file that says what computes a foreign effect, the description first.
  void add_reference(const std::string& path, std::span<const std::byte> bytes);
  /// What the cases exercise of a pass text: how many of its alternatives, and which they do not, `is_sampled` as far as a
  /// sample of the invocations tells. For people; a judge counts again.
  void add_coverage(const std::string& pass, int exercised, int alternatives, const std::vector<std::string>& never,
                    const std::map<std::string, std::string>& reasons, bool is_sampled);

  struct Total {
    int cases = 0, files = 0;
    std::size_t bytes = 0;
  };
  /// Writes the manifest and gives the folder its name. Call once, last.
  Total finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref::capture
