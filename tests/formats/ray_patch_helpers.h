// What the tests of ray_patch.h share: a text that was read, edited and saved again.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "base/sanitized.h"
#include "formats/ray/file/format.h"
#include "formats/ray/write/patch.h"
#include "formats/ray/write/same.h"
#include "support/paths.h"
#include "support/shared.h"

namespace trace {

inline SceneText reading(const std::string& file, const std::string& bytes, Real time = 0) {
  Messages messages;
  SceneText text{file, std::make_shared<const std::string>(bytes), time, {}};
  text.scene = std::make_shared<const Scene>(readRay(file, bytes, messages, time));
  return text;
}

struct Saved {
  std::string text;
  std::vector<Message> messages;
};

inline Saved saved(const SceneText& read, Scene edited) {
  Messages messages;
  const auto files = rewriteRay(read, edited, read.file, messages).files;
  return {files.at(0).bytes, messages.all()};
}

using Edit = std::function<void(Scene&)>;

inline Saved edited(const SceneText& read, const Edit& edit) {
  Scene scene = *read.scene;
  edit(scene);
  return saved(read, scene);
}

/// The text after the edit, of a scene that is given without its first line.
inline std::string after(const std::string& text, const Edit& edit) {
  const std::string header = "SBT-raytracer 1.0\n";
  const SceneText read = reading("test.ray", header + text);
  const Saved result = edited(read, edit);
  for (const Message& message : result.messages) ADD_FAILURE() << message.what;
  EXPECT_TRUE(result.text.starts_with(header)) << result.text;
  return result.text.starts_with(header) ? result.text.substr(header.size()) : result.text;
}

/// Every one but those of the tutorial, which leave camera and light to Trace: an edit writes these down. For
/// the sanitizers every third.
inline std::vector<std::string> examples() {
  auto files = test::filesUnder(test::sourceFolder() + "/scenes", ".ray");
  std::size_t at = 0;
  std::erase_if(files, [&](const std::string& file) {
    return file.find("/tutorial/") != file.npos || !recognisesRay(readFile(file)) ||
           (kSanitized && at++ % 3 != 0);
  });
  return files;
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines(1);
  for (char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  }
  return lines;
}

/// How many lines of the first are not in the second, and the other way round: those that differ if there are
/// as many of both, else all around one place.
inline std::pair<std::size_t, std::size_t> changedLines(const std::string& before, const std::string& after) {
  const std::vector<std::string> a = linesOf(before), b = linesOf(after);
  if (a.size() == b.size()) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differ += a[i] != b[i];
    return {differ, differ};
  }
  std::size_t start = 0, end = 0;
  while (start < std::min(a.size(), b.size()) && a[start] == b[start]) ++start;
  while (start + end < std::min(a.size(), b.size()) && a[a.size() - 1 - end] == b[b.size() - 1 - end]) ++end;
  return {a.size() - start - end, b.size() - start - end};
}

inline std::size_t commentsIn(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find("//"); at != text.npos; at = text.find("//", at + 2)) ++count;
  return count;
}

/// Objects or lights of one node of the text, as of particles or rows, cannot be changed there one by one.
template <class Thing>
bool standsAlone(const std::vector<Thing>& things, std::size_t i) {
  for (const char* node : {"particles", "rows"})
    if (things[i].place.text.find(node) != std::string::npos) return false;
  const auto alike = [&](std::size_t j) { return j < things.size() && things[j].place == things[i].place; };
  return !alike(i + 1) && (i == 0 || !alike(i - 1));
}

inline void expectSays(const SceneText& read, const std::string& text, const Scene& wanted,
                       const std::string& what) {
  const SceneText again = reading(read.file, text, read.time);
  const Scene& is = *again.scene;
  EXPECT_EQ(is.camera, wanted.camera) << what;
  EXPECT_EQ(is.background, wanted.background) << what;
  EXPECT_TRUE(rayfile::sameSettings(is, wanted)) << what;
  ASSERT_EQ(is.lights.size(), wanted.lights.size()) << what;
  for (std::size_t i = 0; i < is.lights.size(); ++i)
    EXPECT_EQ(is.lights[i].light, wanted.lights[i].light) << what;
  ASSERT_EQ(is.objects.size(), wanted.objects.size()) << what;
  for (std::size_t i = 0; i < is.objects.size(); ++i)
    EXPECT_TRUE(rayfile::sameObject(is, is.objects[i], wanted, wanted.objects[i]))
        << what << ", object " << i;
}

/// One edit of an example: says what was wanted, on at most that many lines, with all comments.
inline void expectSmall(const SceneText& read, const std::string& what, const Edit& edit, std::size_t lines) {
  Scene scene = *read.scene;
  edit(scene);
  const std::string where = read.file + ": " + what;
  const Saved result = saved(read, scene);
  for (const Message& message : result.messages) ADD_FAILURE() << where << ": " << message.what;
  expectSays(read, result.text, scene, where);
  const auto [gone, come] = changedLines(*read.bytes, result.text);
  EXPECT_LE(std::max(gone, come), lines) << where;
  EXPECT_TRUE(result.text != *read.bytes) << where;
  EXPECT_EQ(commentsIn(result.text), commentsIn(*read.bytes)) << where;
}

}  // namespace trace
