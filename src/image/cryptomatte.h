// Mattes by name in a picture file: which share of a pixel each name covers, as compositing programs read it.
//
// Source: Cryptomatte Specification, version 1.2.0 (Psyop), and MurmurHash3_x86_32 (A. Appleby, public
// domain).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/codecs/exr_file.h"
#include "image/film/film.h"

namespace trace {

std::uint32_t murmurHash3(std::string_view text);

/// The bits of the float that stands for a name: its hash, of which one bit is changed where it would be no
/// number.
std::uint32_t cryptomatteId(std::string_view name);

/// The names as the manifest lists them: two of the same id differ by what is added to the later one.
std::vector<std::string> cryptomatteNames(std::span<const std::string> names);

/// Adds the layers LAYER00, LAYER01, ... with two ranks each, and the attributes. The shares of each pixel of
/// the whole picture have the numbers of names, from 1; the largest share first.
void addCryptomatte(ExrFile& file, const std::string& layer, std::span<const std::string> names,
                    const std::vector<std::vector<Film::Share>>& shares);

}  // namespace trace
