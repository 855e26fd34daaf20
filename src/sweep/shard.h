// The cells that this process takes, from the variables of an engine's array job.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rainref::sweep {

/// Process `number` of `count`, counted from 0. It takes neighbouring cells, which have most in common: a street, a film's state.
struct Shard {
  std::int64_t number = 0, count = 1;
  /// For this number of cells; each is taken by exactly one shard.
  bool takes(std::int64_t cell, std::int64_t cells) const { return cell * count / cells == number; }
};

/// A variable of the environment; nothing if it is not set or empty.
using Environment = std::function<std::optional<std::string>(const char*)>;
Environment environment();

/// "K/N", "auto" or "auto/N": from the variables of Slurm, Grid Engine, PBS, Kubernetes (indexed jobs) or MPI, the first that exist; N if
/// the engine does not give their number. Throws Error(usage) with expected and found.
Shard shard_from(const std::string& text, const Environment& variables);

}  // namespace rainref::sweep
