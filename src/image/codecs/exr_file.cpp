// Writing EXR through OpenEXR; in memory, so that all writing goes through base/files/file.h. 32-bit floats,
// zip-compressed. Source: "OpenEXR File Layout", "Reading and Writing OpenEXR Image Files" and "Technical
// Introduction to OpenEXR" (openexr.com). No threads are started.
#include "image/codecs/exr_file.h"

#include <algorithm>
#include <cstring>

#include "base/budget.h"
#include "image/codecs/codec_parts.h"
#include "image/codecs/openexr.h"

namespace trace {
namespace {

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(std::string& file) : Imf::OStream("memory"), file_(file) {}
  void write(const char bytes[], int count) override {
    const size_t n = static_cast<size_t>(count);
    if (file_.size() < place_ + n) file_.resize(place_ + n);
    std::memcpy(file_.data() + place_, bytes, n);
    place_ += n;
  }
  uint64_t tellp() override { return place_; }
  void seekp(uint64_t place) override { place_ = static_cast<size_t>(place); }

 private:
  std::string& file_;
  size_t place_ = 0;
};

}  // namespace

std::string encodeExr(const ExrFile& picture) {
  const Tile& window = picture.window;
  const Imath::Box2i display({0, 0}, {picture.width - 1, picture.height - 1});
  const Imath::Box2i data({window.x0, window.y0}, {window.x1 - 1, window.y1 - 1});
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : picture.words)
    header.insert(std::string(kExrWordPrefix) + cleanKey(key), Imf::StringAttribute(text));
  for (const auto& [key, text] : picture.attributes) header.insert(key, Imf::StringAttribute(text));
  Imf::FrameBuffer target;
  const int width = window.x1 - window.x0;
  for (const ExrChannel& channel : picture.channels) {
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    // OpenEXR takes what it writes as if it could change it.
    auto* values = reinterpret_cast<char*>(const_cast<float*>(channel.values.data()));
    target.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, values, data, sizeof(float),
                                                 sizeof(float) * static_cast<size_t>(width)));
  }
  std::string file;
  {
    MemoryOutput stream(file);
    Imf::OutputFile output(stream, header, kNoThreads);
    output.setFrameBuffer(target);
    constexpr int kRows = 16;  // that ZIP packs together
    for (int y = window.y0; y < window.y1; y += kRows) {
      lookAtBudget();
      output.writePixels(std::min(kRows, window.y1 - y));
    }
  }  // the end of `output` completes the file
  return file;
}

void addChannels(ExrFile& file, const Picture& picture, std::span<const std::string> names) {
  const Tile& window = file.window;
  for (size_t i = 0; i < names.size(); ++i) {
    std::vector<float> values;
    values.reserve(static_cast<size_t>(window.x1 - window.x0) * static_cast<size_t>(window.y1 - window.y0));
    for (int y = window.y0; y < window.y1; ++y) {
      checkBudget();
      for (int x = window.x0; x < window.x1; ++x) {
        const Color& c = picture.at(x, y);
        values.push_back(static_cast<float>(i == 0 ? c.r : i == 1 ? c.g : c.b));
      }
    }
    file.channels.push_back({names[i], std::move(values)});
  }
}

std::string encodeExr(const Picture& picture, const Encoding&, const Metadata& metadata) {
  ExrFile file{picture.width, picture.height, {0, 0, picture.width, picture.height}, {}, metadata, {}};
  const std::string names[] = {"R", "G", "B"};
  addChannels(file, picture, names);
  return encodeExr(file);
}

}  // namespace trace
