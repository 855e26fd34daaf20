// The optics of all passes, evaluated in double from the same text.
#pragma once

#include "compositor/surface.h"
#include "image/texture.h"
#include "math/scalar.h"

namespace rainref::compositor::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/environment-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using Number = Scalar<double>;
inline Vec3<Number> number(const Vec& a) { return {Number(a.x), Number(a.y), Number(a.z)}; }
inline Vec vec(const Vec3<Number>& a) { return {a.x.v, a.y.v, a.z.v}; }

}  // namespace rainref::compositor::scalar
