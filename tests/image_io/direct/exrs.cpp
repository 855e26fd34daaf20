#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <cstring>
#include <functional>

#include <fmt/format.h>

#include "image_io/direct/module.h"

namespace rainref::image_io {
namespace {

class Text : public Imf::OStream {
 public:
  Text() : OStream("made") {}
  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (text.size() < at_ + size) text.resize(at_ + size);
    std::memcpy(text.data() + at_, from, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }
  std::string text;

 private:
  std::size_t at_ = 0;
};

using Channels = std::vector<std::pair<std::string, Imf::PixelType>>;
const Channels halves{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"A", Imf::HALF}};
const Channels floats{{"R", Imf::FLOAT}, {"G", Imf::FLOAT}, {"B", Imf::FLOAT}};
const Channels mixed{{"A", Imf::HALF}, {"Z", Imf::FLOAT}, {"id", Imf::UINT}, {"left.G", Imf::HALF}, {"left.depth.Z", Imf::FLOAT}};

Imf::Header header(int width, int height, const Channels& channels, Imf::Compression compression) {
  Imf::Header out(width, height);
  out.compression() = compression;
  for (const auto& [name, type] : channels) out.channels().insert(name, Imf::Channel(type));
  return out;
}
void tile(Imf::Header& out, Imf::LevelMode mode, Imf::LevelRoundingMode rounding = Imf::ROUND_DOWN) {
  out.setTileDescription(Imf::TileDescription(16, 8, mode, rounding));
}

/// Smooth finite values of every channel, and where they lie. Tiles may be larger than the picture.
class Texels {
 public:
  explicit Texels(const Imf::Header& header) {
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 17, height = window.max.y - window.min.y + 9;
    Noise noise(3);
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      const Imf::PixelType type = c.channel().type;
      std::vector<float> values;
      std::string& bytes = bytes_.emplace_back();
      for (int i = 0; i < width * height; ++i) {
        const float value = static_cast<float>(i % width) / 7 + static_cast<float>(noise.byte()) / 512;
        const Imath::half half(value);
        const auto count = static_cast<unsigned>(noise.next());
        if (type == Imf::HALF) bytes.append(reinterpret_cast<const char*>(&half), sizeof half);
        if (type == Imf::FLOAT) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        if (type == Imf::UINT) bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
      }
      const std::size_t step = type == Imf::HALF ? 2 : 4;
      slices_.emplace_back(c.name(), type, step, step * static_cast<std::size_t>(width));
    }
    for (std::size_t i = 0; i < slices_.size(); ++i) {
      const auto& [name, type, step, row] = slices_[i];
      target.insert(name, Imf::Slice(type,
                                     bytes_[i].data() - window.min.x * static_cast<std::ptrdiff_t>(step) -
                                         window.min.y * static_cast<std::ptrdiff_t>(row),
                                     step, row));
    }
  }
  Imf::FrameBuffer target;

 private:
  std::vector<std::string> bytes_;
  std::vector<std::tuple<std::string, Imf::PixelType, std::size_t, std::size_t>> slices_;
};

template <class File>
void put_levels(File& file) {
  for (int y = 0; y < file.numYLevels(); ++y)
    for (int x = 0; x < file.numXLevels(); ++x)
      if (file.isValidLevel(x, y)) file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
}

std::string written(const Imf::Header& header, int rows = 0) {
  Text out;
  Texels texels(header);
  if (header.hasTileDescription()) {
    Imf::TiledOutputFile file(out, header, 0);
    file.setFrameBuffer(texels.target);
    put_levels(file);
  } else {
    Imf::OutputFile file(out, header, 0);
    file.setFrameBuffer(texels.target);
    file.writePixels(rows > 0 ? rows : header.dataWindow().max.y - header.dataWindow().min.y + 1);
  }
  return out.text;
}

