#include "windows/copies.h"

namespace rainref::test {

long long weighted(long long a, long long b, long long c, long long d) { return next_of(a) + 3 * b + 5 * c + 7 * d; }

}  // namespace rainref::test
