// The scalar evaluations of the passes of edge_splash: for the oracle and the tests.
#pragma once

#include "edge_splash/splash.pass.h"
#include "image/texture.h"
#include "math/plain.h"

namespace rainref::edge_splash::scalar {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "edge_splash/splash.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::edge_splash::scalar
