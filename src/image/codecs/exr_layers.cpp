// Source: "Technical Introduction to OpenEXR", sections "Channel Names", "Layers" and "Multi-Part"
// (openexr.com).
#include "image/codecs/exr_layers.h"

#include <algorithm>
#include <functional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "base/text.h"
#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

/// "diffuse" of "diffuse.R"; "" of a channel of no layer.
std::string layerOf(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == channel.npos ? "" : channel.substr(0, dot);
}

std::vector<std::string> layersOf(const ExrPart& part) {
  std::vector<std::string> layers;
  for (const std::string& channel : part.channels)
    if (const std::string layer = layerOf(channel);
        !layer.empty() && std::find(layers.begin(), layers.end(), layer) == layers.end())
      layers.push_back(layer);
  return layers;
}

bool hasChannel(const ExrPart& part, const std::string& name) {
  return std::find(part.channels.begin(), part.channels.end(), name) != part.channels.end();
}

/// The layer as a picture, or the channels of no layer; nothing shown if it has no channels of known meaning.
ShownChannels pictureOf(const ExrPart& part, const std::string& layer) {
  const std::string start = layer.empty() ? "" : layer + ".";
  const auto has = [&](const char* name) { return hasChannel(part, start + name); };
  ShownChannels found;
  const auto show = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) found.shown.push_back(has(name) ? start + name : "");
  };
  const int colors = has("R") + has("G") + has("B");
  found.isChroma = colors == 0 && has("Y") && has("RY") && has("BY");
  if (found.isChroma)
    found.shown = {start + "R", start + "G", start + "B"};
  else if (colors >= 2)
    show({"R", "G", "B"});
  else if (has("X") && has("Y") && has("Z"))
    show({"X", "Y", "Z"});
  else if (has("Y"))
    show({"Y"});
  else if (has("U") && has("V"))
    show({"U", "V", ""});
  if (!found.shown.empty() && has("A")) found.shown.push_back(start + "A");
  return found;
}

/// The first of the channels but alpha, as a grey, and alpha.
ShownChannels greyOf(std::span<const std::string> channels) {
  const auto isAlpha = [](const std::string& name) { return name == "A" || name.ends_with(".A"); };
  ShownChannels found;
  const auto first = std::find_if_not(channels.begin(), channels.end(), isAlpha);
  found.shown.push_back(first == channels.end() ? channels.front() : *first);
  const auto alpha = std::find(channels.begin(), channels.end(),
                               layerOf(found.shown[0]).empty() ? "A" : layerOf(found.shown[0]) + ".A");
  if (alpha != channels.end() && *alpha != found.shown[0]) found.shown.push_back(*alpha);
  for (const std::string& name : channels)
    if (std::find(found.shown.begin(), found.shown.end(), name) == found.shown.end())
      found.others.push_back(name);
  if (!found.others.empty())
    found.remark = "of its channels only \"" + found.shown[0] + "\" is shown, as a grey";
  return found;
}

/// "a, b and others".
std::string namesIn(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  return list + (names.size() > kMostNamed ? " and others" : "");
}

/// Channels beside those that are shown, in the same layer.
std::vector<std::string> unshownBeside(const ExrPart& part, const ShownChannels& found,
                                       const std::string& layer) {
  const std::string start = layer.empty() ? "" : layer + ".";
  std::vector<std::string> names;
  for (const std::string& name : part.channels) {
    const bool isShown =
        std::find(found.shown.begin(), found.shown.end(), name) != found.shown.end() ||
        (found.isChroma && (name == start + "Y" || name == start + "RY" || name == start + "BY"));
    if (layerOf(name) == layer && !isShown) names.push_back(name);
  }
  return names;
}

/// The channels shown of a part if no layer of it is chosen.
ShownChannels defaultOf(const ExrPart& part) {
  if (part.channels.empty()) throw std::runtime_error("it has no channel");
  std::vector<std::string> layers = layersOf(part);
  layers.insert(layers.begin(), "");
  for (const std::string& layer : layers) {
    ShownChannels found = pictureOf(part, layer);
    if (found.shown.empty()) continue;
    for (const std::string& other : layers)
      if (other != layer && !other.empty()) found.others.push_back(other);
    if (!found.others.empty())
      found.remark = (layer.empty() ? "its layers are not shown: "
                                    : "the layer \"" + layer + "\" is shown, and others are not: ") +
                     namesIn(found.others);
    const std::vector<std::string> channels = unshownBeside(part, found, layer);
    if (!channels.empty()) remark(found.remark, "channels that are not shown: " + namesIn(channels));
    found.others.insert(found.others.end(), channels.begin(), channels.end());
    return found;
  }
  return greyOf(part.channels);
}

