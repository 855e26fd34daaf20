// rainy_glass.bake_raindrops, corrected. The raindrop map: normals, time offsets and heights of droplets on a tile.
// Once, before frame 0.

// Whose cell a texel is in: the droplet's with the smallest measure.
fn cell_measure(distance_sq: f32, radius: f32) -> f32 { return distance_sq - radius * radius; }
