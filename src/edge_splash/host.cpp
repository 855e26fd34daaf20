#include "edge_splash/host.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "image/colour.h"
#include "math/constants.h"
#include "math/half.h"
#include "math/real64.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::edge_splash {
namespace {

void put_color(const Settings& s, float* out) {
  for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(s.drop_color[static_cast<std::size_t>(k)]);
  out[3] = static_cast<float>(s.drop_alpha);
}
/// Two floats for a smoothstep, the second above the first.
void put_pair(double low, double high, float* a, float* b) {
  *a = static_cast<float>(low);
  *b = std::max(static_cast<float>(high), std::nextafter(*a, 1e30f));
}
/// The first channel as a number; 8-bit codes are code / 255.
double first_channel(const Image& image, int x, int y) {
  const int at = x * image.channels();
  switch (info(image.format()).kind) {
    case FormatInfo::float32:
      return image.row<float>(y)[at];
    case FormatInfo::float16:
      return to_float(image.row<Half>(y)[at]);
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      return to_float(image.row<Unorm8>(y)[at]);
    case FormatInfo::uint32:
      break;
  }
  throw Error(ExitCode::usage, fmt::format("an image of format {} cannot be read as numbers", info(image.format()).name));
}
void require_size(const Image& image, const Image& colour, const char* key) {
  if (image.width() == colour.width() && image.height() == colour.height()) return;
  throw Error(ExitCode::usage, fmt::format("{}: expected {}x{} texels as scene.image has, found {}x{}", key, colour.width(),
                                           colour.height(), image.width(), image.height()));
}

// depth_of, in the required floating-point state.
double device_depth(const DepthRange& r, double distance) {
  const double reversed = r.near_plane * (r.far_plane - distance) / (distance * (r.far_plane - r.near_plane));
  return r.reversed ? reversed : 1 - reversed;
}

}  // namespace

// For a projection onto [near, far]: d (reversed) = near (far - z) / (z (far - near)), so 1 / z = d (1/near - 1/far) + 1/far.
double distance_of(const DepthRange& r, double depth) {
  const FloatingPointGuard guard;
  const double slope = 1 / r.near_plane - 1 / r.far_plane;
  return 1 / ((r.reversed ? depth : 1 - depth) * slope + 1 / r.far_plane);
}
double depth_of(const DepthRange& r, double distance) {
  const FloatingPointGuard guard;
  return device_depth(r, distance);
}

scene::Camera camera(const Settings& s) {
  const auto vector = [](const std::array<double, 3>& a) { return scene::Vector3(a[0], a[1], a[2]); };
  return {vector(s.camera_position), vector(s.camera_target), vector(s.camera_up), s.vertical_fov_deg};
}

void check(const Settings& s) {
  if (!(s.depth.near_plane > 0 && s.depth.near_plane < s.depth.far_plane)) {
    throw Error(ExitCode::usage,
                fmt::format("scene.near, scene.far: expected 0 < near < far, found {} and {}", s.depth.near_plane, s.depth.far_plane));
  }
  if (s.storage != Format::rgba16f && s.storage != Format::rgba8)
    throw Error(ExitCode::usage, "edge_splash.storage: expected rgba16f or rgba8");
  if (s.variant == Variant::corrected && !(s.smallest_band <= s.largest_band)) {
    throw Error(ExitCode::usage, fmt::format("edge_splash.smallest_band: expected no more than edge_splash.largest_band, found {} and {}",
                                             s.smallest_band, s.largest_band));
  }
  require_memory(fmt::format("run.size {}x{}", s.width, s.height), memory_bytes(s));
  if (s.up[0] == 0 && s.up[1] == 0 && s.up[2] == 0) throw Error(ExitCode::usage, "edge_splash.up: expected a direction, found [0, 0, 0]");
  camera(s).basis();  // throws for an invalid camera
  camera(s).half_height();
}

PublishedSplashUniforms published_splash_uniforms(const Settings& s, int frame, int noise_width, int noise_height) {
  PublishedSplashUniforms u{};
  put_color(s, u.drop_color);
  u.width = s.width;
  u.height = s.height;
  u.noise_width = noise_width;
  u.noise_height = noise_height;
  u.edge_threshold = static_cast<float>(s.edge_threshold);
  u.rain_drop_scale = static_cast<float>(s.rain_drop_scale);
  u.time = static_cast<float>(frame / s.fps);
  u.drop_speed = static_cast<float>(s.drop_speed);
  u.thickness = s.thickness;
  return u;
}

