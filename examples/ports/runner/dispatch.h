// Runs one case of a pack on a device.
#pragma once

#include <map>

#include "ports/runner/bindings.h"
#include "ports/runner/device.h"

namespace port_runner {

/// Values of specialization constants by id.
using Constants = std::map<std::uint32_t, std::int32_t>;

/// Uploads the case's inputs and uniform bytes, dispatches the program, and returns the outputs in the case's order, in
/// the storage type. `extra` overrides the constants that the program takes from the manifest. Throws Error naming file,
/// key or device limit.
std::vector<Array> run_case(const Device& device, const Pack& pack, const Case& of, const Program& program, const Constants& extra);

}  // namespace port_runner
