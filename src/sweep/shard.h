// Which cells this process takes, as an engine's array says it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rainref::sweep {

/// Of `count` processes the one of this number, counted from 0. It takes neighbours, which have most in common: a street, a film's state.
struct Shard {
  std::int64_t number = 0, count = 1;
  /// Of so many cells; each is taken by one shard.
  bool takes(std::int64_t cell, std::int64_t cells) const { return cell * count / cells == number; }
};

/// A variable of the environment; nothing where it is not set or empty.
using Environment = std::function<std::optional<std::string>(const char*)>;
Environment environment();

/// "K/N", "auto" or "auto/N": from the variables of Slurm, Grid Engine, PBS, Kubernetes (indexed jobs) or MPI, the first that is
/// there; N where the engine does not say how many there are. Throws Error(usage) with what was expected and found.
Shard shard_from(const std::string& text, const Environment& variables);

}  // namespace rainref::sweep