SplashUniforms splash_uniforms(const Settings& s, int frame, int noise_width, int noise_height) {
  SplashUniforms u{};
  put_color(s, u.drop_color);
  const scene::Camera eye = camera(s);
  const scene::Camera::Basis basis = eye.basis();
  const scene::Vector3 up = scene::normalized({s.up[0], s.up[1], s.up[2]});
  u.up[0] = static_cast<float>(glm::dot(up, basis.right));
  u.up[1] = static_cast<float>(glm::dot(up, basis.up));
  u.up[2] = static_cast<float>(glm::dot(up, basis.forward));
  const double half_height = eye.half_height(), half_width = half_height * s.width / s.height;
  u.reach = static_cast<float>(s.band * s.height / (2 * half_height));
  u.pixel[0] = static_cast<float>(2 * half_width / s.width);
  u.pixel[1] = static_cast<float>(2 * half_height / s.height);
  u.half_size[0] = static_cast<float>(half_width);
  u.half_size[1] = static_cast<float>(half_height);
  const double slope = 1 / s.depth.near_plane - 1 / s.depth.far_plane;
  u.depth_scale = static_cast<float>(s.depth.reversed ? slope : -slope);
  u.depth_bias = static_cast<float>(s.depth.reversed ? 1 / s.depth.far_plane : 1 / s.depth.near_plane);
  // A band is at least a texel wide, and whole: the taps at its largest reach lie on texels.
  u.reach_min = static_cast<float>(std::max(1.0, std::floor(s.smallest_band * s.height + 0.5)));
  u.reach_max = std::max(u.reach_min, static_cast<float>(std::floor(s.largest_band * s.height + 0.5)));
  // Sobel's sums for a step D are 4 D.
  put_pair(4 * s.edge_step, 4 * s.edge_step * (1 + s.softness), &u.step_low, &u.step_high);
  put_pair(s.edge_bend, s.edge_bend * (1 + s.softness), &u.bend_low, &u.bend_high);
  const double cosine = cos_real(Real64(s.widest_angle_deg * pi / 180)).v;
  put_pair(cosine, cosine + s.softness * (1 - cosine), &u.cosine_low, &u.cosine_high);
  put_pair(s.rain_drop_scale, s.rain_drop_scale + s.softness * (1 - s.rain_drop_scale), &u.noise_low, &u.noise_high);
  const double tiles = 1 / (s.noise_size * s.height);  // a texel of the noise is square
  u.noise_scale[0] = static_cast<float>(tiles * noise_height / noise_width);
  u.noise_scale[1] = static_cast<float>(tiles);
  if (s.has_crowns) return u;  // crowns stay where they hit
  u.noise_offset[0] = static_cast<float>(scrolled(-s.drop_velocity[0] / s.noise_size * noise_height / noise_width, frame, s.fps));
  u.noise_offset[1] = static_cast<float>(scrolled(-s.drop_velocity[1] / s.noise_size, frame, s.fps));
  return u;
}

double scrolled(double velocity, int frame, double fps) {
  const double gone = velocity * frame / fps, rest = gone - std::floor(gone);
  return rest < 1 ? rest : 0.0;  // a small negative number
}

Image prepare_scene(const Image& from, bool is_encoded, const Rows& rows) {
  if (from.empty() || from.channels() != 4) throw Error(ExitCode::usage, "scene.image: expected an image of four channels");
  double linear[256];
  if (is_encoded) {
    for (int code = 0; code < 256; ++code) linear[code] = decode_srgb(code / 255.0);
  }
  Image to(Format::rgba16f, from.width(), from.height());
  const auto kind = info(from.format()).kind;
  rows(from.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Half* out = to.row<Half>(y);
      for (int i = 0; i < 4 * from.width(); ++i) {
        if (kind == FormatInfo::float16)
          out[i] = from.row<Half>(y)[i];
        else if (kind == FormatInfo::float32)
          out[i] = to_half(is_encoded && i % 4 != 3 ? static_cast<float>(decode_srgb(from.row<float>(y)[i])) : from.row<float>(y)[i]);
        else if (is_encoded && i % 4 != 3)
          out[i] = to_half(static_cast<float>(linear[from.row<Unorm8>(y)[i].code]));
        else
          out[i] = to_half(to_float(from.row<Unorm8>(y)[i]));
      }
    }
  });
  return to;
}