std::string in_parts(std::vector<Imf::Header> headers) {
  Text out;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    headers[i].displayWindow() = headers[0].displayWindow();  // one for all parts
    headers[i].setName(fmt::format("part {}", i));
    headers[i].setType(headers[i].hasTileDescription() ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  }
  {
    Imf::MultiPartOutputFile file(out, headers.data(), static_cast<int>(headers.size()), false, 0);
    for (std::size_t i = 0; i < headers.size(); ++i) {
      Texels texels(headers[i]);
      if (headers[i].hasTileDescription()) {
        Imf::TiledOutputPart part(file, static_cast<int>(i));
        part.setFrameBuffer(texels.target);
        put_levels(part);
      } else {
        Imf::OutputPart part(file, static_cast<int>(i));
        part.setFrameBuffer(texels.target);
        part.writePixels(headers[i].dataWindow().max.y - headers[i].dataWindow().min.y + 1);
      }
    }
  }
  return out.text;
}

std::string deep() {
  Text out;
  Imf::Header head = header(3, 2, {{"Z", Imf::FLOAT}}, Imf::ZIPS_COMPRESSION);
  head.setType(Imf::DEEPSCANLINE);
  {
    Imf::DeepScanLineOutputFile file(out, head, 0);
    unsigned counts[6] = {1, 1, 1, 1, 1, 1};
    float values[6] = {1, 2, 3, 4, 5, 6};
    float* pointers[6];
    for (int i = 0; i < 6; ++i) pointers[i] = &values[i];
    Imf::DeepFrameBuffer target;
    target.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts), sizeof(unsigned), 3 * sizeof(unsigned)));
    target.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers), sizeof(float*), 3 * sizeof(float*), sizeof(float)));
    file.setFrameBuffer(target);
    file.writePixels(2);
  }
  return out.text;
}

std::string luminance_and_chroma() {
  Text out;
  {
    Imf::RgbaOutputFile file(out, Imf::Header(8, 6), Imf::WRITE_YC, 0);
    const std::vector<Imf::Rgba> texels(48, Imf::Rgba(.25f, .5f, .75f));
    file.setFrameBuffer(texels.data(), 1, 8);
    file.writePixels(6);
  }
  return out.text;
}

void add_kinds(MadePictures& out) {
  const char* const names[] = {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
    for (const auto& [kind, channels] :
         {std::pair("half", halves), {"float", floats}, {"mixed", mixed}, {"grey", Channels{{"Y", Imf::HALF}}}}) {
      const Imf::Header rows = header(37, 35, channels, static_cast<Imf::Compression>(c));
      out.push_back({fmt::format("EXR {} {}", names[c], kind), "openexr", written(rows)});
      for (const auto& [mode, levels] : {std::pair(Imf::ONE_LEVEL, "tiles"), {Imf::MIPMAP_LEVELS, "mips"}, {Imf::RIPMAP_LEVELS, "rips"}}) {
        Imf::Header tiles = rows;
        tile(tiles, mode);
        out.push_back({fmt::format("EXR {} {} {}", names[c], kind, levels), "openexr", written(tiles)});
      }
    }
  }
}

void add_orders(MadePictures& out) {
  for (const auto& [order, name] : {std::pair(Imf::DECREASING_Y, "decreasing"), {Imf::RANDOM_Y, "random"}}) {
    Imf::Header rows = header(21, 33, halves, Imf::ZIP_COMPRESSION), tiles = rows;
    tile(tiles, Imf::MIPMAP_LEVELS, Imf::ROUND_UP);
    rows.lineOrder() = order == Imf::RANDOM_Y ? Imf::INCREASING_Y : order;
    tiles.lineOrder() = order;
    out.push_back({fmt::format("EXR rows {}", name), "openexr", written(rows)});
    out.push_back({fmt::format("EXR tiles {}", name), "openexr", written(tiles)});
  }
  for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{{"X", "Y", "Z"},
                                                                                     {"x", "y"},
                                                                                     {"U", "V"},
                                                                                     {"Y", "A"},
                                                                                     {"red", "Green", "BLUE", "Alpha"},
                                                                                     {"B", "AR", "RA", "G", "AG", "R", "A"},
                                                                                     {"N.X", "N.Y", "N.Z", "R", "G", "B"},
                                                                                     {"b.Z", "a.R", "a.b.G", "a.B", "z"},
                                                                                     {"Z", "ZBack", "Depth"},
                                                                                     {"real", "imag"},
                                                                                     {".R", "R.", "a..R"},
                                                                                     {"r", "R", "g"}}) {
    Channels channels;
    for (const std::string& name : names) channels.emplace_back(name, Imf::HALF);
    out.push_back(
        {fmt::format("EXR channels {}", fmt::join(names, " ")), "openexr", written(header(4, 3, channels, Imf::ZIP_COMPRESSION))});
  }
}

