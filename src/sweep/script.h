// Writes the script for an engine that runs a sweep.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rainref::sweep {

struct ScriptAsked {
  std::string engine;
  std::filesystem::path program, plan, out;  ///< absolute
  std::int64_t shards = 1;
  int threads = 1;    ///< per shard
  std::string image;  ///< container image, for kubernetes
};
std::vector<std::string> engines();

/// A shell script, or the manifest of an indexed job; with collect after the last shard. Throws Error(usage) for an unknown engine, and for
/// paths that its script cannot hold unchanged: with newlines or other control characters, with braces for GNU parallel, not UTF-8 for
/// kubernetes.
std::string script(const ScriptAsked& asked);

}  // namespace rainref::sweep
