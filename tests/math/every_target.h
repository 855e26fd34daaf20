// Runs a test body once for each SIMD target of this machine.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "math/simd_target.h"

namespace rainref::test {

/// Calls body() with each target selected in turn; a failure names the target. Ends with the best one selected.
template <class Body>
void for_every_target(Body body) {
  for (const std::string& target : simd_targets()) {
    SCOPED_TRACE(target);
    select_simd_target(target);
    body();
  }
  select_simd_target("");
}

}  // namespace rainref::test
