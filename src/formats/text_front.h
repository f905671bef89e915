// The front of all readers of text: what other programs and systems do to a text file before its format
// begins.
//
// Taken away or translated are gzip's compression (which VRML, X3D and Inventor allow), UTF-16 and UTF-32,
// byte order marks, the DOS end of file (0x1A) and zeros behind the text, and a carriage return alone at the
// end of a line. So a reader sees UTF-8 (or what the file has) with lines that end in \n or \r\n, and lines
// and columns are those an editor shows. Binary files pass as they are, except for gzip. Sources: RFC 1952;
// The Unicode Standard, section 3.10.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/input_files.h"

namespace trace {

class TextFront {
 public:
  /// Refers to the bytes where nothing has to change. Throws Error(Fault::scene) for compressed bytes that
  /// are damaged, Error(Fault::limit) if they stand for more than 2 GiB.
  TextFront(const std::string& file, std::string_view bytes);
  /// Warns of what is cut off, too.
  TextFront(const std::string& file, std::string_view bytes, Messages& messages);
  TextFront(const TextFront&) = delete;
  TextFront& operator=(const TextFront&) = delete;

  std::string_view text() const { return text_; }
  /// The text is not a part of the bytes: they were compressed, or UTF-16.
  bool wasEncoded() const { return encoded_; }
  /// Something at the end is left out.
  bool wasCut() const { return cut_; }

 private:
  void cutEnd();
  void endLines();

  std::string room_;  ///< the text, if it is not that of the bytes
  std::string_view text_;
  bool encoded_ = false, cut_ = false, cutText_ = false;
};

/// readBeside() of scene/input_files.h for a text that is named by another file, through the front.
std::string readTextBeside(const std::string& from, const std::string& name, InputFiles& inputs,
                           Messages& messages);

/// Is that the first word of the text, in letters of any case?
bool beginsWithWord(std::string_view text, std::string_view word);

}  // namespace trace
