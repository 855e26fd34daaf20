// A running effect of any kind.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "effect/drops_layer.h"
#include "image_io/write.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "state/items.h"

namespace rainref::effect {

/// The input and settings of the effect's pass display, to develop a picture in another way.
struct Display {
  enum class Code : std::uint8_t { srgb, power };  ///< IEC 61966-2-1, or the published power 0.4545

  const Image* radiance = nullptr;  ///< linear, four channels of 16 or 32 bits, row 0 = bottom: the input of display
  double exposure = 0;              ///< EV
  double vignette = 0;              ///< loss of light at a distance of one picture width, or height, from the centre
  Code code = Code::srgb;
};

/// A picture that is no frame, such as a map that the effect baked.
struct Map {
  const char* name;
  const Image* image;  ///< row 0 = bottom
};

class Instance {
 public:
  virtual ~Instance() = default;
  /// Simulates the next frame: 0, 1, 2 ...
  virtual void simulate(Recorder* recorder) = 0;
  /// Renders the last simulated frame.
  virtual void render(Recorder* recorder) = 0;
  /// Replaces render if the picture is not wanted: updates only what later frames need, so their pictures are the same.
  virtual void skip(Recorder* /*recorder*/) {}
  /// Lists the state kept between frames. A simulation that loads it continues with the same bits; pictures come with the next render.
  virtual void list_state(state::Items& items) = 0;
  /// Frames simulated so far.
  virtual int frame() const = 0;
  /// The picture as display code, row 0 = bottom.
  virtual const Image& picture() const = 0;
  /// How display made the picture; none if the picture does not come from a linear one.
  virtual std::optional<Display> display() const { return std::nullopt; }
  /// The buffers that the effect keeps between frames, named as in its EffectInfo: images with row 0 = bottom, and records. Valid until the
  /// next call of a non-const member.
  virtual std::vector<PassOutput> buffers() = 0;
  /// The layers of the frame's EXR file, row 0 = bottom.
  virtual std::vector<image_io::Layer> layers() const = 0;
  /// True if drops_layer() is available for this effect in this variant.
  virtual bool has_drops_layer() const { return false; }
  /// The drops of the last rendered frame as a layer.
  virtual DropsLayer drops_layer(const parallel::Executor& /*executor*/) const { return {}; }
  /// The round drops of the last rendered frame that others do not hide; none if the effect has no list of them.
  virtual std::optional<std::vector<DropDisc>> drop_discs() const { return std::nullopt; }
  /// Maps written to separate files beside the first EXR.
  virtual std::vector<Map> maps() const { return {}; }
};

/// T: an effect class of include/rainref; all have the same interface.
template <class T>
class InstanceOf : public Instance {
 public:
  void simulate(Recorder* recorder) final { effect_.simulate(recorder); }
  void render(Recorder* recorder) final {
    show_pictures_of(std::max(0, effect_.frame() - 1));
    effect_.render(recorder);
  }
  void list_state(state::Items& items) override { effect_.list_state(items); }
  int frame() const final { return effect_.frame(); }
  const Image& picture() const final { return effect_.picture(); }
  const T& running() const { return effect_; }

 protected:
  template <class... Arguments>
  explicit InstanceOf(Arguments&&... arguments) : effect_(std::forward<Arguments>(arguments)...) {}
  /// Gives the effect the pictures of the frame to be rendered next, if they differ from the current ones.
  virtual void show_pictures_of(int /*frame*/) {}
  T& changed() { return effect_; }

 private:
  T effect_;
};

}  // namespace rainref::effect
