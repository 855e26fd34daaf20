// The scene parameters of the blades of one pane: declared once, for the windshield and for the car's further panes.
#pragma once

#include <string>
#include <vector>

#include "scene/config.h"
#include "windshield/motion/host.h"

namespace rainref::windshield {

/// What a scene says of the blades of one pane.
struct PaneWipers {
  WiperSettings wipers;
  Capture capture;  ///< as-published
};

/// So many of the panes behind the windshield may have wipers: the first ones of windshield.panes.
constexpr int most_wiped_panes = 2;

/// The table that speaks of pane `number`: "wipers" of the windshield, number 0, "pane_1_wipers" of the first of the others.
std::string wiper_table(int number);

/// The keys of that table. The windshield has two blades by default, another pane none; in all else the defaults are the same.
std::vector<scene::Parameter> wiper_parameters(int number);

/// What they say, checked, for this pane of glass. Throws Error(usage) as check and WiperMotion do.
PaneWipers wipers_from(const scene::Config& config, int number, const Glass& glass);

/// Throws Error(usage), placed, for any key of that table which the scene gives.
void refuse_wipers(const scene::Config& config, int number, const std::string& why);

}  // namespace rainref::windshield
