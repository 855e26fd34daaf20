// `rainref sweep collect`.
#include <algorithm>
#include <fstream>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/folders.h"
#include "cli/port_command.h"
#include "cli/progress.h"
#include "cli/sweep.h"
#include "cli/terminal.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "sweep/database.h"
#include "sweep/sheet.h"
#include "sweep/table.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

/// id,host,seconds,bytes,begun at: of this plan's cells, sorted; nothing that is the same twice.
std::string timings_csv(const OpenPlan& open) {
  std::map<std::string, std::size_t> ours;
  for (std::size_t i = 0; i < open.cells.all().size(); ++i) ours[open.cells.all()[i].id] = i;
  std::vector<std::pair<std::size_t, std::string>> lines;
  std::error_code error;
  for (fs::directory_iterator i(open.store.root() / "log", error), end; !error && i != end; i.increment(error)) {
    std::ifstream in(i->path());
    for (std::string line; std::getline(in, line);)
      if (const auto cell = ours.find(line.substr(0, line.find(','))); cell != ours.end()) lines.emplace_back(cell->second, line);
  }
  std::sort(lines.begin(), lines.end());
  std::string text = "cell,id,host,seconds,bytes,begun_at\n";
  for (const auto& [cell, line] : lines) text += fmt::format("{},{}\n", cell, line);
  return text;
}

/// A shell's word for a plain path.
std::string quoted(const fs::path& path) {
  std::string out = "'";
  for (const char c : path.string()) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// The pictures of the first run in order, as a film. Says why there is none.
std::string write_film(const OpenPlan& open, const sweep::Table& table, const fs::path& folder) {
  const std::vector<sweep::Cell>& cells = open.cells.all();
  std::string list;
  int pictures = 0;
  double fps = 60;
  for (std::size_t i = 0; i < cells.size() && cells[i].film == cells[0].film && !cells[0].film.empty(); ++i) {
    if (i == 0) fps = open.cells.config(cells[0]).real("run.fps");
    for (const sweep::KeptFile& f : table.rows[i].files) {
      if (!f.path.starts_with("picture.") || !f.path.ends_with(".png")) continue;
      list += (open.store.cell(cells[i].id) / f.path).string() + "\n";
      ++pictures;
    }
  }
  if (pictures < 2) return "no film: the first run has fewer than two pictures";
  write_file(folder / "film.txt", list);
  const fs::path made = folder / ".film.mp4";
  const CommandEnd end = run_command(
      fmt::format(
          "command -v ffmpeg >/dev/null || {{ echo ffmpeg is not installed; exit 1; }}; xargs -d '\\n' cat <{} | ffmpeg -loglevel error -y "
          "-f image2pipe -c:v png -framerate {} -i - -vf pad='ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p -threads 1 -fflags +bitexact "
          "-flags:v +bitexact {}",
          quoted(folder / "film.txt"), fps, quoted(made)),
      std::chrono::hours(24));
  if (!end.failure.empty()) return fmt::format("no film: {}", end.last_lines.empty() ? end.failure : end.last_lines.back());
  std::error_code error;
  fs::rename(made, folder / "film.mp4", error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: {}", (folder / "film.mp4").string(), error.message()));
  return fmt::format("film.mp4 of {} pictures", pictures);
}

}  // namespace

int sweep_collect(const SweepOptions& options) {
  const OpenPlan open(options.plan, options.out);
  const sweep::Table table = sweep::read_table(open.cells, open.store);
  const fs::path folder = open.tables();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: cannot make this folder: {}", folder.string(), error.message()));
  write_file(folder / "table.csv", sweep::table_csv(open.cells, table));
  sweep::write_database(folder / "table.sqlite", open.cells, table);
  write_file(folder / "films.csv", sweep::films_csv(table));
  write_file(folder / "timings.csv", timings_csv(open));
  std::string more;
  if (options.with_sheet) {
    const Image sheet = sweep::contact_sheet(open.cells, table, open.store);
    if (!sheet.empty()) {
      image_io::write_png(folder / "sheet.png", sheet);
      more += ", sheet.png";
    }
  }
  if (options.with_film) more += ", " + write_film(open, table, folder);
  for (const sweep::Row& row : table.rows)
    if (row.state == sweep::State::damaged) say("damaged: {}\n", row.sentence);
  std::string counts;
  for (const sweep::State s :
       {sweep::State::done, sweep::State::missing, sweep::State::refused, sweep::State::failed, sweep::State::damaged})
    if (const auto n = table.count(s); n > 0) counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", n, sweep::name(s));
  say("{}: {}; table.csv, table.sqlite, films.csv, timings.csv{} in {}\n", counted(static_cast<long long>(table.rows.size()), "cell"),
      counts, more, folder.string());
  return table.count(sweep::State::done) == static_cast<std::int64_t>(table.rows.size()) ? 0 : 1;
}

}  // namespace rainref::cli
