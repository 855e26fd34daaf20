#include "cache/remembered.h"

namespace rainref::cache {
namespace {

std::size_t limit = 0;

}  // namespace

void remember(std::size_t most_bytes) { limit = most_bytes; }
std::size_t remembered_bytes() { return limit; }

}  // namespace rainref::cache