void add_windows(MadePictures& out) {
  const auto windows = [](Imath::Box2i display, Imath::Box2i data) {
    Imf::Header head(display, data);
    for (const auto& [name, type] : halves) head.channels().insert(name, Imf::Channel(type));
    return head;
  };
  const Imath::Box2i moved({-5, 7}, {14, 20}), inner({0, 9}, {10, 12});
  for (const auto& [name, head] :
       {std::pair("moved", windows(moved, moved)), {"cropped", windows(moved, inner)}, {"overscan", windows(inner, moved)}}) {
    Imf::Header tiles = head;
    tile(tiles, Imf::ONE_LEVEL);
    out.push_back({fmt::format("EXR {}", name), "openexr", written(head)});
    out.push_back({fmt::format("EXR tiles {}", name), "openexr", written(tiles)});
  }
}

void add_headers(MadePictures& out) {
  const Imf::Header plain = header(6, 36, halves, Imf::ZIP_COMPRESSION);
  const auto changed = [&](const std::string& name, const std::function<void(Imf::Header&)>& change) {
    Imf::Header rows = plain, tiles = header(6, 6, halves, Imf::ZIP_COMPRESSION);
    tile(tiles, Imf::MIPMAP_LEVELS);
    change(rows);
    change(tiles);
    out.push_back({"EXR " + name, "openexr", written(rows)});
    out.push_back({"EXR tiles " + name, "openexr", written(tiles)});
  };
  changed("turned", [](Imf::Header& h) { h.insert("Orientation", Imf::IntAttribute(6)); });
  changed("upright", [](Imf::Header& h) { h.insert("Orientation", Imf::IntAttribute(1)); });
  changed("cube", [](Imf::Header& h) { Imf::addEnvmap(h, Imf::ENVMAP_CUBE); });
  changed("sky", [](Imf::Header& h) { Imf::addEnvmap(h, Imf::ENVMAP_LATLONG); });
  changed("notes", [](Imf::Header& h) {
    h.insert("rainref", Imf::StringAttribute("a note"));
    Imf::addOwner(h, "somebody");
    Imf::addXDensity(h, 72);
    h.pixelAspectRatio() = 2;
    h.setName("a name");
  });
  out.push_back({"EXR without its last rows", "openexr", written(plain, 20)});
  Imf::Header tiles = header(40, 21, floats, Imf::PIZ_COMPRESSION);
  tile(tiles, Imf::MIPMAP_LEVELS);
  out.push_back({"EXR parts, rows first", "openexr", in_parts({plain, tiles})});
  out.push_back({"EXR parts, tiles first", "openexr", in_parts({tiles, plain})});
  out.push_back({"EXR of one part", "openexr", in_parts({plain})});
  out.push_back({"EXR deep", "openexr", deep()});
  out.push_back({"EXR luminance and chroma", "openexr", luminance_and_chroma()});
}

}  // namespace

MadePictures made_exrs() {
  MadePictures out;
  add_kinds(out);
  add_orders(out);
  add_windows(out);
  add_headers(out);
  return out;
}

}  // namespace rainref::image_io
