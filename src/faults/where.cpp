// Where a pass fails: one sentence, if its failures share a region.
#include "faults/diagnose.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "faults/probe.h"
#include "faults/text.h"
#include "judge/invocation_judge.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::CaseJudgement;
using judge::FailedRun;
using judge::OutputJudgement;
using judge::Slot;

// A region is named if nearly all failures are in it, and if it covers at most about half of all judged elements (a little more, because
// the even columns of an odd width are). The probability that independent failures would lie in it so completely must be below 10^-6. The
// smallest region is named.
constexpr double nearly_all = 0.99, largest_share = 0.51, least_chance = 1e-6;

struct Share {
  std::int64_t inside = 0, of = 0;
  double value() const { return of > 0 ? static_cast<double>(inside) / static_cast<double>(of) : 0; }
};
bool is_where(const Share& failing, const Share& all) {
  if (failing.of == 0 || failing.value() < nearly_all || all.value() > largest_share) return false;
  double chance = 1;
  for (std::int64_t k = 0; k < failing.inside && chance > least_chance; ++k) chance *= all.value();
  return chance <= least_chance;
}

struct Place {
  std::string words;
  std::function<bool(Texel)> holds;
};

void add_edges(std::vector<Place>& out, int width, int height) {
  out.push_back({"the first column", [](Texel t) { return t.x == 0; }});
  out.push_back({"the last column", [width](Texel t) { return t.x == width - 1; }});
  out.push_back({"the first row", [](Texel t) { return t.y == 0; }});
  out.push_back({"the last row", [height](Texel t) { return t.y == height - 1; }});
  for (const int n : {1, 2, 3, 4, 8, 16})
    out.push_back({n == 1 ? "the outermost texels" : fmt::format("a border of {} texels", n),
                   [=](Texel t) { return t.x < n || t.y < n || t.x >= width - n || t.y >= height - n; }});
  out.push_back({"the lower half of the rows", [height](Texel t) { return 2 * t.y < height; }});
  out.push_back({"the upper half of the rows", [height](Texel t) { return 2 * t.y >= height; }});
  out.push_back({"the left half of the columns", [width](Texel t) { return 2 * t.x < width; }});
  out.push_back({"the right half of the columns", [width](Texel t) { return 2 * t.x >= width; }});
}
void add_groups(std::vector<Place>& out, int width, int height) {
  for (const int odd : {0, 1}) {
    const char* const word = odd ? "odd" : "even";
    out.push_back({fmt::format("{} columns", word), [odd](Texel t) { return t.x % 2 == odd; }});
    out.push_back({fmt::format("{} rows", word), [odd](Texel t) { return t.y % 2 == odd; }});
    out.push_back(
        {fmt::format("texels whose column and row add to an {} number", word), [odd](Texel t) { return (t.x + t.y) % 2 == odd; }});
  }
  for (const int side : {8, 16}) {
    for (const int x : {0, side - 1})
      for (const int y : {0, side - 1})
        out.push_back({fmt::format("texel ({}, {}) of every {}x{} group", x, y, side, side),
                       [=](Texel t) { return t.x % side == x && t.y % side == y; }});
    for (const int end : {0, side - 1}) {
      const char* const word = end ? "last" : "first";
      out.push_back({fmt::format("the {} column of every {}x{} group", word, side, side), [=](Texel t) { return t.x % side == end; }});
      out.push_back({fmt::format("the {} row of every {}x{} group", word, side, side), [=](Texel t) { return t.y % side == end; }});
    }
    out.push_back({fmt::format("the borders of {}x{} groups", side, side),
                   [=](Texel t) { return t.x % side == 0 || t.y % side == 0 || t.x % side == side - 1 || t.y % side == side - 1; }});
    out.push_back({fmt::format("what lies beyond the last whole {}x{} group", side, side),
                   [=](Texel t) { return t.x >= width / side * side || t.y >= height / side * side; }});
  }
}

