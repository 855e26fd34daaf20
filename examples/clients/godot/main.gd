# godot3 --path examples/clients/godot -s main.gd FLAT OUT: runs the puddle's wave_step and display (corrected) of a flat pack.
# Debian: godot3, and xvfb where there is no screen. load_flat, load_bytes and save_image are those of docs/dumps.md.
extends SceneTree

const FORMATS := {"rg16f": Image.FORMAT_RGH, "rgba16f": Image.FORMAT_RGBAH}
# Offsets of the uniforms in their blocks, by type.
const UNIFORMS := {
	"wave_step": {"damping": 0, "courant_sq": 8, "drop_count": 12, "rest": 16, "rim_damping": 20, "rim_inverse": 24, "size": 32},
	"display": {"vignette": 0, "exposure": 4, "width": 8, "height": 12},
}

static func load_flat(folder: String) -> Dictionary:
	var file := File.new()
	file.open(folder.plus_file("flat.json"), File.READ)
	return parse_json(file.get_as_text())

static func load_bytes(folder: String, entry: Dictionary) -> PoolByteArray:
	var file := File.new()
	file.open(folder.plus_file(entry["file"]), File.READ)
	return file.get_buffer(int(entry["bytes"]))

# `texels` holds the rows from v = 0 on, without padding, in the format of `output`, an entry of "outputs".
static func save_image(folder: String, output: Dictionary, texels: PoolByteArray) -> void:
	var path: String = folder.plus_file(output["file"])
	Directory.new().make_dir_recursive(path.get_base_dir())
	var file := File.new()
	file.open(path, File.WRITE)
	file.store_buffer(texels)
	file.close()
	file.open(path.get_basename() + ".json", File.WRITE)
	file.store_string(to_json({"format": output["format"], "width": output["width"], "height": output["height"]}))
	file.close()

static func stream(bytes: PoolByteArray, offset: int) -> StreamPeerBuffer:
	var out := StreamPeerBuffer.new()
	out.data_array = bytes
	out.seek(offset)
	return out

static func uniform_of(block: PoolByteArray, name: String, offset: int):
	var from := stream(block, offset)
	if name == "drop_count":
		return from.get_32()
	return Vector2(from.get_float(), from.get_float()) if name == "size" else from.get_float()

# A list of records of 16 bytes is a column of RGBAF texels; an empty one is a row of zeros.
static func texture_of(bytes: PoolByteArray, input: Dictionary) -> ImageTexture:
	var image := Image.new()
	if input["format"] == "records":
		if bytes.size() == 0:
			bytes.resize(int(input["struct_stride"]))
		image.create_from_data(1, bytes.size() / 16, false, Image.FORMAT_RGBAF, bytes)
	else:
		image.create_from_data(int(input["width"]), int(input["height"]), false, FORMATS[input["format"]], bytes)
	var texture := ImageTexture.new()
	texture.create_from_image(image, 0)
	return texture

# A viewport of halves that draws one rectangle once.
func viewport_of(folder: String, case: Dictionary) -> Viewport:
	var output: Dictionary = case["outputs"][0]
	var viewport := Viewport.new()
	viewport.size = Vector2(output["width"], output["height"])
	viewport.usage = Viewport.USAGE_3D  # 2D alone has 10 bits
	viewport.hdr = true
	viewport.own_world = true
	viewport.render_target_v_flip = true
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	var material := ShaderMaterial.new()
	material.shader = load("res://%s.shader" % case["pass"])
	var block := load_bytes(folder, case["uniforms"])
	for name in UNIFORMS[case["pass"]]:
		material.set_shader_param(name, uniform_of(block, name, UNIFORMS[case["pass"]][name]))
	for input in case["inputs"]:
		material.set_shader_param(input["name"], texture_of(load_bytes(folder, input), input))
	var rectangle := ColorRect.new()
	rectangle.rect_size = viewport.size
	rectangle.material = material
	viewport.add_child(rectangle)
	root.add_child(viewport)
	return viewport

# Codes of 8 bits, rounded, of a picture in floats.
static func codes_of(image: Image) -> PoolByteArray:
	var out := PoolByteArray()
	image.convert(Image.FORMAT_RGBAF)
	var from := stream(image.get_data(), 0)
	for i in image.get_width() * image.get_height() * 4:
		out.append(int(round(255.0 * clamp(from.get_float(), 0.0, 1.0))))
	return out

func _init() -> void:
	var arguments := Array(OS.get_cmdline_args())
	var folder: String = arguments[-2]
	var out: String = arguments[-1]
	var count := 0
	for case in load_flat(folder)["cases"]:
		if not case["pass"] in UNIFORMS:
			continue
		var viewport := viewport_of(folder, case)
		yield(self, "idle_frame")
		yield(self, "idle_frame")
		var image := viewport.get_texture().get_data()
		var output: Dictionary = case["outputs"][0]
		if output["format"] == "rgba8":
			save_image(out, output, codes_of(image))
		else:  # four halves where the buffer has two: a conversion in Godot drops subnormal ones
			output["format"] = "rgba16f"
			save_image(out, output, image.get_data())
		viewport.queue_free()
		count += 1
	var file := File.new()
	file.open(out.plus_file("port.json"), File.WRITE)
	file.store_string(to_json({"api": "OpenGL ES 3.0", "device": VisualServer.get_video_adapter_name(), "notes": "Godot " + Engine.get_version_info()["string"]}))
	file.close()
	print("%d cases" % count)
	quit()
