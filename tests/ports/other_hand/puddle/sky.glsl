// Directions to the environment, both layouts, for both variants of shade.
const float TURN = 6.28318530718;

// The direction of view of a pixel.
vec3 sight(ivec2 here) {
  vec2 plane = vec2(given.camera_plane_left, given.camera_plane_bottom) + (vec2(here) + 0.5) * given.camera_pixel_scale;
  return normalize(given.camera_forward + plane.x * given.camera_right + plane.y * given.camera_up);
}
vec3 turned(vec3 way) {
  float c = given.rotation.x;
  float s = given.rotation.y;
  return vec3(c * way.x + s * way.z, way.y, c * way.z - s * way.x);
}
// Latitude and longitude in one picture.
vec3 globe(vec3 way, float level) {
  float longitude = atan(way.z, way.x);
  float latitude = atan(way.y, length(way.xz));
  vec2 place = vec2(0.5) + vec2(longitude / TURN, latitude / (0.5 * TURN));
  return textureLod(environment, place, level).rgb;
}
// Six faces in one column.
vec3 box(vec3 way, float level) {
  vec3 size = abs(way);
  vec3 face;  // across, down, number
  float axis;
  if (size.x >= size.y && size.x >= size.z) {
    axis = size.x;
    face = way.x >= 0.0 ? vec3(-way.z, -way.y, 0.0) : vec3(way.z, -way.y, 1.0);
  } else if (size.y >= size.z) {
    axis = size.y;
    face = way.y >= 0.0 ? vec3(way.x, way.z, 2.0) : vec3(way.x, -way.z, 3.0);
  } else {
    axis = size.z;
    face = way.z >= 0.0 ? vec3(way.x, -way.y, 4.0) : vec3(-way.x, -way.y, 5.0);
  }
  int mip = int(floor(level + 0.5));
  float edge = float(max(textureSize(environment, 0).x >> mip, 1));
  vec2 place = 0.5 * (face.xy / axis) + 0.5;
  place = clamp(place, vec2(0.5 / edge), vec2(1.0 - 0.5 / edge));
  return textureLod(environment, vec2(place.x, (place.y + face.z) / 6.0), float(mip)).rgb;
}
vec3 sky(vec3 way, float level) {
  vec3 there = turned(way);
  return given.environment_is_cube == 1 ? box(there, level) : globe(there, level);
}
// Tiles of the ground.
vec3 tiles(vec2 ground_place) {
  vec2 tile = floor(ground_place * given.ground_scale);
  float sum = tile.x + tile.y;
  float odd = sum - 2.0 * floor(0.5 * sum);
  return mix(vec3(0.15, 0.12, 0.10), vec3(0.25, 0.22, 0.20), odd);
}
