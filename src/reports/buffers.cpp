#include "reports/buffers.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/difference.h"
#include "image/code_range.h"
#include "judge/quantities.h"
#include "reports/figures.h"
#include "reports/pictures.h"

namespace rainref::reports {
namespace {

using judge::Failure;
using judge::OutputJudgement;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::Status;
using Json = nlohmann::ordered_json;

constexpr std::size_t shown_fields = 40;

std::string data_uri(const std::vector<std::byte>& png) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out = "data:image/png;base64,";
  out.reserve(out.size() + (png.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < png.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < png.size() ? std::to_integer<unsigned>(png[i + k]) : 0u; };
    const unsigned word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= png.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// A colour for each doubling, from the lowest difference to the highest.
Json scale_of(const View& v) {
  Json colours = Json::array();
  const auto add = [&](std::int64_t codes) { colours.push_back(difference_colour(codes, v.largest)); };
  const int steps = std::bit_width(v.largest);
  for (int k = steps - 1; k >= 0; --k) add(-(std::int64_t{1} << k));
  add(0);
  for (int k = 0; k < steps; ++k) add(std::int64_t{1} << k);
  return colours;
}

Json view_json(const View& v) {
  return {{"label", v.label},
          {"scale", v.scale},
          {"x0", v.x0},
          {"y0", v.y0},
          {"width", v.width},
          {"height", v.height},
          {"thinned", v.thinned},
          {"largest", v.largest},
          {"has_nan", v.has_nan},
          {"colours", scale_of(v)},
          {"reference", data_uri(v.reference)},
          {"port", data_uri(v.port)},
          {"difference", data_uri(v.difference)},
          {"verdict", data_uri(v.verdict)}};
}

/// The bytes of a record, or null. A keyed list is in any order, so its records are found by id, if they have one.
const std::byte* record_at(const capture::Array& a, bool keyed, std::uint32_t index) {
  const std::size_t size = a.element_bytes(), count = a.levels[0].size() / size;
  const auto id = std::find_if(a.record.members.begin(), a.record.members.end(), [](const scene::Member& m) { return m.name == "id"; });
  if (!keyed || id == a.record.members.end()) return index < count ? a.levels[0].data() + index * size : nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t found;
    std::memcpy(&found, a.levels[0].data() + i * size + id->offset, sizeof found);
    if (found == index) return a.levels[0].data() + i * size;
  }
  return nullptr;
}

/// The fields outside, sorted by distance.
Json outside_fields(const OutputJudgement& o, const OutputBuffers& b) {
  const std::vector<judge::Quantity> fields = judge::quantities_of(b.expected);
  Json rows = Json::array();
  for (const Failure& f : o.worst) {
    const FailureText t = failure_text(o, f);
    const std::byte* want = record_at(b.expected.array, true, static_cast<std::uint32_t>(f.x));
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const judge::Quantity& q) { return q.name == f.field; });
    const bool is_expected = want && field != fields.end();
    rows.push_back(Json::array(
        {fmt::format("{}", static_cast<std::uint32_t>(f.x)), f.field, t.got, t.accepted,
         is_expected ? enclosed::code_text(field->kind, enclosed::ordered_code(field->kind, want + field->offset)) : std::string(),
         f.not_a_number ? "not a number" : fmt::format("{}", f.distance), t.value}));
  }
  return rows;
}

/// The fields that differ, record by record.
Json differing_fields(const OutputJudgement& o, const OutputBuffers& b) {
  Json rows = Json::array();
  for (const Failure& f : o.worst) {
    const auto index = static_cast<std::uint32_t>(f.x);
    const std::byte *want = record_at(b.expected.array, false, index), *have = record_at(b.port, false, index);
    if (!want || !have) {
      rows.push_back(Json::array({fmt::format("{}", index), "", want ? "missing" : "not expected", ""}));
      continue;
    }
    for (const scene::Member& m : b.expected.array.record.members) {
      for (int k = 0; k < m.components; ++k) {
        const std::size_t at = m.offset + 4 * static_cast<std::size_t>(k);
        if (!std::equal(want + at, want + at + 4, have + at))
          rows.push_back(Json::array({fmt::format("{}", index), m.components == 1 ? m.name : m.name + "." + channel_name(k),
                                      capture::scalar_text(have + at, m.scalar), capture::scalar_text(want + at, m.scalar)}));
      }
    }
  }
  return rows;
}

/// Draws pictures while `budget` lasts, and subtracts their size.
Json shown_json(const Shown& shown, const OutputBuffers& buffers, std::size_t& budget) {
  const OutputJudgement& o = *shown.output;
  Json out{{"case", shown.c->id}, {"output", o.name}};
  if (o.records) {
    if (o.failing == 0) return out;
    Json rows = o.counted == judge::Counted::fields ? outside_fields(o, buffers) : differing_fields(o, buffers);
    const std::size_t count = std::min(rows.size(), shown_fields);
    out["more"] = rows.size() - count;
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(count), rows.end());
    out["rows"] = std::move(rows);
    return out;
  }
  out["is_left_out"] = budget == 0 && !o.map.empty();
  out["verdicts"] = Json::array();
  for (int verdict = 0; verdict <= OutputJudgement::not_judged; ++verdict)
    out["verdicts"].push_back(std::count(o.map.begin(), o.map.end(), verdict));
  out["views"] = Json::array();
  if (budget == 0) return out;
  for (const View& v : views_of(o, buffers.expected, buffers.port)) {
    budget -= std::min(budget, v.bytes());
    out["views"].push_back(view_json(v));
  }
  return out;
}

Json pass_buffers(const PassJudgement& p, const PageSource& source, std::size_t& budget) {
  Json out = Json::array();
  for (const Shown& shown : shown_of(p)) {
    const std::optional<OutputBuffers> buffers = source.read ? source.read(shown.c->id, shown.output->name) : std::nullopt;
    if (buffers) out.push_back(shown_json(shown, *buffers, budget));
  }
  return out;
}

}  // namespace

std::string buffers_json(const PortJudgement& j, const PageSource& source) {
  std::size_t budget = picture_budget;
  std::vector<Json> passes(j.passes.size());
  // Pictures of failing passes are drawn first, so that they fit into the budget.
  for (const bool failing : {true, false}) {
    for (std::size_t k = 0; k < j.passes.size(); ++k) {
      const Status s = j.passes[k].status;
      if ((s == Status::fail || s == Status::known) == failing) passes[k] = pass_buffers(j.passes[k], source, budget);
    }
  }
  Json out{{"picture_budget", picture_budget},
           {"pictured_failures", pictured_failures},
           {"verdict_colours", {verdict_colour(0), verdict_colour(1), verdict_colour(2), verdict_colour(3), verdict_colour(4)}},
           {"passes", passes}};
  return out.dump(0, ' ', false, Json::error_handler_t::replace);  // a line for each picture, which editors and tools can handle
}

}  // namespace rainref::reports
