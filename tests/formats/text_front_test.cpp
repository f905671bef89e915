// What stands before the text of a format, for all formats alike.
#include "formats/text_front.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "base/files/file.h"
#include "formats/format.h"
#include "support/paths.h"

namespace trace::text_front_test {
namespace {

using namespace std::string_view_literals;

std::string utf16(std::string_view ascii, bool big, bool marked) {
  std::string wide = !marked ? "" : big ? "\xfe\xff" : "\xff\xfe";
  for (char c : ascii) wide += big ? std::string{'\0', c} : std::string{c, '\0'};
  return wide;
}

std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string withCr(std::string text) {
  for (char& c : text)
    if (c == '\n') c = '\r';
  return text;
}

std::string frontOf(std::string_view bytes) { return std::string(TextFront("a", bytes).text()); }

TEST(TextFront, TakesAwayWhatIsNoText) {
  const std::string text = "v 0 0 0\nv 1 0 0\n";
  EXPECT_EQ(frontOf(text), text);
  EXPECT_EQ(frontOf("\xef\xbb\xbf" + text), text);
  for (const bool big : {false, true})
    for (const bool marked : {false, true}) EXPECT_EQ(frontOf(utf16(text, big, marked)), text);
  EXPECT_EQ(frontOf("\xff\xfe\x3d\xd8\x00\xde"sv), "\xf0\x9f\x98\x80") << "a pair of surrogates";
  EXPECT_EQ(frontOf("\xff\xfe\0\0v\0\0\0"sv), "v") << "UTF-32";
  EXPECT_EQ(frontOf(withCr(text)), text);
  EXPECT_EQ(frontOf("a\r\nb\r\r\nc\rd"), "a\r\nb\r\r\nc\nd");
  EXPECT_EQ(frontOf(text + "\x1a"), text);
  EXPECT_EQ(frontOf(text + "\x1a" + std::string(3, '\0')), text);
  EXPECT_EQ(frontOf(text + std::string(100, '\0')), text);
  EXPECT_EQ(frontOf(gzipped(text)), text);
  EXPECT_EQ(frontOf(gzipped(text) + gzipped("f 1 2 3\n")), text + "f 1 2 3\n") << "two members";
  EXPECT_EQ(frontOf(gzipped(utf16(text, false, true))), text);
  EXPECT_EQ(frontOf(""), "");
}

TEST(TextFront, BinaryDataPassesAsItIs) {
  for (std::string_view bytes : {"ply\r\nformat binary_little_endian 1.0\r\x1a\r"sv, "a\rb\0\0c\r\x1a"sv})
    EXPECT_EQ(frontOf(bytes), bytes);
  const std::string file = readFile(test::sourceFolder() + "/tests/corpus/gltf/tetra.glb");
  EXPECT_EQ(frontOf(file), file);
}

TEST(TextFront, SaysWhatIsCutOffAndWhatIsDamaged) {
  Messages messages;
  const TextFront front("a", "one\ntwo\x1athree", messages);
  EXPECT_EQ(front.text(), "one\ntwo");
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_EQ(messages.all()[0].place.line, 2);
  std::string packed = gzipped(std::string(1000, 'x'));
  EXPECT_THROW(TextFront("a", packed.substr(0, packed.size() - 9)), Error);
  packed[15] = static_cast<char>(packed[15] ^ 0x55);
  EXPECT_THROW(TextFront("a", packed), Error);
}

/// Every text that the corpus has, dressed up in every way, gives the same scene.
TEST(TextFront, EveryFormatIsReadThroughIt) {
  const std::string folder = test::sourceFolder() + "/tests/corpus/";
  for (const char* name :
       {"ray/plain.ray", "obj/plain.obj", "ply/text.ply", "off/cube.off", "stl/text.stl", "gltf/tetra.gltf",
        "inventor/new.wrl", "inventor/old.wrl", "ubc/plain.ray", "composer/text.out"}) {
    const std::string file = folder + name, text = readFile(file);
    const auto read = [&](const std::string& bytes) {
      Messages messages;
      Scene scene = readScene(file, bytes, messages);
      return scene.objects;
    };
    const auto expected = read(text);
    EXPECT_FALSE(expected.empty()) << name;
    const std::pair<const char*, std::string> dressed[] = {
        {"byte order mark", "\xef\xbb\xbf" + text},
        {"UTF-16 LE", utf16(text, false, true)},
        {"UTF-16 BE", utf16(text, true, true)},
        {"UTF-16 without a mark", utf16(text, false, false)},
        {"CR alone", withCr(text)},
        {"gzip", gzipped(text)},
        {"DOS end of file", text + "\n\x1a"},
        {"leading blanks", "\n  \n" + text}};
    for (const auto& [how, bytes] : dressed)
      EXPECT_NO_THROW(EXPECT_TRUE(read(bytes).size() == expected.size()) << name << " with " << how)
          << name << " with " << how;
  }
}

TEST(TextFront, PlacesAreThoseOfAnEditor) {
  const auto place = [](const std::string& bytes) {
    Messages messages;
    try {
      readScene("a.obj", bytes, messages);
    } catch (const Error& error) {
      return error.messages().front().place;
    }
    return SourcePlace{};
  };
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n";
  const SourcePlace plain = place(text);
  EXPECT_EQ(plain.line, 4);
  EXPECT_EQ(plain.column, 7);
  for (const std::string& bytes :
       {"\xef\xbb\xbf" + text, utf16(text, true, true), withCr(text), gzipped(text)}) {
    EXPECT_EQ(place(bytes).line, plain.line);
    EXPECT_EQ(place(bytes).column, plain.column);
  }
}

TEST(TextFront, TheNameIsTheSecondWitness) {
  const auto said = [](const std::string& file, const std::string& bytes) -> std::string {
    Messages messages;
    try {
      readScene(file, bytes, messages);
    } catch (const Error& error) {
      return error.messages().front().what;
    }
    return "";
  };
  EXPECT_EQ(said("a.stl", "\x89PNG\r\n"), "named .stl, but holds a PNG picture");
  EXPECT_EQ(said("a.off", "hello"), "named .off, but holds other text");
  EXPECT_EQ(said("A.OFF", "3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n"), "");
  EXPECT_EQ(said("a.txt", "3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n"), "expected a scene, found other text");
  EXPECT_TRUE(
      said("a.off", "3 1 0\n0 0 0 1 0 0 0 1 0\n").starts_with("named .off, but not valid as off: expected "));
  EXPECT_EQ(said("a.stl", ""), "named .stl, but it is an empty file");
}

}  // namespace
}  // namespace trace::text_front_test
