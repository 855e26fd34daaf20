// windshield.spawn, as-published. New drops in free slots.
@group(0) @binding(2) var<storage, read> spawn_masses: array<SpawnMass>;
@group(0) @binding(3) var<storage, read_write> drops_out: DropsOutBuffer;

// Thresholds that the word is not below: the list has none.
fn above(word: u32) -> u32 { return 0u; }
