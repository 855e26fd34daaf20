// The profiles of src/judge/profiles for tests of the rooms below the judge: a reader of exactly the TOML that those files use. A line is
// a comment, `key = value` or `key = {key = value, ..., source = "text"}`. judge/profile_tables_test.cpp holds it to the judge's reader.
#pragma once

#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "math/profile.h"
#include "source_folder.h"

namespace rainref::test {

inline const std::vector<std::string>& profile_names() {
  static const std::vector<std::string> names{"ieee", "vulkan", "webgpu", "d3d", "cuda", "metal", "typical", "coarsest"};
  return names;
}

/// One profile; throws std::runtime_error for a line that it does not know.
inline enclosed::Profile read_profile(const std::string& name) {
  using namespace enclosed;
  Profile p;
  const std::map<std::string, Accuracy*> accuracies{{"division", &p.division},
                                                    {"sqrt", &p.sqrt},
                                                    {"inverse_sqrt", &p.inverse_sqrt},
                                                    {"exp", &p.exp},
                                                    {"exp2", &p.exp2},
                                                    {"log", &p.log},
                                                    {"log2", &p.log2},
                                                    {"log_near_one", &p.log_near_one},
                                                    {"log2_near_one", &p.log2_near_one},
                                                    {"pow", &p.pow},
                                                    {"sin_cos", &p.sin_cos},
                                                    {"atan2", &p.atan2},
                                                    {"unorm_load", &p.unorm_load}};
  const std::map<std::string, bool*> flags{{"contraction", &p.contraction},
                                           {"sqrt_is_inherited", &p.sqrt_is_inherited},
                                           {"pow_is_inherited", &p.pow_is_inherited},
                                           {"half_store_flush", &p.half_store_flush}};
  const std::map<std::string, int*> counts{
      {"subtexel_bits", &p.subtexel_bits}, {"coordinate_bits", &p.coordinate_bits}, {"lod_bits", &p.lod_bits}};
  const std::map<std::string, double*> numbers{{"sin_cos_domain", &p.sin_cos_domain},
                                               {"sin_cos_beyond", &p.sin_cos_beyond},
                                               {"atan2_domain", &p.atan2_domain},
                                               {"unorm_store_ulp", &p.unorm_store_ulp},
                                               {"srgb_store_ulp", &p.srgb_store_ulp}};
  const std::map<std::string, StoreRounding> roundings{
      {"\"rne\"", StoreRounding::rne}, {"\"rtz\"", StoreRounding::rtz}, {"\"either\"", StoreRounding::either}};
  const std::map<std::string, Rearrangement> rearrangements{{"\"none\"", Rearrangement::none},
                                                            {"\"reassociated\"", Rearrangement::reassociated},
                                                            {"\"distributed\"", Rearrangement::distributed}};
  const std::map<std::string, StoreOverflow> overflows{
      {"\"inf\"", StoreOverflow::inf}, {"\"max\"", StoreOverflow::max}, {"\"either\"", StoreOverflow::either}};

  const std::string path = rainref::test::source_folder() + "/src/judge/profiles/" + name + ".toml";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  const std::regex top("(\\w+) = (\"\\w+\"|true|false)"), entry("(\\w+) = \\{(.*), source = \"[^\"]{4,}\"\\}");
  const std::regex pair("(\\w+) = (\"\\w+\"|true|false|[-+.e0-9]+)(, )?");
  for (std::string line; std::getline(file, line);) {
    std::smatch m;
    if (line.empty() || line[0] == '#' || line.starts_with("rearrangement_remedy = ") || line.starts_with("about = ") ||
        line.starts_with("known_outside = "))
      continue;
    if (std::regex_match(line, m, top)) {
      if (m[1] == "name")
        p.name = m[2].str().substr(1, m[2].length() - 2);
      else if (m[1] == "reference")
        p.reference = m[2] == "true";
      else
        throw std::runtime_error(path + ": " + line);
      continue;
    }
    if (!std::regex_match(line, m, entry)) throw std::runtime_error(path + ": " + line);
    const std::string key = m[1];
    std::map<std::string, std::string> values;
    std::string rest = m[2];
    for (std::smatch v; !rest.empty(); rest = v.suffix()) {
      if (!std::regex_search(rest, v, pair, std::regex_constants::match_continuous)) throw std::runtime_error(path + ": " + line);
      values[v[1]] = v[2];
    }
    if (accuracies.count(key)) {
      Accuracy& a = *accuracies.at(key);
      const std::map<std::string, double*> parts{
          {"ulp", &a.ulp}, {"ulp_per_x", &a.ulp_per_x}, {"relative", &a.relative}, {"absolute", &a.absolute}};
      for (const auto& [part, value] : values) *parts.at(part) = std::stod(value);
      continue;
    }
    const std::string value = values.size() == 1 ? values.at("value") : throw std::runtime_error(path + ": " + line);
    if (flags.count(key))
      *flags.at(key) = value == "true";
    else if (counts.count(key))
      *counts.at(key) = std::stoi(value);
    else if (numbers.count(key))
      *numbers.at(key) = std::stod(value);
    else if (key == "basic")
      p.basic = value == "\"either\"" ? BasicRounding::either : BasicRounding::nearest;
    else if (key == "flush")
      p.flush = value == "\"never\"" ? Flush::never : value == "\"may\"" ? Flush::may : Flush::must;
    else if (key == "rearrangement")
      p.rearrangement = rearrangements.at(value);
    else if (key == "half_store")
      p.half_store = roundings.at(value);
    else
      p.half_overflow = overflows.at(value);
  }
  return p;
}

/// All of them, read once.
inline const std::vector<enclosed::Profile>& profiles() {
  static const std::vector<enclosed::Profile> all = [] {
    std::vector<enclosed::Profile> read;
    for (const std::string& name : profile_names()) read.push_back(read_profile(name));
    return read;
  }();
  return all;
}
inline const enclosed::Profile& profile_named(const std::string& name) {
  for (const enclosed::Profile& p : profiles()) {
    if (p.name == name) return p;
  }
  throw std::runtime_error("no profile " + name);
}

}  // namespace rainref::test
