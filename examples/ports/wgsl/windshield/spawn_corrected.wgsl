// windshield.spawn, corrected. New drops in free slots.
struct CountThreshold {
  threshold : u32,  //   0  [1] A word not below k thresholds draws first_count + k drops.
}
@group(0) @binding(2) var<storage, read> count_thresholds: array<CountThreshold>;
@group(0) @binding(3) var<storage, read> spawn_masses: array<SpawnMass>;
@group(0) @binding(4) var<storage, read_write> drops_out: DropsOutBuffer;

// Thresholds that the word is not below.
fn above(word: u32) -> u32 {
  var n = 0u;
  for (var i = 0; i < u.threshold_count; i++) {
    if (word >= count_thresholds[i].threshold) { n++; }
  }
  return n;
}
