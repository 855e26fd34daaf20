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

/// Seconds of dispatches of the program on the case's inputs, one after another for `seconds`, at least three: from submitting one to
/// its end. Uploads, read-backs and compilation do not count. Outputs that are images alone: a list would grow from one to the next.
std::vector<double> time_case(const Device& device, const Pack& pack, const Case& of, const Program& program, const Constants& extra,
                              double seconds);

}  // namespace port_runner
