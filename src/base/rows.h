// How the rows of a picture are run, for rooms that know nothing of threads.
#pragma once

#include <functional>

namespace rainref {

/// Calls body(begin, end) for rows [0, count), at once or in concurrent parts; body writes only data of its rows.
using Rows = std::function<void(int count, const std::function<void(int begin, int end)>& body)>;

/// All rows in one call, on the calling thread.
inline void rows_here(int count, const std::function<void(int begin, int end)>& body) { body(0, count); }

}  // namespace rainref
