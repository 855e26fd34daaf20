// How the calls of a golden scene are made, so that a test may make them as a hostile caller does.
#pragma once

#include <functional>

namespace rainref::golden {

/// Makes one public call. The first of a scene opens the effect; the others advance and render it.
using Caller = std::function<void(const std::function<void()>& call)>;
inline void call_plainly(const std::function<void()>& call) { call(); }

}  // namespace rainref::golden
