// Every number but the lanes: what scalar evaluations of a pass are made with.
#pragma once

#include "math/enclosure.h"
#include "math/perturbed.h"
#include "math/rearranged.h"
#include "math/scalar.h"
