#include "formats/ies.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/text.h"
#include "formats/text_front.h"
#include "formats/words.h"

namespace trace {
namespace {

constexpr std::string_view kTilt = "TILT=";

/// Where the line begins that says TILT=, which ends the lines of words.
std::size_t tiltIn(const std::string& file, std::string_view bytes) {
  for (std::size_t at = bytes.find(kTilt); at != bytes.npos; at = bytes.find(kTilt, at + 1)) {
    const std::size_t line = at == 0 ? 0 : bytes.find_last_of("\r\n", at - 1) + 1;
    if (bytes.substr(line, at - line).find_first_not_of(" \t") == bytes.npos) return at;
  }
  throw Error(Fault::scene, placeAt(file, bytes, 0),
              "expected a line that begins with TILT=, as photometric files (IES LM-63) have it");
}

/// The numbers may be parted by commas, too.
std::string withoutCommas(std::string_view bytes, std::size_t from) {
  std::string text(bytes);
  std::replace(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(), ',', ' ');
  return text;
}

class IesReader {
 public:
  IesReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file),
        tilt_(tiltIn(file, bytes)),
        text_(withoutCommas(bytes, tilt_)),
        words_(file_, text_, '\0'),
        messages_(messages) {}

  Photometry read() {
    words_.skipTo(tilt_);
    tilt();
    const Real lamps = words_.number("the number of lamps");
    words_.number("the lumens of a lamp");
    const Real multiplier = number("the multiplier of candelas", 0);
    const std::size_t rows = count("the number of vertical angles"),
                      columns = count("the number of horizontal angles");
    const auto type =
        static_cast<Photometry::Type>(whole("the photometric type: 1 (C), 2 (B) or 3 (A)", 1, 3));
    whole("the unit of length: 1 for feet, 2 for metres", 1, 2);
    for (const char* what : {"the width of the opening", "its length", "its height"}) words_.number(what);
    const Real ballast = number("the ballast factor", 0), photometric = number("the ballast-lamp factor", 0);
    words_.number("the watts");
    if (!(lamps > 0)) warn("a file of " + toText(lamps) + " lamps: read as of one");
    if (multiplier * ballast * photometric == 0)
      warn("the photometric file has no light: its multiplier or one of its ballast factors is 0");

    if (columns > words_.left() / rows)
      words_.fail("expected " + std::to_string(rows) + " x " + std::to_string(columns) +
                  " candelas, which is more than the file can hold");

    std::vector<Real> vertical = angles("a vertical angle", rows, type == Photometry::Type::c ? 0 : -90,
                                        type == Photometry::Type::c ? 180 : 90),
                      horizontal =
                          angles("a horizontal angle", columns, type == Photometry::Type::c ? 0 : -90,
                                 type == Photometry::Type::c ? 360 : 90);
    if (type == Photometry::Type::c) checkCoverage(vertical, horizontal);
    std::vector<Real> candelas;
    candelas.reserve(rows * columns);
    for (std::size_t i = 0; i < rows * columns; ++i) {
      checkBudget();
      candelas.push_back(number("candelas", 0) * (multiplier * ballast * photometric));
    }
    const bool dark = std::all_of(candelas.begin(), candelas.end(), [](Real c) { return c == 0; });
    if (dark && multiplier * ballast * photometric > 0)
      warn("the photometric file has no light: all candelas are 0");
    if (!words_.atEnd()) {
      words_.next();
      warn("what follows the last candelas is ignored");
    }
    closeRound(type, horizontal, candelas, rows);
    return {type, std::move(vertical), std::move(horizontal), std::move(candelas)};
  }

 private:
  void tilt() {
    std::string_view word = words_.next();
    word.remove_prefix(kTilt.size());
    if (word == "NONE") return;
    if (word == "INCLUDE") {
      words_.number("how the lamp sits in the luminaire");
      const std::size_t pairs = count("the number of pairs of angles and factors");
      for (std::size_t i = 0; i < 2 * pairs; ++i) words_.number("an angle or a factor of the tilt");
    }
    warn("TILT: the loss of a tilted lamp is not applied: it shines as if it hung straight");
  }

