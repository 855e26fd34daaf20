// What a process that runs many scenes has made or read once, so that the next scene need not.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace rainref::cache {

/// Bytes that each Remembered may hold from here on; 0, as at the start: nothing is remembered. From the thread that starts the others.
void remember(std::size_t most_bytes);
std::size_t remembered_bytes();

/// Values by name, those used last. Any thread may ask.
template <class T>
class Remembered {
 public:
  /// Null where it is not known.
  std::shared_ptr<const T> find(const std::string& name) {
    if (remembered_bytes() == 0) return {};
    const std::lock_guard lock(mutex_);
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return {};
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
  }
  /// What make() gave for this name before, or gives now; its bytes by bytes_of(value).
  template <class BytesOf, class Make>
  std::shared_ptr<const T> get(const std::string& name, const BytesOf& bytes_of, const Make& make) {
    if (auto known = find(name)) return known;
    auto made = std::make_shared<const T>(make());
    keep(name, made, bytes_of(*made));
    return made;
  }
  void keep(const std::string& name, std::shared_ptr<const T> value, std::size_t bytes) {
    if (bytes > remembered_bytes()) return;
    const std::lock_guard lock(mutex_);
    if (by_name_.contains(name)) return;
    entries_.push_front({name, std::move(value), bytes});
    by_name_[name] = entries_.begin();
    for (held_ += bytes; held_ > remembered_bytes(); entries_.pop_back()) {
      held_ -= entries_.back().bytes;
      by_name_.erase(entries_.back().name);
    }
  }

 private:
  struct Entry {
    std::string name;
    std::shared_ptr<const T> value;
    std::size_t bytes;
  };
  std::mutex mutex_;
  std::list<Entry> entries_;  // used last first
  std::map<std::string, typename std::list<Entry>::iterator> by_name_;
  std::size_t held_ = 0;
};

}  // namespace rainref::cache
