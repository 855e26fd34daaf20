// WebAssembly has no control register: it rounds to nearest even and keeps subnormals, by its specification.
#include "base/floating_point.h"
#include "base/floating_point_unit.h"

namespace rainref {

const std::uint64_t pinned_floating_point_control = 0;

std::uint64_t floating_point_control() { return pinned_floating_point_control; }
void set_floating_point_control(std::uint64_t) {}

namespace floating_point_unit {

std::uint64_t whole_state() { return 0; }
void pin() {}
void put_back(std::uint64_t) {}

}  // namespace floating_point_unit
}  // namespace rainref
