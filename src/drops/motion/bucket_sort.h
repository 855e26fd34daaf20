// A parallel sort by small keys.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rainref/executor.h"

namespace rainref::drops {

/// Elements sorted into buckets of neighbouring keys: the first step of a counting sort. The second step sorts each bucket separately. The
/// elements of a bucket keep their order for any number of threads.
class BucketSort {
 public:
  static constexpr std::uint32_t no_key = 0xffffffffu;
  struct Entry {
    std::uint32_t key, element;
  };

  /// Elements 0 to count - 1. key_of(element) is below `keys`, or no_key to leave the element out. It is called twice, the first time as
  /// make_key(element).
  template <class MakeKey, class KeyOf>
  void sort(const parallel::Executor& executor, std::int64_t count, std::int64_t chunk, std::uint32_t keys, const MakeKey& make_key,
            const KeyOf& key_of) {
    keys_ = keys;
    shift_ = 0;
    const std::int64_t most = std::clamp<std::int64_t>(count / elements_in_bucket, 1, most_buckets);
    while ((keys >> shift_) >= most) ++shift_;
    const std::size_t buckets = (keys >> shift_) + 1u, chunks = static_cast<std::size_t>((count + chunk - 1) / chunk);
    // In a bucket the elements of all chunks follow each other in order, so the offsets are those of a single thread.
    std::vector<std::uint32_t>& offset = offset_;
    offset.resize(std::max(offset.size(), chunks * buckets));
    using Counts = std::array<std::uint32_t, most_buckets + 1>;
    executor.for_range(count, chunk, [&](std::int64_t begin, std::int64_t end) {
      Counts counts{};
      for (std::int64_t i = begin; i < end; ++i)
        if (const std::uint32_t key = make_key(i); key != no_key) ++counts[key >> shift_];
      for (std::size_t b = 0, c = static_cast<std::size_t>(begin / chunk); b < buckets; ++b) offset[b * chunks + c] = counts[b];
    });
    start_.resize(buckets + 1);
    std::uint32_t sum = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
      start_[b] = sum;
      for (std::size_t c = 0; c < chunks; ++c) sum += std::exchange(offset[b * chunks + c], sum);
    }
    start_[buckets] = sum;
    if (entries_.size() < sum) entries_.resize(sum);
    executor.for_range(count, chunk, [&](std::int64_t begin, std::int64_t end) {
      Counts to;
      for (std::size_t b = 0, c = static_cast<std::size_t>(begin / chunk); b < buckets; ++b) to[b] = offset[b * chunks + c];
      for (std::int64_t i = begin; i < end; ++i)
        if (const std::uint32_t key = key_of(i); key != no_key) entries_[to[key >> shift_]++] = {key, static_cast<std::uint32_t>(i)};
    });
  }

  std::size_t buckets() const { return start_.size() - 1; }
  /// Start of a bucket among all sorted elements, and its elements.
  std::uint32_t start(std::size_t bucket) const { return start_[bucket]; }
  std::span<const Entry> operator[](std::size_t bucket) const {
    return {entries_.data() + start_[bucket], entries_.data() + start_[bucket + 1]};
  }
  /// Keys of a bucket: from the first to one before the second.
  std::pair<std::uint32_t, std::uint32_t> keys(std::size_t bucket) const {
    const auto at = [&](std::size_t b) {
      const std::uint64_t key = static_cast<std::uint64_t>(b) << shift_;
      return key < keys_ ? static_cast<std::uint32_t>(key) : keys_;
    };
    return {at(bucket), at(bucket + 1)};
  }

 private:
  static constexpr std::int64_t most_buckets = 512, elements_in_bucket = 256;  // starting a bucket costs as much as some elements
  std::uint32_t keys_ = 0;
  int shift_ = 0;
  std::vector<std::uint32_t> offset_, start_;
  std::vector<Entry> entries_;
};

}  // namespace rainref::drops
