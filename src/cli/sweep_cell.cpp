// Makes the cells of each verb: simulations in this process, other verbs in a new process of this program.
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "base/read_file.h"
#include "cli/own_program.h"
#include "cli/sweep.h"
#include "cli/terminal.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "sweep/cell_record.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  const std::vector<std::byte> bytes = read_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::string without(std::string text, const std::string& part) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos;) text.erase(at, part.size());
  return text;
}

/// A verb that was run in a cell's folder.
class Ran {
 public:
  Ran(sweep::CellWriter& writer, std::vector<std::string> arguments) : writer_(writer) {
    const fs::path out = writer.folder() / "output.txt", err = writer.folder() / "error.txt";
    code_ = run_own_program(arguments, "", {out, err});
    const std::string where = path_text(writer.folder() / "");
    output_ = without(text_of(out), where);
    error_ = without(text_of(err), where);
    fs::remove(out);
    fs::remove(err);
  }
  int code() const { return code_; }
  const std::string& output() const { return output_; }
  /// Throws the run's own error.
  [[noreturn]] void fail() const {
    if (code_ < 0) throw Error(ExitCode::internal, fmt::format("died of {}", death_text(code_)));
    std::string sentence = error_.substr(0, error_.find('\n'));
    if (sentence.starts_with("rainref: ")) sentence.erase(0, 9);
    const ExitCode code = code_ == 2 ? ExitCode::usage : code_ == 4 ? ExitCode::io : ExitCode::internal;
    throw Error(code, sentence.empty() ? fmt::format("ended with exit code {}", code_) : sentence);
  }

 private:
  sweep::CellWriter& writer_;
  int code_ = 0;
  std::string output_, error_;
};

sweep::Made finish(sweep::CellWriter& writer, const sweep::Cell& cell, const Ran& ran, const std::string& verdict, sweep::Names& names) {
  writer.write("output.txt", ran.output());
  nlohmann::ordered_json record{{"cell", cell.id}, {"golden_hash", golden_hash()}};
  if (!verdict.empty()) record["verdict"] = verdict;
  sweep::Made made;
  made.bytes = writer.bytes();
  made.was_first = writer.finish(record, names);
  return made;
}

/// Takes all files that a child wrote below a folder of the cell.
void take_files(sweep::CellWriter& writer, const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(writer.folder() / utf8_path(folder)))
    if (entry.is_regular_file()) names.insert(path_text(fs::relative(entry.path(), writer.folder())));
  for (const std::string& name : names) writer.wrote(name);
}

sweep::Made make_pack(const OpenPlan& open, const sweep::Cell& cell, int threads, sweep::Names& names) {
  const sweep::Plan& plan = *open.plan;
  sweep::CellWriter writer(open.store.cell(cell.id));
  std::vector<std::string> words{"pack",      plan.scenes[cell.scene].text, "-o", path_text(writer.folder() / "pack"),
                                 "--threads", std::to_string(threads)};
  if (!plan.pack.at.empty()) words.insert(words.end(), {"--at", fmt::format("{}", fmt::join(plan.pack.at, ","))});
  if (!plan.pack.passes.empty()) words.insert(words.end(), {"--passes", fmt::format("{}", fmt::join(plan.pack.passes, ","))});
  for (const std::string& o : open.cells.overrides(cell)) words.insert(words.end(), {"--set", o});
  const Ran ran(writer, words);
  if (ran.code() != 0) ran.fail();
  take_files(writer, "pack");
  return finish(writer, cell, ran, "", names);
}

sweep::Made judge(const OpenPlan& open, const sweep::Cell& cell, int threads, sweep::Names& names) {
  const sweep::JudgingAsked& j = open.plan->judging;
  const bool is_validate = open.plan->verb == sweep::Verb::validate;
  sweep::CellWriter writer(open.store.cell(cell.id));
  std::vector<std::string> words{
      sweep::name(open.plan->verb), j.packs[cell.scene].text, "--profile", j.profiles[cell.rows[0]].text, "--threads",
      std::to_string(threads)};
  if (!j.only.empty()) words.insert(words.end(), {"--only", fmt::format("{}", fmt::join(j.only, ","))});
  if (is_validate) {
    words.insert(words.end(), {"--json", path_text(writer.folder() / "report.json")});
    if (!j.port.empty()) words.insert(words.end(), {"--port", j.port});
    if (!j.exec.empty())
      words.insert(words.end(), {"--exec", j.exec, "--timeout", std::to_string(j.timeout), "--repeat", std::to_string(j.repeat)});
  }
  const Ran ran(writer, words);
  constexpr std::array verdicts{"pass", "fail", "", "port files"};
  if (ran.code() < 0 || ran.code() > 3 || ran.code() == 2) ran.fail();
  std::error_code error;
  if (is_validate && fs::exists(writer.folder() / "report.json", error)) writer.wrote("report.json");
  return finish(writer, cell, ran, verdicts[static_cast<std::size_t>(ran.code())], names);
}

}  // namespace

sweep::Maker cell_maker(const OpenPlan& open, const parallel::Executor& executor) {
  switch (open.plan->verb) {
    case sweep::Verb::run:
    case sweep::Verb::hash: {
      const auto said = std::make_shared<std::set<std::string>>();
      const auto warn = [said](const std::string& warning) {
        if (said->insert(warning).second) complain("warning: " + warning);
      };
      return [&open, &executor, warn](const sweep::Cell& cell, sweep::Names& names) {
        return sweep::make_frames(open.cells, cell, open.store, executor, names, warn);
      };
    }
    case sweep::Verb::pack:
      return [&open, threads = executor.threads()](const sweep::Cell& cell, sweep::Names& names) {
        return make_pack(open, cell, threads, names);
      };
    case sweep::Verb::validate:
    case sweep::Verb::mutate:
      break;
  }
  return [&open, threads = executor.threads()](const sweep::Cell& cell, sweep::Names& names) { return judge(open, cell, threads, names); };
}

}  // namespace rainref::cli
