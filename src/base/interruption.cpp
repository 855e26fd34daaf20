#include "base/interruption.h"

#include <list>

namespace rainref {
namespace {

struct Registry {
  std::recursive_mutex mutex;
  std::list<const std::function<void()>*> actions;  // newest first
};
// Never destroyed, because the thread that waits for signals outlives static objects.
Registry& registry() {
  static Registry& only = *new Registry;
  return only;
}

}  // namespace

Undo::Undo(std::function<void()> action) : action_(std::move(action)) {
  const Uninterrupted scope;
  registry().actions.push_front(&action_);
}
Undo::~Undo() {
  const Uninterrupted scope;
  registry().actions.remove(&action_);
}

Uninterrupted::Uninterrupted() : lock_(registry().mutex) {}

void undo_all() noexcept {
  registry().mutex.lock();  // and never unlock
  for (const std::function<void()>* action : registry().actions) {
    try {
      (*action)();
    } catch (...) {
      // Continues with the other actions.
    }
  }
}

}  // namespace rainref
