#include "studio/widgets/texture.h"

#include "app/view/picture_views.h"
#include "studio/widgets/gl.h"

namespace trace::studio {

Texture::~Texture() {
  if (name_) glDeleteTextures(1, &name_);
}

void Texture::set(const Bytes& bytes) {
  if (!name_) glGenTextures(1, &name_);
  width_ = bytes.width;
  height_ = bytes.height;
  ++version_;
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  const bool fits = bytes.width <= most && bytes.height <= most;
  const Bytes smaller = fits ? Bytes() : fewerPixels(bytes, most);
  const Bytes& taken = fits ? bytes : smaller;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, taken.width, taken.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
               taken.rgb.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace trace::studio
