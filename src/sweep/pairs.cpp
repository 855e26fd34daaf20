#include "sweep/pairs.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.h"
#include "base/path_text.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& message) {
  throw Error(ExitCode::usage, fmt::format("{}: {}", option, message));
}
void require_one_of(const char* option, const char* what, const std::string& found, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), found) == known.end())
    refuse(option, fmt::format("expected {}, one of {}, found '{}'{}", what, fmt::join(known, ", "), found, did_you_mean(found, known)));
}

/// The axis with the labels.
std::size_t axis_of_labels(const Plan& plan) {
  for (std::size_t i = 0; i < plan.axes.size(); ++i)
    if (std::find(plan.axes[i].keys.begin(), plan.axes[i].keys.end(), label_key) != plan.axes[i].keys.end()) return i;
  refuse("--pairs", fmt::format("expected a plan whose cases have a column '{}', found none in {}", label_key, path_text(plan.file)));
}
std::string label_of(const Cells& cells, const Cell& cell) {
  for (const auto& [key, value] : cells.values(cell))
    if (key == label_key) return value;
  return "";
}

void check_keep(const Plan& plan, const PairsAsked& asked) {
  const auto is_picture = [](const Keep& keep) { return keep.what == Keep::What::picture; };
  if (std::none_of(plan.keep.begin(), plan.keep.end(), is_picture))
    refuse("--pairs", fmt::format("expected 'picture' in keep of {}, found none", path_text(plan.file)));
  if (asked.mask.empty()) return;
  std::vector<std::string> channels;
  for (const Keep& keep : plan.keep)
    if (keep.what == Keep::What::exr && !keep.part.empty()) channels.push_back(keep.part);
  if (channels.empty()) refuse("--mask", fmt::format("expected 'exr:{}' in keep of {}, found none", asked.mask, path_text(plan.file)));
  require_one_of("--mask", "a channel that the plan keeps with 'exr:'", asked.mask, channels);
}

}  // namespace

bool is_train(std::string_view film, double share, std::int64_t seed) {
  // 52 bits, which a double holds.
  const std::string digits = id_of(fmt::format("rainref split {} {}", seed, film)).substr(0, 13);
  return static_cast<double>(whole_from<std::uint64_t>(digits, 16).value()) * 0x1p-52 < share;
}

std::vector<Pair> pairs_of(const Cells& cells, const PairsAsked& asked) {
  const Plan& plan = cells.plan();
  check_keep(plan, asked);
  const std::size_t axis = axis_of_labels(plan);
  std::vector<std::string> labels;
  for (const Cell& cell : cells.all())
    if (const std::string label = label_of(cells, cell); std::find(labels.begin(), labels.end(), label) == labels.end())
      labels.push_back(label);
  for (const std::string* label : {&asked.clean, &asked.rainy}) require_one_of("--pairs", "two labels of the plan", *label, labels);
  if (asked.clean == asked.rainy) refuse("--pairs", fmt::format("expected two labels, found '{}' twice", asked.clean));
  using Place = std::tuple<std::uint32_t, std::vector<std::uint32_t>, std::int64_t>;
  const auto place_of = [&](const Cell& cell) {
    Place place{cell.scene, cell.rows, cell.first};
    std::get<1>(place)[axis] = 0;
    return place;
  };
  std::map<Place, std::size_t> clean;
  for (std::size_t i = 0; i < cells.all().size(); ++i) {
    if (label_of(cells, cells.all()[i]) != asked.clean) continue;
    if (!clean.try_emplace(place_of(cells.all()[i]), i).second)
      refuse("--pairs", fmt::format("expected one case with the label '{}', found several", asked.clean));
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < cells.all().size(); ++i) {
    const Cell& cell = cells.all()[i];
    if (label_of(cells, cell) != asked.rainy) continue;
    // Another number of frames makes other chunks.
    const auto same = clean.find(place_of(cell));
    if (same == clean.end() || cells.all()[same->second].end != cell.end)
      refuse("--pairs", fmt::format("expected a cell '{}' with the same frames for {}, found none", asked.clean, cells.words(cell)));
    pairs.push_back({same->second, i, is_train(cells.all()[same->second].film, asked.split, asked.split_seed)});
  }
  return pairs;
}

}  // namespace rainref::sweep
