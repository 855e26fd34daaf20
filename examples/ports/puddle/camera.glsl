// Direction of the view ray through the centre of a pixel; row 0 is the bottom of the picture.
vec3 view_ray(ivec2 pixel) {
  vec2 place = vec2(u.camera_plane_left, u.camera_plane_bottom) + (vec2(pixel) + 0.5) * u.camera_pixel_scale;
  vec3 direction = u.camera_forward + place.x * u.camera_right + place.y * u.camera_up;
  return normalize(direction);
}
