#include "sweep/shard.h"

#include <cstdlib>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

constexpr std::int64_t most = 10'000'000;

[[noreturn]] void refuse(const std::string& message) { throw Error(ExitCode::usage, "--shard: " + message); }

std::optional<std::int64_t> number(const std::string& text) {
  const std::optional<std::int64_t> n = whole_from<std::int64_t>(text);
  return n && *n >= 0 && *n <= most ? n : std::nullopt;
}

/// An engine's variables for an index, for the first index, for the step, and for the count or else the last index. A null pointer: not
/// available.
struct Engine {
  const char *name, *index, *first, *step, *count, *last;
};
constexpr Engine engines[] = {
    {"Slurm", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_STEP", "SLURM_ARRAY_TASK_COUNT", nullptr},
    {"Grid Engine", "SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_STEPSIZE", nullptr, "SGE_TASK_LAST"},
    {"PBS", "PBS_ARRAY_INDEX", nullptr, nullptr, nullptr, nullptr},
    {"Torque", "PBS_ARRAYID", nullptr, nullptr, nullptr, nullptr},
    {"Kubernetes", "JOB_COMPLETION_INDEX", nullptr, nullptr, nullptr, nullptr},
    {"Open MPI", "OMPI_COMM_WORLD_RANK", nullptr, nullptr, "OMPI_COMM_WORLD_SIZE", nullptr},
    {"MPI", "PMI_RANK", nullptr, nullptr, "PMI_SIZE", nullptr},
};

/// said: the given count, or 0.
Shard automatic(std::int64_t said, const Environment& variables) {
  for (const Engine& e : engines) {
    const std::optional<std::string> index = variables(e.index);
    if (!index || *index == "undefined") continue;  // Grid Engine's value for a job that is not an array
    const auto read = [&](const char* variable, std::int64_t otherwise) {
      const std::optional<std::string> text = variable ? variables(variable) : std::nullopt;
      if (!text || *text == "undefined") return otherwise;
      const std::optional<std::int64_t> n = number(*text);
      if (!n) refuse(fmt::format("expected a whole number in {}'s {}, found '{}'", e.name, variable, *text));
      return *n;
    };
    const std::int64_t first = read(e.first, 0), step = std::max<std::int64_t>(1, read(e.step, 1)), last = read(e.last, -1);
    std::int64_t count = read(e.count, last < 0 ? 0 : (last - first) / step + 1);
    if (said > 0) count = said;
    if (count == 0) refuse(fmt::format("expected auto/N, for {} does not say how many there are, found auto", e.name));
    const std::int64_t place = read(e.index, 0) - first;
    if (place < 0 || place % step != 0 || place / step >= count)
      refuse(fmt::format("expected {} from {} to {} by {}, found {}", e.index, first, first + (count - 1) * step, step, *index));
    return {place / step, count};
  }
  refuse("expected an array of Slurm, Grid Engine, PBS, Kubernetes or MPI behind auto, found none of their variables; K/N says it by hand");
}

}  // namespace

Environment environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* const value = std::getenv(name);
    if (!value || !*value) return {};
    return value;
  };
}

Shard shard_from(const std::string& text, const Environment& variables) {
  const std::size_t slash = text.find('/');
  const std::string before = text.substr(0, slash);
  const bool has_count = slash != std::string::npos;
  const std::int64_t count = has_count ? number(text.substr(slash + 1)).value_or(0) : 0;
  if (before == "auto" && (count > 0 || !has_count)) return automatic(count, variables);
  const std::int64_t k = number(before).value_or(count);
  if (k >= count) refuse(fmt::format("expected K/N with K from 0 to N - 1, auto, or auto/N, found '{}'", text));
  return {k, count};
}

}  // namespace rainref::sweep