  /// At the word read last.
  void warn(std::string what) { messages_.warn(words_.place(), std::move(what)); }

  /// The standard has the angles of type C begin and end where the rest follows by symmetry.
  void checkCoverage(const std::vector<Real>& vertical, const std::vector<Real>& horizontal) {
    const auto isOneOf = [](Real angle, std::initializer_list<Real> some) {
      return std::find(some.begin(), some.end(), angle) != some.end();
    };
    if (!isOneOf(vertical.front(), {0, 90}) || !isOneOf(vertical.back(), {90, 180}))
      warn("expected vertical angles from 0 or 90 to 90 or 180 degrees, found " + toText(vertical.front()) +
           " to " + toText(vertical.back()) + ": beyond these it gives no light");
    const Real first = horizontal.front(), last = horizontal.back();
    const bool open = first == 0 && last > 180;  // 360 is left out
    if (!open && !(first == 0 && isOneOf(last, {0, 90, 180})) && !(first == 90 && last == 270) &&
        horizontal.size() > 1)
      warn("expected horizontal angles from 0 to 90, 180 or 360 degrees, or from 90 to 270, found " +
           toText(first) + " to " + toText(last) + ": the nearest of these stands for the others");
  }

  Real number(const char* what, Real least) {
    const Real n = words_.number(what);
    if (!(n >= least && n < kInfinity))
      words_.fail("expected " + std::string(what) + ", at least " + toText(least) + ", found " + toText(n));
    return n;
  }
  int whole(const char* what, int least, int most) {
    const Real n = words_.number(what);
    if (!(n >= least && n <= most) || n != std::floor(n))
      words_.fail("expected " + std::string(what) + ", found " + toText(n));
    return static_cast<int>(n);
  }
  /// Each of what is counted takes a character and a blank at least.
  std::size_t count(const char* what) {
    const Real n = words_.number(what);
    if (!(n >= 1) || n != std::floor(n))
      words_.fail("expected " + std::string(what) + ", at least 1, found " + toText(n));
    if (n > static_cast<Real>(words_.left()))
      words_.fail("expected " + std::string(what) + ", found " + toText(n) +
                  ", which is more than the file can hold");
    return static_cast<std::size_t>(n);
  }

  std::vector<Real> angles(const char* what, std::size_t n, Real least, Real most) {
    std::vector<Real> list;
    for (std::size_t i = 0; i < n; ++i) {
      checkBudget();
      const Real angle = words_.number(what);
      if (!(angle >= least && angle <= most))
        words_.fail("expected " + std::string(what) + " from " + toText(least) + " to " + toText(most) +
                    " degrees, found " + toText(angle));
      if (!list.empty() && !(angle > list.back()))
        words_.fail("expected " + std::string(what) + " above " + toText(list.back()) + ", found " +
                    toText(angle));
      list.push_back(angle);
    }
    return list;
  }

  /// Some files leave out 360 degrees, which are 0.
  static void closeRound(Photometry::Type type, std::vector<Real>& horizontal, std::vector<Real>& candelas,
                         std::size_t rows) {
    const bool open = type == Photometry::Type::c && horizontal.front() == 0 && horizontal.back() > 180 &&
                      horizontal.back() < 360;
    if (!open) return;
    horizontal.push_back(360);
    const std::vector<Real> first(candelas.begin(), candelas.begin() + static_cast<std::ptrdiff_t>(rows));
    candelas.insert(candelas.end(), first.begin(), first.end());
  }

  const std::string& file_;
  const std::size_t tilt_;
  const std::string text_;
  Words words_;
  Messages& messages_;
};

}  // namespace

Photometry readIes(const std::string& file, std::string_view bytes, Messages& messages) {
  const TextFront front(file, bytes, messages);
  return IesReader(file, front.text(), messages).read();
}

}  // namespace trace
