#include "sweep/work.h"

#include <array>
#include <chrono>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/folders.h"
#include "base/machine.h"
#include "base/path_text.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

/// A log with a line for each cell made by this process, for people only.
class TimeLog {
 public:
  explicit TimeLog(const std::filesystem::path& folder) : folder_(folder) {}
  void add(const Cell& cell, const Made& made, double seconds) {
    if (!file_.is_open()) {
      host_ = machine::host_name();
      file_.open(folder_ / utf8_path(Hidden::random_name().substr(9, 16) + ".csv"), std::ios::app);
    }
    file_ << fmt::format("{},{},{:.6f},{},{}\n", cell.id, host_, seconds, made.bytes, made.begun_at) << std::flush;
  }

 private:
  std::filesystem::path folder_;
  std::string host_;
  std::ofstream file_;
};

Failure failure_of(const Error& e) { return {static_cast<int>(e.code()), e.what()}; }

class Shift {
 public:
  Shift(const Cells& cells, const Store& store, const WorkOptions& options, const Maker& make)
      : cells_(cells), store_(store), options_(options), make_(make), log_(store.root() / "log") {}

  /// Whether another process is making it, perhaps because it started with the same shard earlier.
  bool is_elsewhere(const Cell& cell) const { return !store_.has(cell.id) && store_.tries(cell.id).alive > 0; }

  Outcome take(const Cell& cell, std::string& sentence) {
    if (store_.has(cell.id)) {
      if (!options_.again || cells_.plan().judging.exec.empty()) return Outcome::had;
      store_.remove_cell(cell.id);
    }
    if (options_.again) store_.forget(cell.id);
    const std::optional<Failure> known = store_.failure(cell.id);
    if (known && known->is_final()) {
      sentence = known->sentence;
      return known->code == 2 ? Outcome::refused : Outcome::failed;
    }
    const int deaths = store_.tries(cell.id).dead;
    if (deaths >= cells_.plan().tries) {
      const Failure died{0, fmt::format("{} processes died while they made this cell", deaths)};
      return fail(cell, died, sentence);
    }
    Failure last;
    for (std::int64_t t = 0; t < cells_.plan().tries && last.code != 2; ++t) {
      const std::unique_ptr<Hidden> being_made = store_.begin(cell.id);
      const auto start = std::chrono::steady_clock::now();
      try {
        const Made made = make_(cell, names_);
        log_.add(cell, made, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        if (known || deaths > 0) store_.forget(cell.id);
        return made.was_first ? Outcome::made : Outcome::lost;
      } catch (const Error& e) {
        last = failure_of(e);
      } catch (const std::bad_alloc&) {
        last = {5, "needs more memory than could be had"};
      } catch (const std::exception& e) {
        last = {5, e.what()};
      }
      if (store_.has(cell.id)) return Outcome::lost;  // another process finished it meanwhile
    }
    return fail(cell, last, sentence);
  }

  void sync_names() {
    try {
      sync_to_disk(std::exchange(names_, {}));
    } catch (const std::system_error& e) {
      throw Error(ExitCode::io, fmt::format("{}: {}", path_text(store_.root()), e.code().message()));
    }
  }

 private:
  Outcome fail(const Cell& cell, const Failure& failure, std::string& sentence) const {
    sentence = failure.sentence;
    store_.record(cell.id, cells_.words(cell), failure);
    return failure.code == 2 ? Outcome::refused : Outcome::failed;
  }

  const Cells& cells_;
  const Store& store_;
  const WorkOptions& options_;
  const Maker& make_;
  TimeLog log_;
  Names names_;  // a power cut loses at most the last finished cell
};

}  // namespace

const char* name(Outcome outcome) {
  constexpr std::array names{"had", "made", "made by another", "refused", "failed"};
  return names[static_cast<std::size_t>(outcome)];
}

Counts work(const Cells& cells, const Store& store, const WorkOptions& options, const Maker& make, const Listener& tell) {
  store.make();
  Shift shift(cells, store, options, make);
  Counts counts;
  const auto take = [&](const Cell& cell) {
    std::string sentence;
    const Outcome outcome = shift.take(cell, sentence);
    ++counts.of[static_cast<int>(outcome)];
    tell(cell, outcome, sentence);
  };
  std::vector<const Cell*> later;
  for (std::size_t i = 0; i < cells.all().size(); ++i) {
    if (!options.shard.takes(static_cast<std::int64_t>(i), static_cast<std::int64_t>(cells.all().size()))) continue;
    const Cell& cell = cells.all()[i];
    shift.is_elsewhere(cell) ? later.push_back(&cell) : take(cell);
  }
  for (const Cell* cell : later) take(*cell);
  shift.sync_names();
  return counts;
}

}  // namespace rainref::sweep