Image prepare_depth(const Image& depth, bool is_distance, const Image& colour, const DepthRange& range, const Rows& rows) {
  require_size(depth, colour, "scene.depth_image");
  const double lowest = is_distance ? range.near_plane : 0, highest = is_distance ? range.far_plane : 1;
  const float from_here = static_cast<float>(lowest), up_to = static_cast<float>(highest);  // distances are floats
  const int width = depth.width(), height = depth.height();
  Image to(Format::r32f, width, height);
  std::vector<int> outside(static_cast<std::size_t>(height), width);  // the first column of each row with an invalid depth
  rows(height, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < width; ++x) {
        const double stored = first_channel(depth, x, y);
        if (!(from_here <= stored && stored <= up_to)) {
          outside[static_cast<std::size_t>(y)] = x;
          break;
        }
        to.row<float>(y)[x] = static_cast<float>(is_distance ? device_depth(range, std::clamp(stored, lowest, highest)) : stored);
      }
    }
  });
  for (int y = 0; y < height; ++y) {
    const int x = outside[static_cast<std::size_t>(y)];
    if (x == width) continue;
    throw Error(
        ExitCode::usage,
        fmt::format("scene.depth_image: expected {} from {} to {}, found {} at column {}, row {} from the bottom{}",
                    is_distance ? "distances [m]" : "device depths", lowest, highest, first_channel(depth, x, y), x, y,
                    is_distance ? " (scene.near and scene.far are the limits)" : " (scene.depth_encoding = \"metres\" takes distances)"));
  }
  return to;
}

Image prepare_layer(const Image& layer, const Image& colour) {
  if (!layer.empty()) require_size(layer, colour, "scene.layer_image");
  Image to(Format::r8, colour.width(), colour.height());
  for (int y = 0; y < to.height(); ++y) {
    for (int x = 0; x < to.width(); ++x)
      to.row<Unorm8>(y)[x] = layer.empty() ? Unorm8{255} : to_unorm8(static_cast<float>(first_channel(layer, x, y)));
  }
  return to;
}

Image prepare_noise(const Image& noise, const Settings& s) {
  const Image made = noise.empty() ? make_noise(s.seed) : Image();
  const Image& from = noise.empty() ? made : noise;
  if (from.width() < 2 || from.height() < 2)
    throw Error(ExitCode::usage, fmt::format("scene.noise_image: expected at least 2x2 texels, found {}x{}", from.width(), from.height()));
  Image map(Format::r8, from.width(), from.height());
  for (int y = 0; y < from.height(); ++y) {
    for (int x = 0; x < from.width(); ++x) map.row<Unorm8>(y)[x] = to_unorm8(static_cast<float>(first_channel(from, x, y)));
  }
  if (s.variant == Variant::as_published) return map;
  TextureData texture(map, Address::repeat, Address::repeat);
  texture.build_mips(2);
  const Texture& t = texture.view();
  Image half(Format::r32f, t.width[1], t.height[1]);
  for (int y = 0; y < half.height(); ++y)
    std::copy_n(t.texels + t.offset[1] + static_cast<std::ptrdiff_t>(y) * half.width(), half.width(), half.row<float>(y));
  return half;
}

std::string seam_warning(const Image& noise) {
  const int w = noise.width(), h = noise.height();
  double seam = 0, inside = 0;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double here = first_channel(noise, x, y);
      const double across = std::abs(first_channel(noise, (x + 1) % w, y) - here),
                   along = std::abs(first_channel(noise, x, (y + 1) % h) - here);
      (x + 1 == w ? seam : inside) += across / h;
      (y + 1 == h ? seam : inside) += along / w;
    }
  }
  inside /= std::max(w, h) - 1;
  if (seam <= 6 * inside + 2.0 / 255) return "";
  return fmt::format("scene.noise_image does not tile: neighbours over its seams differ by {:.3f}, others by {:.3f}; the seams will show",
                     seam / 2, inside / 2);
}

}  // namespace rainref::edge_splash
