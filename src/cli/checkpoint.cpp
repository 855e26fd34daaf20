#include "cli/checkpoint.h"

#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/json_read.h"
#include "rainref/error.h"
#include "state/file.h"

namespace rainref::cli {

Checkpoint::Checkpoint(const std::filesystem::path& folder, const RunOptions& options)
    : path_(folder / "checkpoint.state"), options_(options) {}

/// The options that determine which files exist: a resumed run must have the same.
nlohmann::ordered_json Checkpoint::asked() const {
  return {{"--first", options_.first},
          {"--every", options_.every},
          {"--image", options_.png ? (options_.exr ? "both" : "png") : (options_.exr ? "exr" : "none")},
          {"--compare-truth", options_.compare_truth}};
}

std::optional<std::uintmax_t> Checkpoint::bytes() const {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path_, error);
  if (error == std::errc::no_such_file_or_directory) return std::nullopt;
  return error ? 0 : size;  // reading it will report the error
}

RunSoFar Checkpoint::resume(simulation::Opened& opened, nlohmann::ordered_json& truth) const {
  const std::vector<std::byte> bytes = read_file(path_);
  const state::Saved saved(bytes, path_text(path_));
  const auto fail = [&](const std::string& why) { throw Error(ExitCode::usage, fmt::format("{}: {}", path_text(path_), why)); };
  RunSoFar so_far;
  const nlohmann::ordered_json wanted = asked();
  const capture::JsonLimits limits{capture::large_json.bytes, capture::large_json.depth, ExitCode::usage};
  nlohmann::ordered_json so_compared;
  try {
    const nlohmann::ordered_json note = capture::parse_json(saved.note(), path_text(path_) + ": note", limits);
    so_far.seconds = note.at("seconds").get<double>();
    for (const auto& t : note.at("passes"))
      so_far.times.push_back({t.at("name").get<std::string>(), t.at("seconds").get<double>(), t.at("calls").get<int>()});
    so_compared = note.at("truth").get<nlohmann::ordered_json::array_t>();
    for (const auto& [option, value] : wanted.items()) {
      const auto& before = note.at("asked").at(option);
      if (before != value) fail(fmt::format("of a run with {} {}: expected the same, found {}", option, before.dump(), value.dump()));
    }
  } catch (const nlohmann::json::exception&) {
    fail("expected the state of an interrupted run, found one that another program saved");
  }
  opened.load(saved);
  truth = std::move(so_compared);
  return so_far;
}

void Checkpoint::write(const simulation::Opened& opened, const RunSoFar& so_far, const nlohmann::ordered_json& truth) const {
  nlohmann::ordered_json note{
      {"asked", asked()}, {"seconds", so_far.seconds}, {"passes", nlohmann::ordered_json::array()}, {"truth", truth}};
  for (const auto& t : so_far.times) note["passes"].push_back({{"name", t.pass}, {"seconds", t.seconds}, {"calls", t.calls}});
  AtomicFile file(path_);
  opened.save(note.dump(), [&](std::span<const std::byte> bytes) { file.write(bytes); });
  file.commit();
}

void Checkpoint::remove() const {
  std::error_code error;
  std::filesystem::remove(path_, error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: cannot be removed: {}", path_text(path_), error.message()));
}

}  // namespace rainref::cli
