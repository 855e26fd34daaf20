#include "math/replay.h"

#include "rainref/error.h"

namespace rainref::enclosed {
namespace {

Replay& replay() {
  if (!context.replay) throw Error(ExitCode::internal, "an undecided number outside Replay::for_each_alternative");
  return *context.replay;
}

}  // namespace

int choose(int count) { return replay().choose(count); }
void give_up() { replay().give_up(); }

}  // namespace rainref::enclosed
