#include "reports/json.h"

#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "image/code_range.h"
#include "judge/quantities.h"
#include "rainref/version.h"
#include "reports/figures.h"

namespace rainref::reports {
namespace {

using judge::CaseJudgement;
using judge::Cause;
using judge::Failure;
using judge::OutputJudgement;
using judge::PassCoverage;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::QuantityJudgement;
using Json = nlohmann::ordered_json;

/// Value, bits and ordered code; the library writes null for infinity and NaN.
Json code_json(FormatInfo::Kind kind, std::int64_t code, bool negative_zero = false) {
  const int digits = kind == FormatInfo::float32 || kind == FormatInfo::uint32 ? 8 : kind == FormatInfo::float16 ? 4 : 2;
  const std::uint32_t bits = negative_zero ? 1u << (4 * digits - 1) : enclosed::code_bits(kind, code);
  return {
      {"value", negative_zero ? -0.0 : enclosed::code_value(kind, code)}, {"bits", fmt::format("0x{:0{}x}", bits, digits)}, {"code", code}};
}

Json failure_json(const OutputJudgement& o, const Failure& f) {
  if (o.records && f.field.empty()) return {{"record", f.x}};
  const FormatInfo::Kind kind = o.records ? f.field_kind : info(o.format).kind;
  // A vacuous range has no ends; their codes would not belong to the format.
  const bool bounded = f.low != INT64_MIN;
  Json out = o.records ? Json{{"record", f.x}, {"field", f.field}} : Json{{"x", f.x}, {"y", f.y}, {"channel", f.channel}};
  out["got"] = code_json(kind, f.got, f.got_is_negative_zero);
  out["low"] = bounded ? code_json(kind, f.low) : Json();
  out["high"] = bounded ? code_json(kind, f.high) : Json();
  if (!o.records) out["expected"] = code_json(kind, f.expected, f.expected_is_negative_zero);
  out["distance"] = f.not_a_number ? Json() : Json(f.distance);
  out["value_distance"] = judge::value_distance(kind, f);
  out["not_a_number"] = f.not_a_number;
  const FailureText t = failure_text(o, f);
  if (!o.records) out["text"] = {{"place", t.place}, {"got", t.got}, {"accepted", t.accepted}, {"expected", t.expected}, {"off", t.value}};
  return out;
}

/// The library writes null for an infinite distance.
Json quantity_json(const QuantityJudgement& q) {
  return {{"name", q.name},           {"unit", q.unit},
          {"extent", q.extent},       {"elements", q.elements},
          {"failing", q.failing},     {"vacuous", q.vacuous},
          {"loose", q.loose},         {"free", q.free},
          {"sampled", q.sampled()},   {"median_codes", q.median_codes},
          {"p99_codes", q.p99_codes}, {"median_width", q.median_width},
          {"p99_width", q.p99_width}, {"farthest", q.farthest}};
}

/// Run lengths of verdicts (0 equal, 1 inside, 2 warned of, 3 outside, 4 not judged) with the number of texels, row 0 first.
Json map_json(const std::vector<std::uint8_t>& map) {
  Json runs = Json::array();
  for (std::size_t begin = 0; begin < map.size();) {
    std::size_t end = begin;
    while (end < map.size() && map[end] == map[begin]) ++end;
    runs.push_back(map[begin]);
    runs.push_back(end - begin);
    begin = end;
  }
  return runs;
}

Json output_json(const OutputJudgement& o) {
  Json out{{"name", o.name}, {"format", o.records ? "records" : std::string(info(o.format).name)}};
  if (!o.records) {
    out["width"] = o.width;
    out["height"] = o.height;
  }
  out["shape"] = shape_text(o);
  out["elements"] = o.elements;
  out["counted"] = name(o.counted);
  out["failing"] = o.failing;
  out["differing"] = o.differing;
  out["bounded"] = figures_of(o).bounded();
  out["vacuous"] = o.vacuous;
  out["loose"] = o.loose;
  out["atypical"] = o.atypical;
  out["beyond"] = o.beyond;
  out["typical"] = o.typical;
  out["unbounded"] = o.unbounded;
  out["rearranged"] = o.rearranged;
  out["free"] = o.free;
  out["sampled"] = o.sampled();
  out["median_width"] = o.median_width;
  out["p99_width"] = o.p99_width;
  out["median_text"] = width_text(median_width(o));
  out["p99_text"] = width_text(p99_width(o));
  out["rearranged_median_width"] = o.rearranged_median_width < 0 ? Json() : Json(o.rearranged_median_width);
  out["rearranged_p99_width"] = o.rearranged_p99_width < 0 ? Json() : Json(o.rearranged_p99_width);
  out["quantities"] = Json::array();
  for (const QuantityJudgement& q : o.quantities) out["quantities"].push_back(quantity_json(q));
  const QuantityJudgement* worst = worst_quantity(o);
  out["worst_quantity"] = worst ? Json(worst->name) : Json();
  out["known"] = o.known.empty() ? Json() : Json(o.known);
  out["worst"] = Json::array();
  for (const Failure& f : o.worst) out["worst"].push_back(failure_json(o, f));
  if ((o.failing > 0 || o.atypical > 0 || o.rearranged > 0) && !o.map.empty()) out["map"] = map_json(o.map);
  return out;
}

Json case_json(const CaseJudgement& c) {
  Json out{{"id", c.id},
           {"status", name(c.status)},
           {"reason", c.reason},
           {"broken", c.broken},
           {"invocations", c.invocations},
           {"failing", c.failing},
           {"ambiguous", c.ambiguous},
           {"other_branch", c.other_branch},
           {"gave_up", c.gave_up},
           {"stride", c.stride},
           {"is_of_sample", c.is_of_sample},
           {"rearranged", c.rearranged},
           {"rearranged_distance", c.rearranged_distance},
           {"expanded", c.expanded},
           {"beyond", c.beyond},
           {"outputs", Json::array()}};
  for (const OutputJudgement& o : c.outputs) out["outputs"].push_back(output_json(o));
  return out;
}

/// As texts, because alternatives are not keys.
Json reasons_of(const PassCoverage& coverage) {
  Json out = Json::array();
  for (const auto& [alternative, reason] : coverage.reasons) out.push_back(fmt::format("{} ({})", alternative, reason));
  return out;
}

Json figures_json(const Figures& f) {
  return {{"invocations", f.invocations},
          {"failing", f.failing},
          {"ambiguous", f.ambiguous},
          {"other_branch", f.other_branch},
          {"gave_up", f.gave_up},
          {"elements", f.elements},
          {"outside", f.outside},
          {"differing", f.differing},
          {"bounded", f.bounded()},
          {"vacuous", f.vacuous},
          {"loose", f.loose},
          {"free", f.free},
          {"sampled", f.sampled()},
          {"median_text", width_text(f.median_width)},
          {"p99_text", width_text(f.p99_width)}};
}

/// The worst failure in the case that is shown first, or null.
Json worst_json(const PassJudgement& p) {
  const std::vector<Shown> shown = shown_of(p);
  if (shown.empty() || shown[0].c->failing == 0) return Json();
  const QuantityJudgement* q = worst_quantity(*shown[0].output);
  if (!q) return Json();
  return {{"case", shown[0].c->id},
          {"output", shown[0].output->name},
          {"quantity", q->name},
          {"off", q->farthest <= std::numeric_limits<double>::max() ? Json(quantity_text(q->farthest, q->unit)) : Json()}};
}

/// Each quantity over all cases of a pass. Its widths have no unit, which is a separate entry.
Json quantities_json(const PassJudgement& p) {
  const auto text = [](Width w) {
    w.unit.clear();
    return in_unit(w);
  };
  Json out = Json::array();
  for (const QuantitiesOfOutput& o : quantities_of(p)) {
    for (const QuantityJudgement& q : o.quantities) {
      Json row{{"output", o.output}, {"counted", name(o.counted)}};
      row.update(quantity_json(q));
      row["median_text"] = text(median_width(q));
      row["p99_text"] = text(p99_width(q));
      out.push_back(std::move(row));
    }
  }
  return out;
}

Json pass_json(const PassJudgement& p, const PageSource& source) {
  const auto sentence = source.sentences.find(p.pass);
  Json out{{"pass", p.pass},
           {"formula", p.formula},
           {"sentence", sentence == source.sentences.end() ? "" : sentence->second},
           {"takes", Json::array()},
           {"status", name(p.status)},
           {"reason", p.reason},
           {"inputs_are_good", p.inputs_are_good},
           {"half_mode", name(p.half_mode)},
           {"half_mode_voted", p.half_mode_voted},
           {"half_text", half_text(p)},
           {"sample_text", sample_text(p)},
           {"half_votes", {{"rne", p.half_votes[0]}, {"rtz", p.half_votes[1]}, {"either", p.half_votes[2]}}},
           {"half_is_least", {{"rne", p.half_is_least[0]}, {"rtz", p.half_is_least[1]}, {"either", p.half_is_least[2]}}},
           {"where", p.where},
           {"coverage",
            {{"exercised", p.coverage.taken},
             {"alternatives", p.coverage.alternatives},
             {"never", p.coverage.never},
             {"reasons", reasons_of(p.coverage)},
             {"sampled", p.coverage.is_sampled},
             {"text", coverage_text(p.coverage, 0)}}},
           {"figures", figures_json(figures_of(p))},
           {"quantities", quantities_json(p)},
           {"worst", worst_json(p)},
           {"cause_is_unknown", has_unknown_cause(p)},
           {"causes", Json::array()},
           {"cases", Json::array()}};
  for (const capture::PackEdge& e : source.edges)
    if (e.pass == p.pass) out["takes"].push_back({{"input", e.input}, {"from", e.from}, {"previous", e.previous}});
  const auto line_json = [](const judge::ShaderLine& l) {
    return Json{{"file", l.file}, {"line", l.line}, {"until", l.until}, {"text", l.text}};
  };
  for (const Cause& c : p.causes) {
    Json lines = Json::array();
    for (const judge::ShaderLine& l : c.lines) lines.push_back(line_json(l));
    out["causes"].push_back({{"name", c.name},
                             {"sentence", c.sentence},
                             {"counted", element_word(c)},
                             {"explained", c.explained},
                             {"of", c.of},
                             {"inside", c.inside},
                             {"is_likely", c.is_likely},
                             {"repeats_first", c.repeats_first},
                             {"lines", std::move(lines)},
                             {"line_texts", line_texts(c)}});
  }
  for (const CaseJudgement& c : p.cases) out["cases"].push_back(case_json(c));
  return out;
}

}  // namespace

std::string report_json(const PortJudgement& j, int exit_code, const PageSource& source) {
  Json out{{"format", "rainref.judgement"},
           {"version", 1},
           {"rainref", {{"version", version()}, {"golden_generation", golden_generation}}},
           {"status", name(j.status)},
           {"exit_code", exit_code},
           {"counts", count_text(j)},
           {"reason", j.reason},
           {"first_bad_pass", j.first_bad_pass.empty() ? Json() : Json(j.first_bad_pass)},
           {"pack", j.pack},
           {"port", j.port},
           {"profile", j.profile},
           {"effect", j.effect},
           {"variant", j.variant},
           {"scene", j.scene},
           {"device", {{"api", j.api}, {"name", j.device}, {"driver", j.driver}}},
           {"command", j.command},
           {"not_judged", not_judged(j)},
           {"files", Json::array()},
           {"notes", j.notes},
           {"stale", j.stale},
           {"passes", Json::array()}};
  for (const judge::FileFault& f : j.files)
    out["files"].push_back(
        {{"pass", f.pass}, {"case", f.id}, {"buffer", f.output}, {"exit_code", static_cast<int>(f.code)}, {"error", f.text}});
  for (const PassJudgement& p : j.passes) out["passes"].push_back(pass_json(p, source));
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rainref::reports
