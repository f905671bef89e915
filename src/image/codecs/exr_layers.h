// Which channels of an EXR file are the picture. A file may have several parts, of one picture each, and a
// part several layers: channels whose names begin alike, as "diffuse.R" and "diffuse.G" do.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trace {

struct ExrPart {
  std::string name;                   ///< "" where a file has only one
  std::vector<std::string> channels;  ///< their full names, in the order of the alphabet
};

struct ShownChannels {
  std::size_t part = 0;
  std::vector<std::string> shown;   ///< red, green, blue or a grey, then alpha; "" for one that is black
  bool isChroma = false;            ///< Y, RY and BY stand for red, green and blue
  std::string remark;               ///< names what is not shown
  std::vector<std::string> others;  ///< names that would choose it
};

/// Without the name of a layer: R, G and B of the first part, or Y with RY and BY, or X, Y and Z, or Y, or U
/// and V; or those of its first layer; or its first channel, as a grey. With a name: the same of the part or
/// the layer of that name, or the channel, as a grey. "diffuse" also chooses the layer "view.diffuse", and
/// capitals do not matter where nothing else fits. Throws std::runtime_error that lists the layers if there
/// is none.
ShownChannels shownChannels(const std::vector<ExrPart>& parts, const std::string& layer);

}  // namespace trace
