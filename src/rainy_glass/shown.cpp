#include "rainy_glass/shown.h"

#include "math/half.h"
#include "rainy_glass/host.h"
#include "rainy_glass/scalar.h"

namespace rainref::rainy_glass {

using Number = scalar::Scalar<double>;

ShownGlass::ShownGlass(const Settings& settings, const Surroundings& around, const RainyGlass& rendered)
    : surroundings_(around),
      rendered_(rendered),
      raindrops_(rendered.raindrops(), Address::repeat, Address::repeat),
      rivulets_(rendered.rivulets(), Address::repeat, Address::repeat),
      near_(near_depth(around.depth), Address::clamp, Address::clamp),
      width_(settings.width),
      height_(settings.height) {
  const auto code = [&](const Image& map) { return code_of(settings, map.empty() ? settings.map_storage : map.format()); };
  uniforms_ = rain_on_glass_uniforms(settings, rendered.frame() - 1, code(around.raindrops), code(around.rivulets));
}

Shown ShownGlass::at(int column, int row) const {
  const RainOnGlassUniforms& c = uniforms_;
  const float* place = rendered_.surface().row<float>(row) + 4 * column;
  const Half* stored = rendered_.orientation().row<Half>(row) + 4 * column;
  const auto half = [&](int k) { return Number(to_float(stored[k])); };
  const scalar::Vec3<Number> normal(half(0), half(1), half(2)), none(Number(0.0f), Number(0.0f), Number(0.0f));
  const scalar::GlassPixel<Number> p{
      Number(place[0]), Number(place[1]), Number(place[2]), half(3), normal, none, Number(surroundings_.depth.row<float>(row)[column])};
  Shown shown{p.covered.v > 0.5 && p.own_depth.v > p.distance.v, false, (2 * (column + 0.5) / width_ - 1) * c.half_width,
              (2 * (row + 0.5) / height_ - 1) * c.half_height};
  if (!shown.is_behind) return shown;
  const scalar::GlassMaps<Texture, Texture, Texture> maps{&raindrops_.view(), &rivulets_.view(), nullptr, nullptr, nullptr};
  const Number steep = scalar::steepness(normal);
  const auto slope = scalar::water_slope(c, maps, p.u, p.v, normal, steep);
  if (!scalar::is_wet(slope)) return shown;
  const auto moved = scalar::prism(c, normal, steep, slope);
  const double beyond = scalar::share_beyond(p).v, x = shown.x + moved.a.v * beyond, y = shown.y + moved.b.v * beyond;
  const Number su(0.5 + 0.5 * x / c.half_width), sv(0.5 + 0.5 * y / c.half_height);
  if (!(scalar::sample_bilinear<0, 1, Number>(fixed_texture<Address::clamp, Address::clamp, 1>(near_.view()), su, sv)[0].v > p.distance.v))
    return {true, true, shown.x, shown.y};
  return {true, true, x, y};
}

ShownGlass::Slope ShownGlass::slope(double u, double v, const scene::Vector3& normal) const {
  const scalar::Vec3<Number> n{Number(normal.x), Number(normal.y), Number(normal.z)};
  const scalar::GlassMaps<Texture, Texture, Texture> maps{&raindrops_.view(), &rivulets_.view(), nullptr, nullptr, nullptr};
  const auto slope = scalar::water_slope(uniforms_, maps, Number(u), Number(v), n, scalar::steepness(n));
  return {slope.a.v, slope.b.v, scalar::is_wet(slope)};
}

}  // namespace rainref::rainy_glass