/// Masks of a channel of an image as large as the run: above, at, or below 0.
void add_masks(std::vector<Place>& out, const std::string& name, const Array& a, int width, int height) {
  if (a.is_records || a.levels.size() != 1 || a.width != width || a.height != height) return;
  const auto texels = std::make_shared<const std::vector<float>>(capture::decoded(a));
  const int channels = info(a.format).channels;
  for (int k = 0; k < channels; ++k) {
    const auto value = [=](Texel t) { return (*texels)[static_cast<std::size_t>((t.y * width + t.x) * channels + k)]; };
    const std::string part = channels == 1 ? name : fmt::format("{}.{}", name, "xyzw"[k]);
    out.push_back({fmt::format("where {} > 0", part), [value](Texel t) { return value(t) > 0; }});
    out.push_back({fmt::format("where {} is 0", part), [value](Texel t) { return value(t) == 0; }});
    out.push_back({fmt::format("where {} < 0", part), [value](Texel t) { return value(t) < 0; }});
  }
}

/// Centres of records, in texels of the run.
struct Centre {
  float x, y, radius;  ///< 0: none
};
std::vector<Centre> centres_of(const Array& list, int width, int height) {
  std::optional<std::size_t> x, y, radius;
  std::string unit;
  for (const scene::Member& m : list.record.members) {
    if (m.scalar != scene::Scalar::float32) continue;
    if (m.name == "x") x = m.offset, unit = m.unit;
    if (m.name == "y") y = m.offset;
    if (m.name == "position" && m.components >= 2) x = m.offset, y = m.offset + 4, unit = m.unit;
    if (m.name == "radius") radius = m.offset;
  }
  if (!x || !y || (unit != "texel" && unit != "texels" && unit != "1")) return {};
  const float scale_x = unit == "1" ? static_cast<float>(width) : 1.0f, scale_y = unit == "1" ? static_cast<float>(height) : 1.0f;
  std::vector<Centre> out;
  for (std::size_t r = 0; r + list.record.size <= list.levels[0].size(); r += list.record.size) {
    const auto number = [&](std::size_t offset) {
      float v;
      std::memcpy(&v, list.levels[0].data() + r + offset, 4);
      return v;
    };
    out.push_back({number(*x) * scale_x, number(*y) * scale_y, radius ? number(*radius) * scale_x : 0});
  }
  return out;
}
void add_records(std::vector<Place>& out, const std::string& name, const Array& list, int width, int height) {
  const std::vector<Centre> centres = centres_of(list, width, height);
  if (centres.empty() || centres.size() > 4096) return;
  const auto near = [centres](Texel t, auto radius) {
    return std::any_of(centres.begin(), centres.end(), [&](const Centre& c) {
      const float dx = static_cast<float>(t.x) + 0.5f - c.x, dy = static_cast<float>(t.y) + 0.5f - c.y, r = radius(c);
      return dx * dx + dy * dy <= r * r;
    });
  };
  if (centres.front().radius > 0)
    out.push_back({fmt::format("within the radius of a record of {}", name),
                   [near](Texel t) { return near(t, [](const Centre& c) { return c.radius; }); }});
  for (const int r : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48})
    out.push_back({fmt::format("within {} texel{} of a record of {}", r, r == 1 ? "" : "s", name),
                   [near, r](Texel t) { return near(t, [r](const Centre&) { return static_cast<float>(r); }); }});
}

std::string texels_text(const FailedRun& failed, const std::vector<Texel>& failing) {
  const capture::PassCase& c = failed.run.c;
  const int width = failed.model->width(), height = failed.model->height();
  std::vector<Place> places;
  add_edges(places, width, height);
  add_groups(places, width, height);
  for (const capture::CaseInput& in : c.inputs) {
    if (in.array.is_records)
      add_records(places, in.name, in.array, width, height);
    else
      add_masks(places, in.name, in.array, width, height);
  }
  for (const capture::CaseOutput& o : c.outputs)
    if (!c.input(o.name)) add_masks(places, o.name, o.array, width, height);

  const std::vector<Texel> some = spread(failing, 1000);
  std::vector<Texel> all;
  const std::int64_t count = static_cast<std::int64_t>(width) * height, taken = std::min<std::int64_t>(count, 10000);
  for (std::int64_t k = 0; k < taken; ++k)
    all.push_back({static_cast<int>(k * count / taken % width), static_cast<int>(k * count / taken / width)});
  std::string best;
  double least = 2;
  for (const Place& p : places) {
    const auto share = [&](const std::vector<Texel>& texels) {
      return Share{std::count_if(texels.begin(), texels.end(), p.holds), static_cast<std::int64_t>(texels.size())};
    };
    const Share of_failing = share(some);
    if (of_failing.value() < nearly_all) continue;
    const Share of_all = share(all);
    if (!is_where(of_failing, of_all) || of_all.value() >= least) continue;
    least = of_all.value();
    best = p.words;
  }
  return best;
}

