// tests/golden/hashes.txt, as tests read it.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "source_folder.h"

namespace rainref::golden {

/// Lines that begin with this, in the file's order, of frames below `frames`.
inline std::vector<std::string> recorded(const std::string& start, int frames = 60) {
  std::ifstream file(rainref::test::source_folder() + "/tests/golden/hashes.txt");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(start) && std::stoi(line.substr(line.find(' ') + 1)) < frames) lines.push_back(line);
  }
  return lines;
}

}  // namespace rainref::golden
