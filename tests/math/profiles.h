// The judge's profiles, for tests of the rooms below it.
#pragma once

#include <string>
#include <vector>

#include "judge/profiles.h"

namespace rainref::test {

/// All of them, with those that nobody is judged under.
inline const std::vector<enclosed::Profile>& profiles() {
  static const std::vector<enclosed::Profile> all = [] {
    std::vector<enclosed::Profile> made;
    for (const auto& embedded : judge::detail::embedded_profiles()) made.push_back(judge::profile(embedded.name));
    return made;
  }();
  return all;
}
inline const enclosed::Profile& profile_named(const std::string& name) { return judge::profile(name); }

}  // namespace rainref::test
