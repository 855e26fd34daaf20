#include "reports/source.h"

#include <algorithm>

#include "base/path_text.h"
#include "judge/port_files.h"

namespace rainref::reports {
namespace {

using judge::DumpedRun;
using judge::PortFiles;
using judge::PortRun;
using judge::shadow_run;
using judge::ShadowPlan;
using judge::ValidateOptions;

/// Edges and sentences of anything that has passes.
template <class Passes>
PageSource source_of(const Passes& from) {
  PageSource source;
  source.edges = from.edges;
  for (const capture::PackPass& p : from.passes) source.sentences[p.name] = p.sentence;
  return source;
}

}  // namespace

PageSource page_source(std::shared_ptr<const capture::Pack> pack, const std::filesystem::path& port,
                       std::shared_ptr<judge::ReadBuffers> buffers) {
  PageSource source = source_of(*pack);
  source.read = [pack, files = std::make_shared<PortFiles>(port, pack->effect, pack->variant, std::move(buffers))](
                    const std::string& id, const std::string& output) -> std::optional<OutputBuffers> {
    for (const capture::PackCase& c : pack->cases) {
      if (c.id != id) continue;
      for (const capture::PackOutput& o : c.outputs) {
        if (o.name != output) continue;
        OutputBuffers b{o.rules, {}};
        b.expected.array = pack->read(o);
        b.port = files->read(utf8_path(id), "out." + output, b.expected.array);
        return b;
      }
    }
    return std::nullopt;
  };
  return source;
}

PageSource page_source(std::shared_ptr<const ShadowPlan> plan, const std::filesystem::path& folder, const std::vector<DumpedRun>& dumped,
                       const ValidateOptions& options) {
  PageSource source = source_of(*plan);
  // The outputs of a run are requested one after the other, so it is recomputed only once.
  auto last = std::make_shared<std::pair<std::string, PortRun>>();
  source.read = [=](const std::string& id, const std::string& output) -> std::optional<OutputBuffers> {
    if (last->first != id) *last = {id, shadow_run(*plan, folder, dumped, options, id)};
    const PortRun& run = last->second;
    if (!run.untested.empty()) return std::nullopt;
    for (std::size_t o = 0; o < run.c.outputs.size(); ++o)
      if (run.c.outputs[o].name == output) return OutputBuffers{run.c.outputs[o], run.stored[o]};
    return std::nullopt;
  };
  return source;
}

}  // namespace rainref::reports
