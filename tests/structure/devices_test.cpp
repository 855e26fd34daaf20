// docs/notes/devices.md has the tables of the files in docs/devices, and no port that computes nothing does anything but fail.
#include <gtest/gtest.h>

#include <string>

#include "base/shell.h"

namespace {

using rainref::output_of;

TEST(Devices, TheTablesAreThoseOfTheFiles) {
  if (output_of("python3 -c 'import tomllib'").second != 0) GTEST_SKIP() << "needs Python 3.11";
  const auto [text, status] = output_of("python3 '" RAINREF_SOURCE_DIR "/scripts/devices.py' check");
  EXPECT_EQ(status, 0) << text;
}

// What the check is for: another verdict than FAIL of a port that computes nothing, and a file that is not there.
TEST(Devices, APortOfNothingThatPassesIsFound) {
  const std::string ask = "import json, sys; sys.path.insert(0, '" RAINREF_SOURCE_DIR
                          "/scripts'); import verdicts; "
                          "packs = lambda status: {'packs': [{'pack': 'p', 'effect': 'e', 'verdicts': {'a': 'FAIL', 'b': status}}]}; "
                          "print(verdicts.faults({'null': packs('FAIL'), 'zeros': packs('UNTESTED'), 'noise': packs('FAIL')}))";
  const auto [text, status] = output_of("python3 -c \"" + ask + "\"");
  if (status != 0) GTEST_SKIP() << "needs Python 3: " << text;
  EXPECT_EQ(text, "['constant: no such file', 'zeros: p b: UNTESTED']\n");
}

}  // namespace
