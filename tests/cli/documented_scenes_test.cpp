// What docs/scenes.md prints: its blocks are scenes, or parts of scenes of the effects that it names, and every effect reads the kinds of
// pictures that it lists.
#include "cli/picture_files.h"
#include "cli/scene_file.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;

class DocumentedScenes : public SceneFiles {
 protected:
  DocumentedScenes() : document(contents(std::filesystem::path(test::source_folder()) / "docs/scenes.md")) {
    const std::string fence = "```toml\n";
    for (std::size_t at = 0; (at = document.find(fence, at)) != std::string::npos; ++at)
      blocks.push_back(document.substr(at + fence.size(), document.find("```", at + fence.size()) - at - fence.size()));
  }
  /// Loads head and block as one scene: an unknown, unused or wrong key throws.
  void load(const std::string& head, const std::string& block) {
    put(folder / "pasted.toml", head + block);
    SceneOptions options;
    options.scene = folder / "pasted.toml";
    EXPECT_NO_THROW(load_scene(options)) << head << block;
  }
  static std::string head(const std::string& effect) { return "effect = \"" + effect + "\"\nvariant = \"corrected\"\n"; }

  std::string document;
  std::vector<std::string> blocks;
};

TEST_F(DocumentedScenes, TheBlocksAreScenes) {
  ASSERT_EQ(blocks.size(), 3u);
  load("", blocks[0]);
  for (const char* effect : {"screen_drops", "rainy_glass"}) load(head(effect), blocks[1]);
  for (const char* effect : {"windshield", "rainy_glass"}) load(head(effect), blocks[2]);
  // What the document says of the other two.
  const std::size_t key = blocks[2].find("[scene]\n");
  ASSERT_NE(key, std::string::npos);
  load(head("edge_splash"), blocks[2].substr(0, key) + "[scene]\nsource = \"files\"\n" + blocks[2].substr(key + 8));
  const std::size_t depth = blocks[2].find("depth_image");
  ASSERT_NE(depth, std::string::npos);
  load(head("screen_drops"), blocks[2].substr(0, depth) + blocks[2].substr(blocks[2].find('\n', depth) + 1));
}

TEST_F(DocumentedScenes, EveryEffectReadsTheListedPictures) {
  const std::size_t section = document.find("## Pictures from files");
  ASSERT_NE(section, std::string::npos);
  for (const char* kind : {"EXR", "Radiance HDR", "PNG", "JPEG", "NPY"})
    EXPECT_LT(document.find(kind, section), document.find("\n## ", section + 1)) << kind;
  put(folder / "photo.jpg", image_io::jpeg(3));  // 24x16, as depth.npy
  const std::vector<std::string> scenes{
      "effect=puddle\nenvironment.image=photo.jpg", "effect=windshield\nscene.image=photo.jpg",
      "effect=edge_splash\nscene.source=files\nscene.image=photo.jpg\nscene.depth_image=depth.npy\nscene.depth_encoding=metres",
      "effect=screen_drops\nscene.image=photo.jpg", "effect=rainy_glass\nscene.image=photo.jpg\nscene.depth_image=depth.npy"};
  for (const std::string& scene : scenes) {
    std::vector<std::string> words{"hash", "photo.toml", "--frames", "1", "--set", "run.size=[24, 16]"};
    std::string text;
    for (const std::string& line : lines_of(scene)) {
      if (line.starts_with("effect="))
        text = head(line.substr(7));
      else
        words.insert(words.end(), {"--set", line});
    }
    put(folder / "photo.toml", text);
    const Outcome o = rainref(words);
    EXPECT_EQ(o.code, 0) << scene << ": " << o.err;
    EXPECT_THAT(o.out, HasSubstr("scene")) << scene;
  }
}

}  // namespace
}  // namespace rainref::cli
