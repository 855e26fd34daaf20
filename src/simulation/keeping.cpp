#include "simulation/keeping.h"

#include <mutex>

#include "base/floating_point.h"
#include "cache/kept_images.h"
#include "rainref/error.h"
#include "rainref/simulation.h"

namespace rainref {
namespace {

struct Keeping {
  std::mutex mutex{};
  bool is_said = false, has_begun = false;
};
Keeping& keeping() {
  static Keeping one;
  return one;
}

}  // namespace

void keep_images(const std::filesystem::path& folder) {
  const FloatingPointGuard guard;
  const std::lock_guard lock(keeping().mutex);
  if (keeping().has_begun)
    throw Error(ExitCode::usage, "keep_images: expected a call before the first simulation is opened, found one that was opened");
  cache::keep_in(folder.empty() ? folder : std::filesystem::absolute(folder));
  keeping().is_said = true;
}

void simulation::begin_to_keep() {
  const std::lock_guard lock(keeping().mutex);
  if (!keeping().has_begun && !keeping().is_said) cache::keep_in(cache::folder_of_user());
  keeping().has_begun = true;
}

}  // namespace rainref
