// A picture on the graphics card.
#pragma once

#include <imgui.h>

#include <cstdint>

#include "image/development/tone.h"

namespace trace::studio {

class Texture {
 public:
  Texture() = default;
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  void set(const Bytes& bytes);
  bool empty() const { return name_ == 0; }
  int width() const { return width_; }
  int height() const { return height_; }
  ImTextureID id() const { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name_)); }
  unsigned name() const { return name_; }
  /// Changes with what it shows.
  std::uint64_t version() const { return version_; }

 private:
  unsigned name_ = 0;
  int width_ = 0, height_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace trace::studio
