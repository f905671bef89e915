#include <gtest/gtest.h>

#include <string>

#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile::ray_syntax_test {
namespace {

/// The tree in a notation of its own: words in quotes, entries as key=value, calls as name:body.
std::string outline(const Item& item) {
  if (item.is(Kind::number)) return std::string(item.source());
  if (item.is(Kind::word)) return "'" + std::string(item.text()) + "'";
  if (item.is(Kind::entry)) return std::string(item.key()) + "=" + outline(item.value());
  if (item.is(Kind::call)) return std::string(item.key()) + ":" + outline(item.value());
  std::string text;
  for (const Item child : item) text += (text.empty() ? "" : " ") + outline(child);
  return item.is(Kind::tuple) ? "(" + text + ")" : "{" + text + "}";
}

std::string outline(std::string_view source) { return outline(Syntax("test.ray", source).root()); }

std::string errorOf(std::string_view source) {
  try {
    Syntax("test.ray", source);
    return "";
  } catch (const Error& error) {
    const Message& m = error.messages().front();
    return std::to_string(m.place.line) + ":" + std::to_string(m.place.column) + ": " + m.what +
           (m.hint.empty() ? "" : " [" + m.hint + "]");
  }
}

TEST(RaySyntax, TakesEveryFormOfItem) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "{}"},
      {"SBT-raytracer 1.0", "{'SBT-raytracer' 1.0}"},
      {"a=1", "{a=1}"},
      {"a = (1, 2.5, -3)", "{a=(1 2.5 -3)}"},
      {"sphere { }", "{sphere:{}}"},
      {"sphere{name=foo;}", "{sphere:{name='foo'}}"},
      {"scale(2,sphere{})", "{scale:(2 sphere:{})}"},
      {"translate ( 1,2,3, { box{} ; cone {} } )", "{translate:(1 2 3 {box:{} cone:{}})}"},
      {"diffuse = map(\"a b.bmp\")", "{diffuse=map:('a b.bmp')}"},
      {"diffuse = marble { depth = 4 }", "{diffuse=marble:{depth=4}}"},
      {"material = { diffuse = (1,1,1) }", "{material={diffuse=(1 1 1)}}"},
      {"material { name = \"#1\"; }", "{material:{name='#1'}}"},
      {"gennormals;", "{'gennormals'}"},
      {"name \"foo\";", "{name='foo'}"},
      {"name foo; x = 1", "{name='foo' x=1}"},
      {"name = \"\"", "{name=''}"},
      {"\"key\" = 1", "{key=1}"},
      {"(\"a\" \"b\")", "{('a' 'b')}"},
      {"gennormals points = (1)", "{'gennormals' points=(1)}"},
  };
  for (const auto& [source, expected] : cases)
    EXPECT_EQ(outline(std::string_view(source)), expected) << source;
}

TEST(RaySyntax, IsLenientAboutSeparatorsCommentsAndLineEnds) {
  const char* expected = "{s:{a=1 b=(1 2)}}";
  for (const char* source : {"s{a=1;b=(1,2);}", "s { a = 1 b = (1 2) }", ";;s{;a=1;;b=(1,2,),;};;",
                             "s{a=1,b=(1;2)}", "s // comment }\n{ a=1 /* ( { \" */ b=(1,/**/2)}",
                             "s\r\n{\r\n a=1;\r\n b=(1,2);\r\n}\r\n", "\xef\xbb\xbfs{a=1 b=(1,2)}",
                             "s\v{\fa\t=1 b\n=\n(1,2)}//", "/* x *//* y */s{a=1 b=(1,2)}// no newline"})
    EXPECT_EQ(outline(std::string_view(source)), expected) << source;
}

TEST(RaySyntax, TakesLettersOfEveryAlphabet) {
  EXPECT_EQ(outline(std::string_view("K\u00e4se{gr\u00f6\u00dfe-2=\u043a\u0438\u0442}")),
            "{K\u00e4se:{gr\u00f6\u00dfe-2='\u043a\u0438\u0442'}}");
  EXPECT_EQ(outline(std::string_view("\u7403{\u534a\u5f84=1}")), "{\u7403:{\u534a\u5f84=1}}");
}

TEST(RaySyntax, TakesNumbersInEveryNotation) {
  for (const auto& [source, value] : {std::pair{"1", 1.0},
                                      {"-.3", -0.3},
                                      {"5.", 5.0},
                                      {"+2", 2.0},
                                      {"4.5492e-05", 4.5492e-05},
                                      {"1E3", 1000.0},
                                      {"2e+2", 200.0},
                                      {"-0", 0.0},
                                      {"0.1000000000000000055511151231257827", 0.1},
                                      {"1e-999", 0.0}}) {
    const Syntax syntax("test.ray", source);
    EXPECT_EQ((*syntax.root().begin()).number(), value) << source;
  }
}

