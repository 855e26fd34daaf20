// The environment that shade looks up: both layouts alike, rotation, mean. Lookups by direction: tests/image/environment_test.cpp.
#include <algorithm>

#include "puddle/scenery.h"
#include "puddle/scene_support.h"
#include "random/counter.h"

namespace rainref::puddle::test {
namespace {

TextureData prepared(const Surroundings& s) {
  return prepare_environment(s.environment, s.environment_is_cube, s.environment_is_encoded, Variant::corrected);
}

using Direction = std::array<double, 3>;

Vec3<Double> vec(const Direction& d) { return Vec3<Double>(Double(d[0]), Double(d[1]), Double(d[2])); }
Direction unit(double x, double y, double z) {
  const double l = std::sqrt(x * x + y * y + z * z);
  return {x / l, y / l, z / l};
}

// A smooth radiance: its gradient on the sphere is at most 1.1.
double radiance(const Direction& d) { return 2 + 0.5 * d[0] + 0.7 * d[1] - 0.3 * d[2] + 0.2 * d[0] * d[1]; }
constexpr double gradient = 1.1;

Direction latlong_direction(double u, double v) {
  const double azimuth = (u - 0.5) * 2 * pi, elevation = (v - 0.5) * pi;
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}
// The table of the OpenGL specification (cube map texture selection): (s, t) in [-1, 1] of a face to a direction.
Direction cube_direction(int face, double s, double t) {
  switch (face) {
    case 0:
      return {1, -t, -s};
    case 1:
      return {-1, -t, s};
    case 2:
      return {s, 1, t};
    case 3:
      return {s, -1, -t};
    case 4:
      return {s, -t, 1};
    default:
      return {-s, -t, -1};
  }
}

TextureData paint(int width, int height, bool is_cube) {
  Surroundings s;
  s.environment = Image(Format::rgba32f, width, height);
  s.environment_is_cube = is_cube;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Direction d;
      if (is_cube) {
        const Direction c = cube_direction(y / width, 2 * (x + 0.5) / width - 1, 2 * (y % width + 0.5) / width - 1);
        d = unit(c[0], c[1], c[2]);
      } else {
        d = latlong_direction((x + 0.5) / width, (y + 0.5) / height);
      }
      s.environment.row<float>(y)[4 * x] = static_cast<float>(radiance(d));
    }
  }
  return prepared(s);
}
double look(const TextureData& t, bool is_cube, const Direction& d) {
  return scalar::sample_environment(t.view(), is_cube, vec(d), Double(0.0f)).x.v;
}
Direction random_direction(std::uint32_t i) {
  const auto b = random::block(3, random::Purpose::puddle_drop, i, 0);
  const double z = 2 * random::uniform(b[0]) - 1, a = 2 * pi * random::uniform(b[1]), r = std::sqrt(1 - z * z);
  return {r * std::cos(a), z, r * std::sin(a)};
}

TEST(PuddleEnvironment, CubeAndLatitudeLongitudeAgree) {
  const TextureData cube = paint(64, 384, true), sphere = paint(256, 128, false);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const Direction d = random_direction(i);
    // Half a texel of the cube's edge is the coarsest: 2 / 64 by the gradient, plus both interpolation errors.
    ASSERT_NEAR(look(cube, true, d), look(sphere, false, d), 2.0 / 64 * gradient + 4e-3) << d[0] << " " << d[1] << " " << d[2];
  }
}

TEST(PuddleEnvironment, FacesInARowAreTheSameCube) {
  constexpr int side = 2;
  Surroundings column, row;
  column.environment_is_cube = row.environment_is_cube = true;
  column.environment = Image(Format::rgba32f, side, 6 * side);
  row.environment = Image(Format::rgba32f, 6 * side, side);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < side; ++y) {
      for (int i = 0; i < side * 4; ++i) {
        const float value = static_cast<float>(face * 100 + y * 10 + i);
        column.environment.row<float>(face * side + y)[i] = row.environment.row<float>(y)[face * side * 4 + i] = value;
      }
    }
  }
  TextureData a = prepared(column), b = prepared(row);
  ASSERT_EQ(b.view().width[0], side);
  ASSERT_EQ(b.view().height[0], 6 * side);
  EXPECT_EQ(std::vector<float>(a.texels(), a.texels() + 96), std::vector<float>(b.texels(), b.texels() + 96));
  Surroundings wrong;
  wrong.environment_is_cube = true;
  wrong.environment = Image(Format::rgba32f, 8, 4);
  EXPECT_EQ(error_of([&] { prepared(wrong); }), "2 environment.image: a cube needs six square faces in a row or a column, found 8x4");
}

