// Small scenes as text, for the tests of the .ray reader.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "formats/format.h"

namespace trace {

/// A scene and the warnings of reading it.
struct Loaded {
  Scene scene;
  std::vector<Message> warnings;
};

/// Reads `text` after a first line with the header, so that the text starts at line 2.
inline Loaded load(std::string_view text) {
  Messages messages;
  Loaded loaded{readScene("test.ray", "SBT-raytracer 1.0\n" + std::string(text), messages), {}};
  loaded.warnings = messages.all();
  return loaded;
}

/// The messages of the Error that reading `text` throws, `line:column: what [hint]`, one per line; "" if it
/// throws none.
inline std::string errorsOfFile(std::string_view bytes) {
  try {
    Messages messages;
    readScene("test.ray", bytes, messages);
    return "";
  } catch (const Error& error) {
    std::string text;
    for (const Message& m : error.messages()) {
      EXPECT_EQ(m.severity, Message::Severity::error);
      EXPECT_EQ(m.place.file, "test.ray");
      text += (text.empty() ? "" : "\n") + std::to_string(m.place.line) + ":" +
              std::to_string(m.place.column) + ": " + m.what + (m.hint.empty() ? "" : " [" + m.hint + "]");
    }
    return text;
  }
}
inline std::string errorsOf(std::string_view text) {
  return errorsOfFile("SBT-raytracer 1.0\n" + std::string(text));
}

inline std::string toLine(const Message& m) {
  return std::to_string(m.place.line) + ":" + std::to_string(m.place.column) + ": " + m.what +
         (m.hint.empty() ? "" : " [" + m.hint + "]");
}

/// The warnings of reading `text`, without those that scenes of a test have for want of lights or objects.
inline std::string warningsOf(std::string_view text) {
  std::string lines;
  for (const Message& m : load(text).warnings)
    if (m.place.line > 0) lines += (lines.empty() ? "" : "\n") + toLine(m);
  return lines;
}

/// The only object of `text`, as a shape of type S.
template <class S>
S onlyShape(std::string_view text) {
  const Loaded loaded = load(text);
  EXPECT_EQ(loaded.scene.objects.size(), 1u) << text;
  if (loaded.scene.objects.size() != 1) return {};
  const S* shape = loaded.scene.objects[0].shape.as<S>();
  EXPECT_NE(shape, nullptr) << text;
  return shape ? *shape : S{};
}

inline const Phong& phongOf(const Scene& scene, size_t object) {
  return *scene.materials.at(scene.objects.at(object).material).model.as<Phong>();
}

}  // namespace trace
