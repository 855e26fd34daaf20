// The convention of calls holds between files, whatever a compiler knows of a file's own copy of a function.
#define RAINREF_SPOILING_COPY
#include "windows/copies.h"

#include <gtest/gtest.h>

namespace rainref::test {
namespace {

TEST(Copies, ACallMayUseAllRegistersThatTheConventionGives) {
  EXPECT_EQ(next_of(1LL), 2);  // this file's copy
  EXPECT_EQ(weighted(1, 2, 3, 4), 2 + 6 + 15 + 28);
}

}  // namespace
}  // namespace rainref::test
