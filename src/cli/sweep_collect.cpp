// `rainref sweep collect`.
#include <algorithm>
#include <fstream>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/folders.h"
#include "base/hidden.h"
#include "base/path_text.h"
#include "capture/new_folder.h"
#include "cli/progress.h"
#include "cli/sweep.h"
#include "cli/terminal.h"
#include "image_io/film.h"
#include "image_io/read.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "sweep/data_set.h"
#include "sweep/database.h"
#include "sweep/sheet.h"
#include "sweep/table.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

/// Columns id,host,seconds,bytes,begun at, for this plan's cells, sorted, without duplicates.
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

/// The scene's speed, if every K-th frame is kept.
image_io::FilmRate film_rate_of(const OpenPlan& open) {
  std::int64_t every = 0;
  for (const sweep::Keep& keep : open.cells.plan().keep)
    if (keep.what == sweep::Keep::What::picture && keep.every > 0) every = std::gcd(every, keep.every);
  return {open.cells.config(open.cells.all()[0]).real("run.fps"), static_cast<int>(std::max<std::int64_t>(every, 1))};
}

/// Writes the pictures of the first run in order as a film. Returns a message if that is impossible.
std::string write_film(const OpenPlan& open, const sweep::Table& table, const fs::path& folder) {
  const std::vector<sweep::Cell>& cells = open.cells.all();
  std::vector<fs::path> pictures;
  for (std::size_t i = 0; i < cells.size() && cells[i].film == cells[0].film && !cells[0].film.empty(); ++i) {
    for (const sweep::KeptFile& f : table.rows[i].files)
      if (f.path.starts_with("picture.") && f.path.ends_with(".png")) pictures.push_back(open.store.cell(cells[i].id) / utf8_path(f.path));
  }
  if (pictures.size() < 2) return "no film: the first run has fewer than two pictures";
  try {
    std::optional<image_io::Film> film;
    for (const fs::path& picture : pictures) {
      const Image image = image_io::read(picture).image;
      if (!film) film.emplace(folder / "film.mp4", image.width(), image.height(), film_rate_of(open));
      film->add(image);
    }
    film->finish();
    return fmt::format("film.mp4 of {} pictures", film->pictures());
  } catch (const Error& e) {
    return fmt::format("no film: {}", e.what());
  }
}

/// The folder that will hold the data set; refused before any work if there is one.
std::optional<capture::NewFolder> new_data_set(const SweepOptions& options, const fs::path& folder) {
  if (!options.pairs) return std::nullopt;
  return std::optional<capture::NewFolder>(std::in_place, folder, [](const fs::path&) {
    return "the folder is not empty, and a data set replaces none: --to names another folder";
  });
}

}  // namespace

int sweep_collect(const SweepOptions& options) {
  const OpenPlan open(options.plan, options.out);
  const std::vector<sweep::Pair> pairs = options.pairs ? sweep::pairs_of(open.cells, *options.pairs) : std::vector<sweep::Pair>();
  const fs::path data_set = options.to.empty() ? open.tables() / "pairs" : options.to;
  std::optional<capture::NewFolder> new_folder = new_data_set(options, data_set);
  const sweep::Table table = sweep::read_table(open.cells, open.store);
  const fs::path folder = open.tables();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: cannot make this folder: {}", path_text(folder), error.message()));
  remove_leftovers(folder);
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
      counts, more, path_text(folder));
  const bool is_whole = table.count(sweep::State::done) == static_cast<std::int64_t>(table.rows.size());
  if (new_folder && !is_whole) say("no data set: it needs every cell\n");
  if (new_folder && is_whole) {
    const sweep::DataSetFigures figures = sweep::write_data_set(open.cells, table, open.store, *options.pairs, pairs, *new_folder);
    new_folder->commit();
    say("{}in {}\n", sweep::figures_text(figures), path_text(data_set));
  }
  return is_whole ? 0 : 1;
}

}  // namespace rainref::cli