TEST(RaySyntax, TellsWhatIsWrongAndWhere) {
  const std::pair<const char*, const char*> cases[] = {
      {"sphere {\n  a = 1;\n",
       "2:9: expected \"}\", found the end of the file [the \"{\" at line 1, column 8 is never closed]"},
      {"scale(2,\nsphere {}",
       "2:10: expected \")\", found the end of the file [the \"(\" at line 1, column 6 is never closed]"},
      {"scale(2, sphere { )",
       "1:19: expected \"}\", found \")\" [the \"{\" at line 1, column 17 is not closed yet]"},
      {"a\n( 1 }", "2:5: expected \")\", found \"}\" [the \"(\" at line 2, column 1 is not closed yet]"},
      {"sphere {} }", "1:11: found \"}\", which closes nothing"},
      {"\n )", "2:2: found \")\", which closes nothing"},
      {"a = ;", "1:5: expected a value after \"=\", found \";\""},
      {"a = }", "1:5: expected a value after \"=\", found \"}\""},
      {"a =", "1:4: expected a value after \"=\", found the end of the file"},
      {"a = = 1",
       "1:5: expected a value after \"=\", found \"=\" [== compares two values; name = value is a field]"},
      {"= 1",
       "1:1: expected an object, a field or a value, found \"=\" [== compares two values; name = value is a "
       "field]"},
      {"if (1 = 1) { }",
       "1:7: expected an object, a field or a value, found \"=\" [== compares two values; name = value is a "
       "field]"},
      {"a = \u201cb.png\u201d",
       "1:5: expected a value after \"=\", found \"\u201c\" [text stands in straight quotation marks: "
       "\"text\"]"},
      {"a =\u00a01",
       "1:4: expected a value after \"=\", found \"\u00a0\" [the blank there is a no-break space; a plain "
       "one is "
       "wanted]"},
      {"a = \u00d7", "1:5: expected a value after \"=\", found \"\u00d7\""},
      {"a = @", "1:5: expected a value after \"=\", found \"@\""},
      {"  \x80", "1:3: expected an object, a field or a value, found byte 0x80"},
      {"a = \"foo\nb", "1:5: expected a closing quote on the same line, found the end of the line"},
      {"a = \"foo", "1:5: expected a closing quote on the same line, found the end of the file"},
      {"a /* b\nc", "1:3: expected \"*/\", found the end of the file [this comment is never closed]"},
      {"/", "1:1: expected an object, a field or a value, found \"/\""},
      {"a = -", "1:5: expected a number, found \"-\""},
      {"a = 3x", "1:5: expected a number, found \"3x\""},
      {"a = 1e", "1:5: expected a number, found \"1e\""},
      {"a = 0x10", "1:5: expected a number, found \"0x10\""},
      {"a = (1,\r\n1e999)", "2:1: expected a finite number, found \"1e999\""},
      {"a = -inf", "1:5: expected a finite number, found \"-inf\""},
      {"a = -nan", "1:5: expected a finite number, found \"-nan\""},
  };
  for (const auto& [source, expected] : cases) EXPECT_EQ(errorOf(source), expected) << source;
  EXPECT_EQ(errorOf(std::string_view("a\0b", 3)),
            "1:2: expected an object, a field or a value, found byte 0x00");
}

TEST(RaySyntax, LimitsDepthAndWords) {
  EXPECT_EQ(errorOf(std::string(140, '{') + std::string(140, '}')), "");
  EXPECT_EQ(
      errorOf(std::string(141, '{')),
      "1:141: expected at most 140 levels of brackets, found more [transforms that follow one another can "
      "be one transform( )]");
  EXPECT_EQ(errorOf(std::string(4096, 'x')), "");
  EXPECT_EQ(errorOf(std::string(4097, 'x')), "1:1: expected at most 4096 characters in a word, found 4097");
}

TEST(RaySyntax, ItsTapeIsLinearInTheText) {
  std::string source = "points = (";
  for (int i = 0; i < 10000; ++i) source += "(1,2,3),";
  source += ")";
  const Syntax syntax("test.ray", source);
  EXPECT_EQ(syntax.nodes().size(), 1u + 3u + 10000u * 4u);  // the file; entry, key, list; tuples and numbers
  EXPECT_EQ((*syntax.root().begin()).value().count(), 10000u);
  EXPECT_LE(sizeof(Node), 24u);
}

TEST(RaySyntax, KnowsPlacesAndSourceText) {
  const std::string source = "a = 1;\r\n  b { c }\r\n" + std::string(300, ' ') + "d";
  const Syntax syntax("test.ray", source);
  const std::string::size_type b = source.find('b');
  EXPECT_EQ(syntax.place(b), (SourcePlace{"test.ray", 2, 3, "  b { c }"}));
  EXPECT_EQ(syntax.place(source.size()).line, 3);
  EXPECT_EQ(syntax.shortPlace(b), syntax.place(b));
  EXPECT_EQ(syntax.shortPlace(source.size() - 1), (SourcePlace{"test.ray", 3, 301, ""}));
  EXPECT_EQ(syntax.numberedPlace(b),
            (SourcePlace{"test.ray", syntax.place(b).line, syntax.place(b).column, ""}));
  auto item = syntax.root().begin();
  EXPECT_EQ((*item).source(), "a = 1");
  EXPECT_EQ((*++item).source(), "b { c }");
}

TEST(RaySyntax, DescribesWhatItFound) {
  const std::pair<std::string, const char*> cases[] = {
      {"foo", "\"foo\""},
      {"\"foo\"", "\"foo\""},
      {"12", "12"},
      {"(1, 2)", "(1, 2)"},
      {"(1111111111, 2222222222, 3333333333, 4444444444)", "a list of 4"},
      {"{ aaaaaaaaaaaaaaaaaaaaaaaaaaa = 1; bbbbbbbbbbb = 2; }", "{ ... }"},
      {"aaa { aaaaaaaaaaaaaaaaaaaaaaaaa = 1; bbbbbbbbbbb = 2; }", "aaa { ... }"},
      {"aaa ( aaaaaaaaaaaaaaaaaaaaaaaaa = 1; bbbbbbbbbbb = 2; )", "aaa( ... )"},
      {"aaa = ( bbbbbbbbbbbbbbbbbbbbbbb, cccccccccccccccccccccc )", "aaa = ..."},
      {"0." + std::string(50, '0'), "a number of 52 characters"},
      {std::string(50, 'a'), "\"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\"..."},
  };
  for (const auto& [source, expected] : cases)
    EXPECT_EQ(describe(*Syntax("test.ray", source).root().begin()), expected) << source;
}

}  // namespace
}  // namespace trace::rayfile::ray_syntax_test
