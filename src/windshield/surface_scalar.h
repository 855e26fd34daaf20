// The scalar evaluations of persist, wipe_texture, condense, normals and falling_rain: Scalar, Enclosure and Perturbed. A namespace of
// their own, so that argument types of this room do not pull them into the lanes.
#pragma once

#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/scalar.h"
#include "math/rearranged.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/surface/segment_distance_enclosed.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::windshield::scalar
