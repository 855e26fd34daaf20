// Without threads: for a platform that has none, which is WebAssembly in a page that is not isolated.
#include "parallel/pool.h"

namespace rainref::parallel {

struct Executor::Pool::Threads {};

Executor::Pool::Pool(int) {}
Executor::Pool::~Pool() = default;

int Executor::Pool::threads() const { return 1; }

void Executor::Pool::run(std::int64_t count, const std::function<void(std::int64_t)>& body) const {
  for (std::int64_t i = 0; i < count; ++i) body(i);
}

}  // namespace rainref::parallel
