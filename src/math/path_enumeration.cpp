#include "math/path_enumeration.h"

#include "rainref/error.h"

namespace rainref::enclosed {
namespace {

PathEnumeration& paths() {
  if (!context.paths) throw Error(ExitCode::internal, "an undecided number outside PathEnumeration::for_each_alternative");
  return *context.paths;
}

}  // namespace

int choose(int count) { return paths().choose(count); }
void give_up() { paths().give_up(); }

}  // namespace rainref::enclosed
