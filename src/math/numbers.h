// All number types except lanes, for the scalar evaluations of a pass.
#pragma once

#include "math/enclosure.h"
#include "math/perturbed.h"
#include "math/rearranged.h"
#include "math/scalar.h"
