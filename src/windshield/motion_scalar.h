// The scalar evaluations of windshield_frame and wipe_drops: Scalar, Enclosure and Perturbed. A namespace of their own, so that argument
// types of this room do not pull them into the lanes.
#pragma once

#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/scalar.h"
#include "math/rearranged.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"

namespace rainref::windshield::motion_scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/drop-inl.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::windshield::motion_scalar
