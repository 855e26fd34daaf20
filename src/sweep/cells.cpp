#include "sweep/cells.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "base/read_file.h"
#include "effect/inputs.h"
#include "rainref/version.h"
#include "registry/registry.h"
#include "scene/presets.h"
#include "scene/toml.h"
#include "scene/toml_reader.h"
#include "scene/value_text.h"
#include "simulation/opened.h"
#include "simulation/picture_notes.h"
#include "sweep/axes.h"
#include "sweep/command_files.h"

namespace rainref::sweep {
namespace {

std::string text_of(const scene::Override& o) {
  if (const auto* text = std::get_if<std::string>(&o.value)) return *text;
  const scene::RawValue& v = std::get<scene::RawValue>(o.value);
  if (const auto* text = std::get_if<std::string>(&v.data)) return *text;
  if (const auto* real = std::get_if<double>(&v.data)) return scene::real_text(*real);
  return v.text();
}

/// A file that the plan names is relative to it.
void place(scene::Override& o, const std::filesystem::path& folder) {
  if (!effect::names_files(o.key)) return;
  std::string* text = std::get_if<std::string>(&o.value);
  if (!text) text = std::get_if<std::string>(&std::get<scene::RawValue>(o.value).data);
  if (text && !text->empty() && utf8_path(*text).is_relative())
    *text = path_text(std::filesystem::absolute(folder / utf8_path(*text)).lexically_normal());
}

/// Checks that the effect has the buffers that a plan keeps, and that the scene makes the drops' channels.
void check_keep(const Plan& plan, const scene::Config& config) {
  for (const Keep& keep : plan.keep) {
    const bool is_of_drops = keep.part.starts_with("drops.") || keep.part.starts_with("offset.");
    if (keep.what == Keep::What::exr && is_of_drops && !config.boolean("picture.layer"))
      throw Error(ExitCode::usage, keep.at, fmt::format("keep: expected picture.layer = true for 'exr:{}', found false", keep.part));
    if (keep.what != Keep::What::buffer) continue;
    std::vector<std::string> known;
    for (const capture::BufferInfo& b : registry::find(config.effect())->info->buffers)
      if (b.variant.empty() || b.variant == config.variant()) known.push_back(b.name);
    if (std::find(known.begin(), known.end(), keep.part) == known.end())
      throw Error(ExitCode::usage, keep.at,
                  fmt::format("keep: expected a buffer of {} {}, one of {}, found '{}'{}", config.effect(), config.variant(),
                              fmt::join(known, ", "), keep.part, did_you_mean(keep.part, known)));
  }
}

/// The kept data of these frames, independent of the plan's wording and order.
std::string kept_text(const Plan& plan, const Cell& cell) {
  std::vector<std::string> all;
  for (const Keep& keep : plan.keep) {
    if (keep.what == Keep::What::hash || keep.every > 0)
      all.push_back(keep.text());
    else if (cell.end == cell.frames)
      all.push_back(fmt::format("{}@frame={}", keep.text(), cell.frames - 1));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return fmt::format("keep {}\n", fmt::join(all, " "));
}

}  // namespace

Cells::Cells(const Plan& plan, const Planned& planned) : plan_(plan) {
  const bool is_judging = plan.verb == Verb::validate || plan.verb == Verb::mutate;
  for (const Placed& file : plan.scenes) {
    try {
      const std::string text = simulation::scene_text(utf8_path(file.text));
      scenes_.push_back(scene::read_toml(text, file.text));
      scene_ids_.push_back(id_of(text));
    } catch (const Error& e) {
      if (e.code() != ExitCode::io) throw;
      throw Error(e.code(), file.at, fmt::format("scene: {}", e.what()));
    }
  }
  std::vector<std::uint32_t> counts;
  if (is_judging)
    counts.push_back(static_cast<std::uint32_t>(plan.judging.profiles.size()));
  else
    for (const Axis& axis : plan.axes) counts.push_back(static_cast<std::uint32_t>(axis.rows.size()));
  double cells = static_cast<double>(is_judging ? plan.judging.packs.size() : plan.scenes.size());
  for (const std::uint32_t n : counts) cells *= n;
  if (cells > static_cast<double>(most_cells))
    throw Error(ExitCode::usage, SourceLocation{path_text(plan.file)},
                fmt::format("axes: expected at most {} cells, found {:.0f}", most_cells, cells));
  const auto points = static_cast<std::int64_t>(cells);
  std::int64_t done = 0;
  std::optional<scene::Config> config;  // of the previous combination
  Cell before;
  const bool has_keys_anew = std::any_of(plan.axes.begin(), plan.axes.end(), [](const Axis& axis) {
    return std::any_of(axis.keys.begin(), axis.keys.end(),
                       [](const std::string& key) { return key == "effect" || key == "variant" || key == scene::preset_word; });
  });
  Cell point;
  for (const std::uint32_t scenes = static_cast<std::uint32_t>(is_judging ? plan.judging.packs.size() : plan.scenes.size());
       point.scene < scenes; ++point.scene) {
    point.rows.assign(counts.size(), 0);
    for (bool has_more = true; has_more;) {
      if (is_judging) {
        add_judged(point);
      } else {
        if (config && !has_keys_anew && before.scene == point.scene) {
          change(*config, before, point);
        } else {
          config = this->config(point);
          check_keep(plan_, *config);
        }
        add_simulated(point, *config);
        before = point;
      }
      if (planned) planned(++done, points);
      has_more = false;
      for (std::size_t i = counts.size(); i-- > 0 && !has_more;) {  // the last axis varies fastest
        has_more = ++point.rows[i] < counts[i];
        if (!has_more) point.rows[i] = 0;
      }
    }
  }
}

std::vector<scene::Override> Cells::said(const Cell& cell) const {
  std::vector<scene::Override> all = plan_.set;
  for (std::size_t i = 0; i < plan_.axes.size(); ++i) {
    for (const scene::Override& o : plan_.axes[i].rows[cell.rows[i]])
      if (o.key != label_key) all.push_back(o);
  }
  for (scene::Override& o : all) place(o, plan_.file.parent_path());
  return all;
}

scene::Config Cells::config(const Cell& cell) const {
  return scene::parse(scenes_[cell.scene], utf8_path(plan_.scenes[cell.scene].text), said(cell), simulation::effect_table());
}

void Cells::change(scene::Config& config, const Cell& from, const Cell& to) const {
  for (std::size_t i = 0; i < plan_.axes.size(); ++i) {
    if (from.rows[i] == to.rows[i]) continue;
    for (scene::Override o : plan_.axes[i].rows[to.rows[i]]) {
      if (o.key == label_key) continue;
      place(o, plan_.file.parent_path());
      scene::give(config, o);
    }
  }
}

std::vector<std::string> Cells::overrides(const Cell& cell) const {
  std::vector<std::string> all;
  for (const scene::Override& o : said(cell)) {
    const auto* v = std::get_if<scene::RawValue>(&o.value);
    const auto* list = v ? std::get_if<std::vector<scene::RawValue>>(&v->data) : nullptr;
    std::string text = text_of(o);
    if (list) {
      std::vector<std::string> parts;
      for (const scene::RawValue& part : *list) parts.push_back(text_of({"", part, {}}));
      text = fmt::format("[{}]", fmt::join(parts, ", "));
    }
    all.push_back(o.key + "=" + text);
  }
  return all;
}

std::vector<std::pair<std::string, std::string>> Cells::values(const Cell& cell) const {
  const bool is_judging = plan_.scenes.empty();
  if (is_judging) {
    return {{"pack", plan_.judging.packs[cell.scene].name}, {"profile", plan_.judging.profiles[cell.rows[0]].text}};
  }
  std::vector<std::pair<std::string, std::string>> all{{"scene", plan_.scenes[cell.scene].name}};
  for (std::size_t i = 0; i < plan_.axes.size(); ++i)
    for (const scene::Override& o : plan_.axes[i].rows[cell.rows[i]]) all.emplace_back(o.key, text_of(o));
  return all;
}

std::string Cells::words(const Cell& cell) const {
  std::vector<std::string> parts;
  for (const auto& [key, value] : values(cell)) parts.push_back(key + " " + value);
  if (plan_.chunk > 0) parts.push_back(fmt::format("frames {} to {}", cell.first, cell.end - 1));
  return fmt::format("{}", fmt::join(parts, ", "));
}

void Cells::add_simulated(Cell point, const scene::Config& config) {
  simulation::memory_of(config);  // reads the settings, and so refuses combinations of keys that are invalid
  point.frames = config.integer("run.frames");
  if (plan_.first >= point.frames)
    throw Error(ExitCode::usage, SourceLocation{path_text(plan_.file)},
                fmt::format("frames: expected a first frame before run.frames {}, found {}", point.frames, plan_.first));
  std::string text = fmt::format("rainref cell 1\nbits {}\n", golden_hash()) + inputs_.text_of(config);
  if (plan_.verb == Verb::pack) {
    text += fmt::format("scene {} {}\nframes {}\nat {}\npasses {}\n", path_text(utf8_path(plan_.scenes[point.scene].text).filename()),
                        scene_ids_[point.scene], point.frames, fmt::join(plan_.pack.at, " "), fmt::join(plan_.pack.passes, " "));
    point.end = point.frames;
    point.id = id_of("pack\n" + text);
    return add(point);
  }
  point.film = id_of(text);
  const std::int64_t chunk = plan_.chunk > 0 ? plan_.chunk : point.frames;
  for (point.first = plan_.first; point.first < point.frames; point.first = point.end) {
    point.end = std::min(point.first + chunk, point.frames);
    point.id = id_of(fmt::format("{}frames {} {}\n{}", text, point.first, point.end, kept_text(plan_, point)));
    add(point);
  }
}

void Cells::add_judged(Cell point) {
  const JudgingAsked& j = plan_.judging;
  const Placed& pack = j.packs[point.scene];
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(utf8_path(pack.text) / "manifest.json", ignored))
    throw Error(ExitCode::io, pack.at, fmt::format("pack: expected the folder of a pack, found no {}/manifest.json", pack.text));
  std::string text =
      fmt::format("rainref cell 1\nbits {}\nverb {}\npack {}\nprofile {}\nonly {}\nlabel {}\n", golden_hash(), name(plan_.verb),
                  inputs_.folder_hash(utf8_path(pack.text)), j.profiles[point.rows[0]].text, fmt::join(j.only, " "), j.label);
  if (plan_.verb == Verb::validate) {
    text += fmt::format("exec {}\nrepeat {}\nport {}\n", j.exec, j.repeat,
                        j.port.empty() || !j.exec.empty() ? j.port : inputs_.folder_hash(utf8_path(j.port)));
    for (const std::filesystem::path& file : files_named_by(j.exec)) text += fmt::format("exec holds {}\n", inputs_.bytes_hash(file));
  }
  point.id = id_of(text);
  add(point);
}

void Cells::add(Cell cell) {
  if (static_cast<std::int64_t>(cells_.size()) == most_cells)
    throw Error(ExitCode::usage, SourceLocation{path_text(plan_.file)},
                fmt::format("chunk: expected at most {} cells, found more", most_cells));
  const auto [same, is_new] = by_id_.try_emplace(cell.id, cells_.size());
  if (!is_new)
    throw Error(ExitCode::usage, SourceLocation{path_text(plan_.file)},
                fmt::format("two cells are the same: {}; and {}", words(cells_[same->second]), words(cell)));
  cells_.push_back(std::move(cell));
}

}  // namespace rainref::sweep