/// The only channel, or the only output, with failures.
std::string channel_text(const FailedRun& failed, const std::vector<Texel>& failing) {
  const std::vector<Slot> slots = judge::slots_of(failed.run.c);
  if (slots.size() < 2) return "";
  const judge::InvocationJudge judged(failed.run.c, *failed.model, *failed.options.profile, failed.half_mode);
  std::vector<std::int64_t> outside(slots.size(), 0);
  std::int64_t sum = 0;
  for (const Texel t : spread(failing, 200)) {
    const std::vector<char> of_texel = judged.outside(t.x, t.y, failed.run.stored, &failed.run.kept);
    for (std::size_t s = 0; s < slots.size(); ++s) outside[s] += of_texel[s], sum += of_texel[s];
  }
  const std::size_t most = static_cast<std::size_t>(std::max_element(outside.begin(), outside.end()) - outside.begin());
  const auto slot_count = static_cast<std::int64_t>(slots.size());
  const std::string& output = failed.run.c.outputs[static_cast<std::size_t>(slots[most].output)].name;
  if (is_where({outside[most], sum}, {1, slot_count})) return fmt::format("channel {} of {}", "xyzw"[slots[most].channel & 3], output);
  Share of_output{0, sum}, of_slots{0, slot_count};
  for (std::size_t s = 0; s < slots.size(); ++s)
    if (slots[s].output == slots[most].output) of_output.inside += outside[s], ++of_slots.inside;
  return is_where(of_output, of_slots) ? output : "";
}

/// For a pass that runs for each mip level or in several steps: the runs that fail.
std::string runs_text(const FailedRun& failed) {
  std::set<int> failing_levels, levels;
  std::vector<char> fails;
  for (const CaseJudgement& c : failed.judged.cases) {
    const int level = mip_level(c.id);
    levels.insert(level);
    if (c.failing > 0) failing_levels.insert(level);
    fails.push_back(c.failing > 0);
  }
  if (failing_levels.size() == 1 && levels.size() > 2 && *failing_levels.begin() >= 0)
    return fmt::format("mip level {}", *failing_levels.begin());
  if (levels.size() > 1 || fails.size() < 3) return "";
  const auto count = std::count(fails.begin(), fails.end(), 1);
  if (count == 1 && fails.front()) return "the first run";
  if (count == static_cast<std::ptrdiff_t>(fails.size()) - 1 && !fails.front()) return "every run but the first";
  return "";
}

/// The only field of records that is wrong, if all failures are listed.
std::string fields_text(const CaseJudgement& j) {
  std::set<std::string> fields;
  for (const OutputJudgement& o : j.outputs) {
    if (o.failing == 0) continue;
    if (o.counted != judge::Counted::fields || static_cast<std::int64_t>(o.worst.size()) < std::min<std::int64_t>(o.failing, 100))
      return "";
    for (const judge::Failure& f : o.worst) fields.insert(f.field.empty() ? "" : fmt::format("{} of {}", f.field, o.name));
  }
  return fields.size() == 1 ? *fields.begin() : "";
}

}  // namespace

std::string where_it_fails(const FailedRun& failed) {
  std::vector<std::string> parts{runs_text(failed)};
  if (failed.model && judge::is_enveloped(failed.run.c)) {
    const std::vector<Texel> failing = failing_texels(failed.judgement);
    if (!failing.empty()) {
      parts.push_back(channel_text(failed, failing));
      parts.push_back(texels_text(failed, failing));
    }
  }
  if (const std::string field = fields_text(failed.judgement); !field.empty()) parts.push_back("the field " + field);
  std::string out;
  for (const std::string& p : parts)
    if (!p.empty()) out += (out.empty() ? "only " : "; only ") + p;
  return out;
}

}  // namespace rainref::faults
