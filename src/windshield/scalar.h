// The scalar evaluations of the picture and of smear: Scalar, Enclosure and Perturbed. A namespace of their own, so that argument types of
// this room do not pull them into the lanes.
#pragma once

#include "image/footprint.h"
#include "image/texture.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/scalar.h"
#include "math/rearranged.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/picture/soften.pass.h"
#include "windshield/surface_scalar.h"

namespace rainref::windshield::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling_perturbed-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_enclosed-inl.h"
#include "image/sampling_rearranged-inl.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/picture/soften.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::windshield::scalar
