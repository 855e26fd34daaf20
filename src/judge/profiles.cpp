#include "judge/profiles.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>

#include "rainref/error.h"
#include "scene/toml_reader.h"

namespace rainref::judge {
namespace {

using enclosed::Accuracy;
using enclosed::Profile;
using scene::RawEntry;

[[noreturn]] void refuse(const RawEntry& e, const std::string& expected) {
  throw Error(ExitCode::usage, e.at, fmt::format("{}: expected {}, found {}", e.key, expected, e.value.text()));
}
double number(const RawEntry& e) {
  if (const auto* d = std::get_if<double>(&e.value.data); d && *d >= 0 && *d < 1e300) return *d;
  if (const auto* i = std::get_if<std::int64_t>(&e.value.data); i && *i >= 0) return static_cast<double>(*i);
  refuse(e, "a number of 0 or more");
}
bool boolean(const RawEntry& e) {
  if (const auto* b = std::get_if<bool>(&e.value.data)) return *b;
  refuse(e, "true or false");
}
int bits(const RawEntry& e) {
  const auto* i = std::get_if<std::int64_t>(&e.value.data);
  if (!i || *i < 0 || *i > 24) refuse(e, "a whole number from 0 to 24");
  return static_cast<int>(*i);
}
const std::string& text(const RawEntry& e) {
  const auto* s = std::get_if<std::string>(&e.value.data);
  if (!s || s->empty()) refuse(e, "a text");
  return *s;
}
template <class T>
T choice(const RawEntry& e, const std::vector<std::pair<std::string, T>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    if (name == text(e)) return value;
    names.push_back(name);
  }
  refuse(e, fmt::format("one of {}", fmt::join(names, ", ")));
}

using Set = std::function<void(Profile&, const RawEntry&)>;

/// Members that have one value each.
const std::map<std::string, Set>& values() {
  using enclosed::BasicRounding, enclosed::Flush, enclosed::Rearrangement, enclosed::StoreOverflow, enclosed::StoreRounding;
  static const std::map<std::string, Set> all{
      {"name", [](Profile& p, const RawEntry& e) { p.name = text(e); }},
      {"reference", [](Profile& p, const RawEntry& e) { p.reference = boolean(e); }},
      {"basic",
       [](Profile& p, const RawEntry& e) {
         p.basic = choice<BasicRounding>(e, {{"nearest", BasicRounding::nearest}, {"either", BasicRounding::either}});
       }},
      {"contraction", [](Profile& p, const RawEntry& e) { p.contraction = boolean(e); }},
      {"flush",
       [](Profile& p, const RawEntry& e) {
         p.flush = choice<Flush>(e, {{"never", Flush::never}, {"may", Flush::may}, {"must", Flush::must}});
       }},
      {"rearrangement",
       [](Profile& p, const RawEntry& e) {
         p.rearrangement = choice<Rearrangement>(
             e,
             {{"none", Rearrangement::none}, {"reassociated", Rearrangement::reassociated}, {"distributed", Rearrangement::distributed}});
       }},
      {"rearrangement_remedy", [](Profile& p, const RawEntry& e) { p.rearrangement_remedy = text(e); }},
      {"sqrt_is_inherited", [](Profile& p, const RawEntry& e) { p.sqrt_is_inherited = boolean(e); }},
      {"pow_is_inherited", [](Profile& p, const RawEntry& e) { p.pow_is_inherited = boolean(e); }},
      {"sin_cos_domain", [](Profile& p, const RawEntry& e) { p.sin_cos_domain = number(e); }},
      {"sin_cos_beyond", [](Profile& p, const RawEntry& e) { p.sin_cos_beyond = number(e); }},
      {"atan2_domain", [](Profile& p, const RawEntry& e) { p.atan2_domain = number(e); }},
      {"half_store_flush", [](Profile& p, const RawEntry& e) { p.half_store_flush = boolean(e); }},
      {"subtexel_bits", [](Profile& p, const RawEntry& e) { p.subtexel_bits = bits(e); }},
      {"coordinate_bits", [](Profile& p, const RawEntry& e) { p.coordinate_bits = bits(e); }},
      {"lod_bits", [](Profile& p, const RawEntry& e) { p.lod_bits = bits(e); }},
      {"half_store",
       [](Profile& p, const RawEntry& e) {
         p.half_store =
             choice<StoreRounding>(e, {{"rne", StoreRounding::rne}, {"rtz", StoreRounding::rtz}, {"either", StoreRounding::either}});
       }},
      {"half_overflow",
       [](Profile& p, const RawEntry& e) {
         p.half_overflow =
             choice<StoreOverflow>(e, {{"inf", StoreOverflow::inf}, {"max", StoreOverflow::max}, {"either", StoreOverflow::either}});
       }},
      {"unorm_store_ulp", [](Profile& p, const RawEntry& e) { p.unorm_store_ulp = number(e); }},
      {"srgb_store_ulp", [](Profile& p, const RawEntry& e) { p.srgb_store_ulp = number(e); }},
  };
  return all;
}
/// Members that are an Accuracy.
const std::map<std::string, Accuracy Profile::*>& accuracies() {
  static const std::map<std::string, Accuracy Profile::*> all{{"division", &Profile::division},
                                                              {"sqrt", &Profile::sqrt},
                                                              {"inverse_sqrt", &Profile::inverse_sqrt},
                                                              {"exp", &Profile::exp},
                                                              {"exp2", &Profile::exp2},
                                                              {"log", &Profile::log},
                                                              {"log2", &Profile::log2},
                                                              {"log_near_one", &Profile::log_near_one},
                                                              {"log2_near_one", &Profile::log2_near_one},
                                                              {"pow", &Profile::pow},
                                                              {"sin_cos", &Profile::sin_cos},
                                                              {"atan2", &Profile::atan2},
                                                              {"unorm_load", &Profile::unorm_load}};
  return all;
}

void set_part(Profile& p, const std::string& member, const std::string& part, const RawEntry& e) {
  if (const auto a = accuracies().find(member); a != accuracies().end()) {
    static const std::map<std::string, double Accuracy::*> parts{
        {"ulp", &Accuracy::ulp}, {"ulp_per_x", &Accuracy::ulp_per_x}, {"relative", &Accuracy::relative}, {"absolute", &Accuracy::absolute}};
    const auto found = parts.find(part);
    if (found == parts.end())
      throw Error(ExitCode::usage, e.at, fmt::format("{}: expected ulp, ulp_per_x, relative, absolute or source", e.key));
    p.*(a->second).*(found->second) = number(e);
    return;
  }
  const auto v = values().find(member);
  if (v == values().end()) {
    std::vector<std::string> known;
    for (const auto& [name, unused] : values()) known.push_back(name);
    for (const auto& [name, unused] : accuracies()) known.push_back(name);
    throw Error(ExitCode::usage, e.at, fmt::format("unknown key '{}'{}", member, did_you_mean(member, known)));
  }
  if (!part.empty() && part != "value") throw Error(ExitCode::usage, e.at, fmt::format("{}: expected value or source", e.key));
  v->second(p, e);
}

/// Texts about a profile, for typical_words().
bool is_of_typical(const std::string& key) { return key == "about" || key == "known_outside"; }
/// Profiles that no port is judged under.
bool is_no_rule(std::string_view name) { return name == "typical" || name == "coarsest"; }

}  // namespace

