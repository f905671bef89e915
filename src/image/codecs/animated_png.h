// A short film in one file: an animated PNG, which browsers play and other programs show as its first
// picture.
//
// Source: PNG, third edition (W3C 2025), sections 4.9 and 11.3.6: acTL, fcTL and fdAT.
#pragma once

#include <cstdint>
#include <string>

#include "image/development/tone.h"

namespace trace {

class AnimatedPng {
 public:
  /// A picture that is shown for so long. All have the size of the first.
  void add(const Bytes& picture, double seconds);
  /// The bytes of the file, which plays again and again. Precondition: there is a picture.
  std::string finish() const;

 private:
  Bytes last_;  // a picture is stored as the rectangle in which it differs from this
  std::uint32_t pictures_ = 0, chunks_ = 0;  // chunks that have a sequence number
  std::string header_, body_;
};

}  // namespace trace
