// Runs that trace, and what their summaries say.
#pragma once

#include <map>

#include <nlohmann/json.hpp>

#include "cli/support.h"

namespace rainref::cli {

class TracedPictures : public CommandLine {
 protected:
  nlohmann::json summary(const std::string& in) const { return nlohmann::json::parse(contents(folder / (in + "/summary.json"))); }
  /// The buffers of the traced picture with their hashes, in the summary of a run.
  std::map<std::string, std::string> traced(const std::string& in) const {
    std::map<std::string, std::string> out;
    const nlohmann::json all = summary(in);
    for (const auto& line : all["last_frame"]) {
      if (line["pass"] == "compositor") out[line["buffer"]] = line["xxh3"];
    }
    return out;
  }
  /// The same after running scene.toml with these arguments more.
  std::map<std::string, std::string> trace(const std::string& scene, const std::string& to,
                                           const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run", scene + ".toml", "-o", to, "--image", "none", "--set", "compositor.picture=traced"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome o = rainref(arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    return traced(to);
  }
};

}  // namespace rainref::cli
