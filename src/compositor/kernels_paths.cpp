// The steps of a path for many rays at once; compiled once for each SIMD target.
#include "compositor/shading_kernels.h"

#define RAINREF_KERNELS "compositor/kernels_paths.cpp"
#include "math/foreach_target.h"
#include "compositor/hit_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "math/optics-inl.h"
#include "compositor/interface-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using N = DoubleLanes;
using Vec3N = Vec3<N>;
constexpr std::size_t n = static_cast<std::size_t>(N::size());

/// For the rays assigned to lanes, which are mostly neighbours.
struct Which {
  const std::uint32_t* list;
  bool is_run;
  HWY_INLINE HWY_ATTR Which(std::span<const std::uint32_t> ascending, std::size_t i)
      : list(&ascending[i]), is_run(i + n <= ascending.size() && list[n - 1] - list[0] == n - 1) {}
  HWY_INLINE HWY_ATTR N of(const double* values) const {
    if (is_run) return N::load(values + list[0]);
    const hn::RebindToSigned<N::D> wide;
    return hn::GatherIndex(N::D(), values, hn::PromoteTo(wide, hn::LoadU(N::DI(), reinterpret_cast<const std::int32_t*>(list))));
  }
  HWY_INLINE HWY_ATTR Vec3N of(const VecArrays& values) const {
    return Vec3N(of(values.component[0]), of(values.component[1]), of(values.component[2]));
  }
};
HWY_INLINE HWY_ATTR Vec3N load(const VecArrays& from, std::size_t i) {
  return Vec3N(N::load(from.component[0] + i), N::load(from.component[1] + i), N::load(from.component[2] + i));
}
HWY_INLINE HWY_ATTR void put(N x, double* to) { hn::StoreU(x.v, N::D(), to); }

HWY_INLINE HWY_ATTR Vec3N unit_direction(const RayList& list, const Which& which) {
  const Vec3N d = which.of(list.rays.direction());
  if (list.length == nullptr) return d;
  const N length = which.of(list.length);
  return Vec3N(d.x / length, d.y / length, d.z / length);
}

void Measure(std::size_t count, const VecArrays& vectors, double* lengths) {
  for (std::size_t i = 0; i < count; i += n) put(length(load(vectors, i)), lengths + i);
}

void Gaze(const RayList& list, const VecArraysOut& origin, const VecArraysOut& direction, double* blur) {
  for (std::size_t i = 0; i < list.which.size(); i += n) {
    const Which which(list.which, i);
    put(which.of(list.rays.origin()), i, origin);
    put(unit_direction(list, which), i, direction);
    put(which.of(list.rays.blur()), blur + i);
  }
}

void Arrive(const RayList& list, const Hit* hits, const Medium& medium, ArrivalColumns& to, const VecArraysOut& added) {
  const N one(1.0), zero(0.0);
  const Vec& extinction = medium.extinction;
  const bool is_clear = !(extinction.x > 0 || extinction.y > 0 || extinction.z > 0),
             is_grey = extinction.x == extinction.y && extinction.y == extinction.z;
  const Vec3N glow(N(medium.glow.x), N(medium.glow.y), N(medium.glow.z));
  for (std::size_t i = 0; i < list.which.size(); i += n) {
    const Which which(list.which, i);
    const Vec3N along = which.of(list.rays.direction()), weight = which.of(list.rays.weight());
    const N t = hn::GatherIndex(N::D(), &hits[i].t, hn::ShiftLeft<2>(hn::Iota(hn::RebindToSigned<N::D>(), 0)));
    const N travelled = which.of(list.rays.travelled()), distance = travelled + (list.length == nullptr ? t : t * which.of(list.length)),
            path = distance - travelled;
    put(which.of(list.rays.origin()) + t * along, i, to.point());
    put(unit_direction(list, which), i, to.direction());
    put(distance, to.distance() + i);
    put(path, to.path() + i);
    put(dot(along, load(to.normal(), i)), to.facing() + i);
    put(which.of(list.rays.blur()), to.blur() + i);
    if (is_clear) {
      put(weight, i, to.weight());
      put(Vec3N(zero, zero, zero), i, added);
      continue;
    }
    const N red = transmittance(N(extinction.x), path);
    const Vec3N left(red, is_grey ? red : transmittance(N(extinction.y), path), is_grey ? red : transmittance(N(extinction.z), path));
    put(weight * left, i, to.weight());
    put(weight * (Vec3N(one, one, one) - left) * glow, i, added);
  }
}

