// The texts of wipe_texture and normals with every number but lanes: Plain, Enclosure and Perturbed; like puddle::every.
#pragma once

#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/plain.h"
#include "windshield/segment_distance_enclosed.h"
#include "windshield/surface.h"

namespace rainref::windshield::every {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "windshield/normals.pass.h"
#include "windshield/wipe_texture.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::windshield::every
