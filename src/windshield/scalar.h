// The scalar evaluations of every pass: Scalar, Enclosure, Rearranged and Perturbed. They have their own namespace, so that argument types
// of this room do not pull them into the lanes.
#pragma once

#include "image/footprint.h"
#include "image/texture.h"
#include "math/numbers.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/soften.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/segment_distance_enclosed.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/surface/wipe_texture.pass.h"

namespace rainref::windshield::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/drop-inl.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#include "math/optics-inl.h"
#include "image/sampling_numbers-inl.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/picture/soften.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::windshield::scalar
