#include "registry/evaluations.h"

#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "edge_splash/info.h"
#include "puddle/info.h"
#include "rainref/error.h"
#include "rainy_glass/info.h"
#include "screen_drops/info.h"
#include "windshield/info.h"

namespace rainref::registry {
namespace {

using Passes = std::vector<capture::PassEvaluations>;

std::map<std::string, Passes, std::less<>>& known() {
  static std::map<std::string, Passes, std::less<>> all{{"puddle", puddle::evaluations()},
                                                        {"windshield", windshield::evaluations()},
                                                        {"edge_splash", edge_splash::evaluations()},
                                                        {"screen_drops", screen_drops::evaluations()},
                                                        {"rainy_glass", rainy_glass::evaluations()}};
  return all;
}

}  // namespace

const Passes& evaluations(std::string_view effect) {
  static const Passes none;
  const auto found = known().find(effect);
  return found == known().end() ? none : found->second;
}

void add_evaluations(std::string_view effect, Passes passes) {
  if (!known().emplace(effect, std::move(passes)).second)
    throw Error(ExitCode::internal, fmt::format("'{}' has its evaluations already", effect));
}

}  // namespace rainref::registry