TEST(PuddleEnvironment, RotationTurnsTheLookupAboutTheVertical) {
  // By env_rotation a, the direction at azimuth phi is looked up at phi - a (azimuth from +x to +z).
  for (const double a : {0.0, pi / 2, 1.0, 5.5}) {
    Settings s = corrected(1, 1);
    s.env_rotation = a;
    const ShadeUniforms u = shade_uniforms(s);
    for (double azimuth = 0; azimuth < 6; azimuth += 0.7) {
      const Direction d{0.8 * std::cos(azimuth), 0.6, 0.8 * std::sin(azimuth)};
      const Vec3<Double> r = scalar::rotate_y(vec(d), u.rotation);
      EXPECT_NEAR(r.x.v, 0.8 * std::cos(azimuth - a), 1e-7);  // cosine and sine are floats
      EXPECT_EQ(r.y.v, d[1]);
      EXPECT_NEAR(r.z.v, 0.8 * std::sin(azimuth - a), 1e-7);
    }
  }
}

TEST(PuddleEnvironment, RotationIsSeenInThePicture) {
  // A sky that is bright toward +x only; a camera that looks up along an azimuth sees it when the rotation says so.
  Surroundings around = uniform_surroundings(0, 0);
  around.environment = uniform_image(8, 4, 0, 0, 0);
  for (int y = 0; y < 4; ++y) around.environment.row<float>(y)[4 * 4] = around.environment.row<float>(y)[4 * 3] = 1;
  for (const bool is_corrected : {false, true}) {
    for (const double rotation : {0.0, pi / 2, pi}) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        Settings s = is_corrected ? corrected(1, 1) : as_published(1, 1);
        s.env_rotation = rotation;
        s.camera_position = {0, 50, 0};
        s.camera_target = {std::cos(quarter * pi / 2), 50.5, std::sin(quarter * pi / 2)};
        Puddle p(s, around, executor());
        p.render();
        const bool bright = std::lround(rotation / (pi / 2)) % 4 == quarter;
        EXPECT_NEAR(colour_of(p, 0, 0, 0), bright ? 1 : 0, 1e-3) << is_corrected << " " << rotation << " " << quarter;
      }
    }
  }
}

TEST(PuddleEnvironment, AmbientRadianceIsTheCosineMeanOfTheUpperHalf) {
  // L = a + b d_y has (1/pi) integral of L cos = a + 2 b / 3 over the upper half. Midpoint rule: error O(texel^2).
  const auto paint_linear = [](int width, int height, bool is_cube) {
    Surroundings s;
    s.environment = Image(Format::rgba32f, width, height);
    s.environment_is_cube = is_cube;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        Direction d = latlong_direction((x + 0.5) / width, (y + 0.5) / height);
        if (is_cube) {
          const Direction c = cube_direction(y / width, 2 * (x + 0.5) / width - 1, 2 * (y % width + 0.5) / width - 1);
          d = unit(c[0], c[1], c[2]);
        }
        s.environment.row<float>(y)[4 * x] = static_cast<float>(0.5 + 0.3 * d[1]);
      }
    }
    return prepared(s);
  };
  EXPECT_NEAR(ambient_radiance(paint_linear(128, 64, false).view(), false)[0], 0.7, 5e-4);
  EXPECT_NEAR(ambient_radiance(paint_linear(64, 384, true).view(), true)[0], 0.7, 5e-4);
}

}  // namespace
}  // namespace rainref::puddle::test
