// The panes of a car: the windshield, and others that a scene names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "windshield/motion/glass.h"

namespace rainref::windshield {

/// "x y z, x y z, x y z; ...": the corners of each pane at (u, v) = (0, 0), (1, 0) and (0, 1) [m]. Throws Error(usage) naming
/// windshield.panes and the pane.
std::vector<Corners> parse_panes(std::string_view text);

/// "windshield.panes, pane 2", of pane number k from 1 on; "the glass" of the windshield, number 0.
std::string pane_name(int number);

}  // namespace rainref::windshield
