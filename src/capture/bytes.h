// Bytes that copies share until one of them is written.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace rainref::capture {

/// The bytes of a level. Copies share them until one is written: a search for causes copies a case for each mistake and writes one of its
/// buffers. Reading is thread-safe. edit() must be called by one thread, before others write through its result.
class Bytes {
 public:
  using value_type = std::byte;
  using const_iterator = std::vector<std::byte>::const_iterator;

  Bytes() = default;
  /// `count` zeros.
  explicit Bytes(std::size_t count) : Bytes(std::vector<std::byte>(count)) {}
  Bytes(std::vector<std::byte> bytes) : bytes_(std::make_shared<std::vector<std::byte>>(std::move(bytes))) {}
  template <class Iterator>
  Bytes(Iterator first, Iterator last) : Bytes(std::vector<std::byte>(first, last)) {}

  const std::vector<std::byte>& all() const { return bytes_ ? *bytes_ : none(); }
  operator const std::vector<std::byte>&() const { return all(); }
  const std::byte* data() const { return all().data(); }
  std::size_t size() const { return all().size(); }
  bool empty() const { return all().empty(); }
  const_iterator begin() const { return all().begin(); }
  const_iterator end() const { return all().end(); }
  const std::byte& operator[](std::size_t at) const { return all()[at]; }

  /// Returns the bytes for writing, owned by this copy alone.
  std::vector<std::byte>& edit() {
    if (!bytes_ || bytes_.use_count() > 1) bytes_ = std::make_shared<std::vector<std::byte>>(all());
    return *bytes_;
  }

  /// True if two copies share their bytes; does not compare them.
  bool shares(const Bytes& other) const { return bytes_ == other.bytes_; }
  friend bool operator==(const Bytes& a, const Bytes& b) { return a.shares(b) || a.all() == b.all(); }

 private:
  static const std::vector<std::byte>& none() {
    static const std::vector<std::byte> empty;
    return empty;
  }

  std::shared_ptr<std::vector<std::byte>> bytes_;
};

}  // namespace rainref::capture
