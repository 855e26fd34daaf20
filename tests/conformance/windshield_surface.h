// The passes that these tests are about.
#pragma once

#include "conformance/support.h"

namespace rainref::conformance::test {

inline const std::vector<std::string> surface_names{"splat", "wipe_texture", "normals", "blur_pyramid", "composite", "display"};
inline std::vector<BoundPass> surface_passes() {
  return enveloped_passes({"windshield-as-published", "windshield-corrected"}, surface_names);
}

}  // namespace rainref::conformance::test