enclosed::Profile parse_profile(std::string_view toml, const std::string& file) {
  Profile p;
  p.name.clear();
  std::map<std::string, RawEntry> without_source;
  std::set<std::string> sourced;
  for (const RawEntry& e : scene::read_toml(toml, file)) {
    const std::size_t dot = e.key.find('.');
    const std::string member = e.key.substr(0, dot), part = dot == std::string::npos ? "" : e.key.substr(dot + 1);
    if (part == "source") {
      text(e);
      sourced.insert(member);
      continue;
    }
    if (is_of_typical(e.key)) {
      text(e);
      continue;
    }
    set_part(p, member, part, e);
    if (member != "name" && member != "reference" && member != "rearrangement_remedy") without_source.emplace(member, e);
  }
  for (const auto& [member, e] : without_source)
    if (!sourced.contains(member)) throw Error(ExitCode::usage, e.at, fmt::format("{}: expected a source beside it", member));
  if (p.name.empty()) throw Error(ExitCode::usage, fmt::format("{}: expected a name", file));
  return p;
}

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const auto& e : detail::embedded_profiles())
    if (!is_no_rule(e.name)) names.emplace_back(e.name);
  return names;
}
const enclosed::Profile& profile(std::string_view name) {
  static const std::map<std::string, Profile, std::less<>> all = [] {
    std::map<std::string, Profile, std::less<>> made;
    for (const auto& e : detail::embedded_profiles()) made.emplace(e.name, parse_profile(e.text, fmt::format("{}.toml", e.name)));
    return made;
  }();
  if (const auto found = all.find(name); found != all.end()) return found->second;
  const std::vector<std::string> names = profile_names();
  throw Error(ExitCode::usage,
              fmt::format("--profile: expected one of {}, found '{}'{}", fmt::join(names, ", "), name, did_you_mean(name, names)));
}
const enclosed::Profile& judging_profile(std::string_view name) {
  if (!is_no_rule(name)) return profile(name);
  throw Error(ExitCode::usage,
              fmt::format("--profile: expected one of {}, found '{}', which is what {} and no rule", fmt::join(profile_names(), ", "), name,
                          name == "typical" ? "known devices do" : "no device exceeds"));
}
const std::string& typical_words() {
  static const std::string words = [] {
    std::map<std::string, std::string> of;
    for (const RawEntry& e : scene::read_toml(profile_text("typical"), "typical.toml"))
      if (is_of_typical(e.key)) of[e.key] = text(e);
    return fmt::format("what known devices do (typical: {}; outside it lie {})", of["about"], of["known_outside"]);
  }();
  return words;
}
std::string_view profile_text(std::string_view name) {
  for (const auto& e : detail::embedded_profiles())
    if (e.name == name) return e.text;
  return {};
}

}  // namespace rainref::judge
