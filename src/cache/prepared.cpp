#include "cache/prepared.h"

#include <list>
#include <mutex>

namespace rainref::cache {
namespace {

struct Store {
  struct Entry {
    std::string recipe;
    std::shared_ptr<const void> value;
    std::size_t bytes;
  };
  std::mutex mutex;
  std::list<Entry> entries;  // most recently used first
  std::map<std::string, std::list<Entry>::iterator> by_recipe;
  std::size_t held = 0, limit = 0;
  std::map<std::string, std::int64_t> made;

  /// Moves dropped entries to `gone`, to be destroyed after the lock is released, because that may take long.
  void shrink(std::size_t most, std::list<Entry>& gone) {
    while (held > most) {
      held -= entries.back().bytes;
      by_recipe.erase(entries.back().recipe);
      gone.splice(gone.end(), entries, std::prev(entries.end()));
    }
  }
};
/// Never destroyed, as threads may outlive static objects.
Store& store() {
  static Store& one = *new Store;
  return one;
}

void shrink(std::size_t most, bool is_limit) {
  std::list<Store::Entry> gone;
  const std::lock_guard lock(store().mutex);
  if (is_limit) store().limit = most;
  store().shrink(most, gone);
}

}  // namespace

void remember(std::size_t most_bytes) { shrink(most_bytes, true); }
void forget() { shrink(0, false); }
bool remembers() {
  const std::lock_guard lock(store().mutex);
  return store().limit > 0;
}
std::map<std::string, std::int64_t> times_made() {
  const std::lock_guard lock(store().mutex);
  return store().made;
}

std::shared_ptr<const void> find_prepared(const Recipe& recipe) {
  Store& s = store();
  const std::lock_guard lock(s.mutex);
  if (s.limit == 0) return {};
  const auto found = s.by_recipe.find(recipe.text());
  if (found == s.by_recipe.end()) return {};
  s.entries.splice(s.entries.begin(), s.entries, found->second);
  return found->second->value;
}

std::shared_ptr<const void> keep_prepared(const Recipe& recipe, std::shared_ptr<const void> value, std::size_t bytes) {
  Store& s = store();
  std::list<Store::Entry> gone;
  const std::lock_guard lock(s.mutex);
  ++s.made[recipe.what()];
  if (bytes > s.limit) return value;
  if (const auto found = s.by_recipe.find(recipe.text()); found != s.by_recipe.end()) return found->second->value;
  s.entries.push_front({recipe.text(), std::move(value), bytes});
  s.by_recipe[recipe.text()] = s.entries.begin();
  s.held += bytes;
  const std::shared_ptr<const void> kept = s.entries.front().value;
  s.shrink(s.limit, gone);
  return kept;
}

}  // namespace rainref::cache