using Fits = std::function<bool(std::string_view)>;

/// The part, layer or channel whose name fits; nothing shown if there is none.
ShownChannels chosenIf(const std::vector<ExrPart>& parts, const Fits& fits) {
  ShownChannels found;
  const auto take = [&](std::size_t part, ShownChannels shown) {
    found = std::move(shown);
    found.part = part;
    return found;
  };
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!parts[i].name.empty() && fits(parts[i].name)) {
      ShownChannels shown = defaultOf(parts[i]);
      shown.remark.clear();
      return take(i, std::move(shown));
    }
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const std::string& layer : layersOf(parts[i])) {
      if (!fits(layer) && !fits(parts[i].name + "." + layer)) continue;
      ShownChannels shown = pictureOf(parts[i], layer);
      if (!shown.shown.empty()) return take(i, std::move(shown));
      std::vector<std::string> channels;
      for (const std::string& channel : parts[i].channels)
        if (layerOf(channel) == layer) channels.push_back(channel);
      return take(i, greyOf(channels));
    }
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const std::string& channel : parts[i].channels)
      if (fits(channel) || fits(parts[i].name + "." + channel)) {
        found.shown = {channel};
        return take(i, found);
      }
  return found;
}

/// Names that choose something.
std::vector<std::string> choices(const std::vector<ExrPart>& parts) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const ExrPart& part : parts) add(part.name);
  for (const ExrPart& part : parts)
    for (const std::string& layer : layersOf(part)) add(layer);
  for (const ExrPart& part : parts)
    for (const std::string& channel : part.channels)
      if (layerOf(channel).empty()) add(channel);
  return names;
}

/// The channels shown if no layer is chosen.
ShownChannels usualOf(const std::vector<ExrPart>& parts) {
  ShownChannels found = defaultOf(parts[0]);
  std::vector<std::string> others;
  for (std::size_t i = 1; i < parts.size(); ++i) others.push_back(parts[i].name);
  if (!others.empty())
    remark(found.remark, "only the first of its parts is shown, and not: " + namesIn(others));
  found.others.insert(found.others.end(), others.begin(), others.end());
  if (!found.others.empty())
    remark(found.remark, "a name behind a colon chooses one, as in file.exr:" + found.others.front());
  return found;
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace

ShownChannels shownChannels(const std::vector<ExrPart>& parts, const std::string& layer) {
  if (parts.empty()) throw std::runtime_error("it has no part");
  if (layer.empty()) return usualOf(parts);
  const std::string lower = lowered(layer);
  const std::vector<std::string> names = choices(parts);
  for (const Fits& fits : {Fits([&](std::string_view name) { return name == layer; }),
                           Fits([&](std::string_view name) { return lowered(name) == lower; }),
                           Fits([&](std::string_view name) { return lowered(name).ends_with("." + lower); })})
    if (ShownChannels found = chosenIf(parts, fits); !found.shown.empty()) return found;
  const auto isWithin = [&](std::string_view name) { return lowered(name).starts_with(lower + "."); };
  std::vector<std::string> within;
  std::copy_if(names.begin(), names.end(), std::back_inserter(within), isWithin);
  if (within.size() > 1)
    throw std::runtime_error("expected one of the layers of \"" + layer + "\", " + namesIn(within) +
                             "; found \"" + layer + "\"");
  if (ShownChannels found = chosenIf(parts, isWithin); !found.shown.empty()) return found;
  const std::string meant = didYouMean(layer, std::vector<std::string_view>(names.begin(), names.end()));
  throw std::runtime_error("expected one of its layers, " + namesIn(names) + "; found \"" + layer + "\"" +
                           (meant.empty() ? "" : "; " + meant));
}

}  // namespace trace