/// A ray from the hit of another. It ignores hits nearer than the spacing of numbers there.
HWY_INLINE HWY_ATTR void start(const ArrivalColumns& from, std::size_t i, const Vec3N& direction, const Vec3N& weight, N blur,
                               RayColumns& to, std::size_t at) {
  const Vec3N point = load(from.point(), i);
  put(point, at, to.origin());
  put(direction, at, to.direction());
  put(weight, at, to.weight());
  put(N(0x1p-52) * max(max(abs(point.x), abs(point.y)), max(abs(point.z), N(1e-3))), to.nearest() + at);
  put(N::load(from.distance() + i), to.travelled() + at);
  put(blur, to.blur() + at);
}

void CrossInterfaces(std::size_t count, const ArrivalColumns& from, const VecArrays* smooth_normals, double ior_outside, double ior_inside,
                     RayColumns& reflected, std::size_t first, RayColumns& refracted, const VecArraysOut& shaded) {
  const N outside(ior_outside), inside(ior_inside), one(1.0), zero(0.0);
  for (std::size_t i = 0; i < count; i += n) {
    const Vec3N direction = load(from.direction(), i), normal = load(from.normal(), i), weight = load(from.weight(), i);
    const auto is_outside = N::load(from.facing() + i) < zero;
    const auto against = [&](const Vec3N& outward)
                             HWY_ATTR { return select(is_outside, outward, Vec3N(-outward.x, -outward.y, -outward.z)); };
    const N here = select(is_outside, outside, inside), beyond = select(is_outside, inside, outside), blur = N::load(from.blur() + i);
    const Vec3N facing = against(normal);
    CrossingOf<N> crossing = smooth_normals == nullptr ? CrossingOf<N>{split(direction, facing, here, beyond), facing}
                                                       : cross_facet(direction, facing, against(load(*smooth_normals, i)), here, beyond);
    const N share = crossing.rays.reflectance;
    start(from, i, crossing.rays.reflected, share * weight, blur, reflected, first + i);
    start(from, i, crossing.rays.refracted, (one - share) * weight, blur, refracted, i);
    put(crossing.normal, i, shaded);
  }
}

void LeaveFinishes(std::size_t count, const ArrivalColumns& from, const Finishes& finishes, RayColumns& mirrored, std::size_t first,
                   const VecArraysOut& sent, const VecArraysOut& shaded) {
  const N zero(0.0);
  for (std::size_t i = 0; i < count; i += n) {
    const Vec3N direction = load(from.direction(), i), normal = load(from.normal(), i), weight = load(from.weight(), i);
    const Vec3N mirror = load(finishes.mirror, i), about = load(finishes.mirror_normal, i);
    const Vec3N facing = select(N::load(from.facing() + i) < zero, normal, Vec3N(-normal.x, -normal.y, -normal.z));
    const auto mirrors = (mirror.x > zero) | (mirror.y > zero) | (mirror.z > zero);
    put(weight * load(finishes.radiance, i), i, sent);
    put(select(mirrors, about, facing), i, shaded);
    const Vec3N nothing(zero, zero, zero);
    if (!any(mirrors)) {
      put(nothing, first + i, mirrored.weight());
      continue;
    }
    // A bump's normal may turn the reflected ray into the surface; it is turned out again.
    const Vec3N turned = reflect(direction, about);
    const Vec3N out = select(dot(turned, facing) < zero, reflect(turned, facing), turned);
    start(from, i, out, select(mirrors, weight * mirror, nothing), N::load(finishes.blur + i), mirrored, first + i);
  }
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(Measure);
RAINREF_EXPORT(Gaze);
RAINREF_EXPORT(Arrive);
RAINREF_EXPORT(CrossInterfaces);
RAINREF_EXPORT(LeaveFinishes);

void measure(std::size_t count, const VecArrays& vectors, double* lengths) { RAINREF_DISPATCH(Measure)(count, vectors, lengths); }
void collect_escaped(const RayList& list, const VecArraysOut& origin, const VecArraysOut& direction, double* blur) {
  RAINREF_DISPATCH(Gaze)(list, origin, direction, blur);
}
void arrive(const RayList& list, const Hit* hits, const Medium& medium, ArrivalColumns& arrivals, const VecArraysOut& added) {
  RAINREF_DISPATCH(Arrive)(list, hits, medium, arrivals, added);
}
void cross_interfaces(std::size_t count, const ArrivalColumns& arrivals, const VecArrays* smooth_normals, double ior_outside,
                      double ior_inside, RayColumns& reflected, std::size_t first, RayColumns& refracted, const VecArraysOut& shaded) {
  RAINREF_DISPATCH(CrossInterfaces)(count, arrivals, smooth_normals, ior_outside, ior_inside, reflected, first, refracted, shaded);
}
void leave_finishes(std::size_t count, const ArrivalColumns& arrivals, const Finishes& finishes, RayColumns& mirrored, std::size_t first,
                    const VecArraysOut& sent, const VecArraysOut& shaded) {
  RAINREF_DISPATCH(LeaveFinishes)(count, arrivals, finishes, mirrored, first, sent, shaded);
}

}  // namespace rainref::compositor
#endif
