// Direction of the view ray through the centre of a pixel; row 0 is the bottom of the picture.
fn view_ray(pixel: vec2i) -> vec3f {
  let place = vec2f(u.camera_plane_left, u.camera_plane_bottom) + (vec2f(pixel) + 0.5) * u.camera_pixel_scale;
  let direction = u.camera_forward + place.x * u.camera_right + place.y * u.camera_up;
  return normalize(direction);
}
