// The rows of a picture on the threads of an executor.
#pragma once

#include "base/rows.h"
#include "rainref/executor.h"

namespace rainref::parallel {

/// The executor must outlive the result.
inline Rows rows_of(const Executor& executor) {
  return [&executor](int count, const std::function<void(int, int)>& body) {
    constexpr int chunk = 16;
    executor.for_range(count, chunk, [&](std::int64_t begin, std::int64_t end) { body(static_cast<int>(begin), static_cast<int>(end)); });
  };
}

}  // namespace rainref::parallel
