// Data of the page that the judgement does not hold: the graph, sentences, and the values of outputs.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "judge/shadow.h"

namespace rainref::reports {

/// One output of one case.
struct OutputBuffers {
  capture::CaseOutput expected;
  capture::Array port;
};

struct PageSource {
  std::vector<capture::PackEdge> edges;
  std::map<std::string, std::string> sentences;  ///< of passes, by name
  /// Reads an output of a case again; nothing if it is unavailable. Null: no pictures.
  std::function<std::optional<OutputBuffers>(const std::string& id, const std::string& output)> read;
};
/// For a port's outputs for a pack. `buffers`: the ones that the judge has read; null: nothing is kept.
PageSource page_source(std::shared_ptr<const capture::Pack> pack, const std::filesystem::path& port,
                       std::shared_ptr<judge::ReadBuffers> buffers = nullptr);
/// For the dumps of a port's own run, recomputed from its inputs. The executor of the options must outlive it.
PageSource page_source(std::shared_ptr<const judge::ShadowPlan> plan, const std::filesystem::path& folder,
                       const std::vector<judge::DumpedRun>& dumped, const judge::ValidateOptions& options);

}  // namespace rainref::reports
