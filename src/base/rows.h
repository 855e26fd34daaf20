// Who runs the rows of a picture, for rooms that know nothing of threads.
#pragma once

#include <functional>

namespace rainref {

/// Calls body(begin, end) for rows [0, count), whole or in parts at once; body writes only what belongs to its rows.
using Rows = std::function<void(int count, const std::function<void(int begin, int end)>& body)>;

/// All of them at once, by who asks.
inline void rows_here(int count, const std::function<void(int begin, int end)>& body) { body(0, count); }

}  // namespace rainref
