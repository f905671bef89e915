#include "image/letters.h"

#include <algorithm>
#include <array>

namespace trace {
namespace {

constexpr double kLine = 16;    // units of a line's height
constexpr double kAbove = 2.5;  // units above a capital letter
constexpr double kGap = 2.2;    // units between letters
constexpr double kSpace = 4;    // width of a space

/// From '!' on, in the order of ASCII: corners of strokes as pairs of hexadecimal digits x, y, and a space
/// between strokes. Capital letters reach from y = 0 to 9, small ones from 3; c is the lowest.
constexpr std::array<std::string_view, 94> kLetters{
    "0006 0809",                                   // !
    "0003 2023",                                   // "
    "2019 5049 0363 0666",                         // #
    "615010010314546568591908 303a",               // $
    "102031332414030110 7019 657586887969585665",  // %
    "691311203041420608193966",                    // &
    "0003",                                        // '
    "2003082b",                                    // (
    "0023280b",                                    // )
    "2026 0145 4105",                              // *
    "0666 3339",                                   // +
    "18190b",                                      // ,
    "0636",                                        // -
    "0809",                                        // .
    "400a",                                        // /
    "203052573929070220",                          // 0
    "022029",                                      // 1
    "02104052530959",                              // 2
    "01104051534424 445558491908",                 // 3
    "49400666",                                    // 4
    "501004335557391908",                          // 5
    "514020030729395756342406",                    // 6
    "005029",                                      // 7
    "203041433424130120 2406072939575634",         // 8
    "081939565230200203253553",                    // 9
    "0304 0809",                                   // :
    "1314 18190b",                                 // ;
    "530659",                                      // <
    "0555 0858",                                   // =
    "035609",                                      // >
    "02104052533536 3839",                         // ?
    "5534242656667562402002072969",                // @
    "093069 1656",                                 // A
    "09004051534404 4455584909",                   // B
    "6150200207295968",                            // C
    "09003052573909",                              // D
    "50000959 0444",                               // E
    "500009 0444",                                 // F
    "61502002072959676535",                        // G
    "0009 6069 0464",                              // H
    "0009",                                        // I
    "4047291907",                                  // J
    "0009 5005 2359",                              // K
    "000959",                                      // L
    "0900366069",                                  // M
    "09006960",                                    // N
    "204062674929070220",                          // O
    "09004051544505",                              // P
    "204062674929070220 4669",                     // Q
    "09004051544505 3559",                         // R
    "615010010314546568591908",                    // S
    "0060 3039",                                   // T
    "000729496760",                                // U
    "003960",                                      // V
    "0029426980",                                  // W
    "0069 6009",                                   // X
    "003560 3539",                                 // Y
    "00600969",                                    // Z
    "20000b2b",                                    // [
    "004a",                                        // backslash
    "00202b0b",                                    // ]
    "033063",                                      // ^
    "0a6a",                                        // _
    "0022",                                        // `
    "13435459 56160708194958",                     // a
    "0009 0523435557492907",                       // b
    "5443230507294958",                            // c
    "5059 5533130507193957",                       // d
    "06565543230507294958",                        // e
    "40302129 0343",                               // f
    "535b4c1c0b 5533130507193957",                 // g
    "0009 0523435459",                             // h
    "0309 0001",                                   // i
    "131b0c 1011",                                 // j
    "0009 4307 2559",                              // k
    "0009",                                        // l
    "0309 0513334549 4553738589",                  // m
    "0309 0523435459",                             // n
    "233355573929070523",                          // o
    "030c 0523435557492907",                       // p
    "535c 5533130507193957",                       // q
    "0309 052333",                                 // r
    "544313040516465758491908",                    // s
    "20283949 0343",                               // t
    "0308193957 5359",                             // u
    "032943",                                      // v
    "0329446983",                                  // w
    "0349 4309",                                   // x
    "0329 43291c0c",                               // y
    "03430949",                                    // z
    "2011140516192a",                              // {
    "000b",                                        // |
    "0011142516190a",                              // }
    "061525475766",                                // ~
};
constexpr std::string_view kBox = "0050590900";

int digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

/// Later bytes of a character of UTF-8 have no letter of their own.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

std::string_view letterOf(char c) {
  const int index = static_cast<unsigned char>(c) - '!';
  return index >= 0 && index < static_cast<int>(kLetters.size()) ? kLetters[static_cast<std::size_t>(index)]
                                                                 : kBox;
}

double widthOf(std::string_view letter) {
  int most = 0;
  for (std::size_t i = 0; i < letter.size(); i += 2) {
    if (letter[i] == ' ') ++i;
    most = std::max(most, digit(letter[i]));
  }
  return most;
}

/// The units to the next letter.
double advance(char c) { return c == ' ' ? kSpace : widthOf(letterOf(c)) + kGap; }

}  // namespace

std::vector<LetterStroke> letterStrokes(std::string_view words, double height) {
  std::vector<LetterStroke> strokes;
  const double unit = height / kLine;
  double left = 1;
  for (const char c : words) {
    if (continues(c)) continue;
    const std::string_view letter = c == ' ' ? std::string_view() : letterOf(c);
    const auto corner = [&](std::size_t i) {
      return Vec2{(left + digit(letter[i])) * unit, (kAbove + digit(letter[i + 1])) * unit};
    };
    for (std::size_t i = 0; i + 3 < letter.size(); i += 2) {
      if (letter[i] == ' ') ++i;
      if (i + 3 < letter.size() && letter[i + 2] != ' ') strokes.push_back({corner(i), corner(i + 2)});
    }
    left += advance(c);
  }
  return strokes;
}

double lettersWidth(std::string_view words, double height) {
  double units = 1;
  for (const char c : words)
    if (!continues(c)) units += advance(c);
  return units * height / kLine;
}

}  // namespace trace
