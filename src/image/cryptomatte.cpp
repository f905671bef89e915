#include "image/cryptomatte.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "base/bits.h"
#include "base/budget.h"

namespace trace {
namespace {

/// Ranks of a layer: R, G of the first and B, A of the second.
constexpr std::size_t kRanksOfLayer = 2;
/// Compositing programs expect these; a picture with more in a pixel has more.
constexpr std::size_t kFewestLayers = 3, kMostLayers = 16;

std::string hexText(std::uint32_t number) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", number);
  return text;
}

/// The text as a string of JSON.
std::string jsonText(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    char escape[8];
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (byte < 0x20) {
      std::snprintf(escape, sizeof escape, "\\u%04x", byte);
      json += escape;
    } else {
      json += c;
    }
  }
  return json + '"';
}

}  // namespace

std::uint32_t murmurHash3(std::string_view text) {
  constexpr std::uint32_t c1 = 0xcc9e2d51u, c2 = 0x1b873593u;
  const auto byteAt = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
  std::uint32_t hash = 0;
  const std::size_t blocks = text.size() / 4;
  for (std::size_t i = 0; i < blocks; ++i) {
    std::uint32_t k =
        byteAt(4 * i) | byteAt(4 * i + 1) << 8 | byteAt(4 * i + 2) << 16 | byteAt(4 * i + 3) << 24;
    k = rotateLeft(k * c1, 15) * c2;
    hash = rotateLeft(hash ^ k, 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t tail = 0;
  for (std::size_t i = text.size(); i-- > 4 * blocks;) tail = tail << 8 | byteAt(i);
  if (text.size() > 4 * blocks) hash ^= rotateLeft(tail * c1, 15) * c2;
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

std::uint32_t cryptomatteId(std::string_view name) {
  const std::uint32_t hash = murmurHash3(name), exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

std::vector<std::string> cryptomatteNames(std::span<const std::string> names) {
  std::set<std::uint32_t> taken{0};  // which stands for nothing
  std::vector<std::string> all;
  for (const std::string& name : names) {
    std::string own = name;
    for (int number = 2; !taken.insert(cryptomatteId(own)).second; ++number)
      own = name + "_" + std::to_string(number);
    all.push_back(own);
  }
  return all;
}

void addCryptomatte(ExrFile& file, const std::string& layer, std::span<const std::string> names,
                    const std::vector<std::vector<Film::Share>>& shares) {
  const std::vector<std::string> own = cryptomatteNames(names);
  std::string manifest;
  for (const std::string& name : own)
    manifest += (manifest.empty() ? "{" : ",") + jsonText(name) + ":\"" + hexText(cryptomatteId(name)) + "\"";
  if (manifest.empty()) manifest = "{";
  const std::string key = "cryptomatte/" + hexText(cryptomatteId(layer)).substr(0, 7) + "/";
  file.attributes.emplace_back(key + "name", layer);
  file.attributes.emplace_back(key + "hash", "MurmurHash3_32");
  file.attributes.emplace_back(key + "conversion", "uint32_to_float32");
  file.attributes.emplace_back(key + "manifest", manifest + "}");

  std::size_t ranks = kFewestLayers * kRanksOfLayer;
  for (const auto& pixel : shares) ranks = std::max(ranks, pixel.size());
  const std::size_t layers = std::min(kMostLayers, (ranks + kRanksOfLayer - 1) / kRanksOfLayer);
  const Tile& window = file.window;
  for (std::size_t rank = 0; rank < layers * kRanksOfLayer; ++rank) {
    std::vector<float> ids, covers;
    for (int y = window.y0; y < window.y1; ++y) {
      checkBudget();
      for (int x = window.x0; x < window.x1; ++x) {
        const auto& pixel = shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(file.width) +
                                   static_cast<std::size_t>(x)];
        const bool isThere =
            rank < pixel.size() && pixel[rank].number >= 1 && pixel[rank].number <= own.size();
        ids.push_back(isThere ? bitCast<float>(cryptomatteId(own[pixel[rank].number - 1])) : 0.0f);
        covers.push_back(isThere ? static_cast<float>(pixel[rank].share) : 0.0f);
      }
    }
    const std::size_t number = rank / kRanksOfLayer;
    const std::string start = layer + (number < 10 ? "0" : "") + std::to_string(number) + ".";
    const bool isFirst = rank % kRanksOfLayer == 0;
    file.channels.push_back({start + (isFirst ? "R" : "B"), std::move(ids)});
    file.channels.push_back({start + (isFirst ? "G" : "A"), std::move(covers)});
  }
}

}  // namespace trace
