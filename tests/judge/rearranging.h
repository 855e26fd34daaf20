// The profiles under which a compiler may rearrange sums.
#pragma once

#include <string>
#include <vector>

#include "judge/profiles.h"

namespace rainref::judge::test {

inline std::vector<std::string> rearranging_profiles() {
  std::vector<std::string> names = profile_names();
  std::erase_if(names, [](const std::string& name) { return profile(name).rearrangement == enclosed::Rearrangement::none; });
  return names;
}

}  // namespace rainref::judge::test
