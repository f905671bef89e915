#include "shading/optics/substances.h"

#include <array>

namespace trace {
namespace {

constexpr std::string_view kSchott = "Schott, catalogue of optical glass",
                           kCrc = "CRC Handbook of Chemistry and Physics", kGems = "Webster, Gems",
                           kPlastics = "Handbook of Optics, vol. IV",
                           kKaye = "Kaye and Laby, Tables of Physical and Chemical Constants";

constexpr std::array kSubstances{
    Substance{"vacuum", "gas", 1, 0, "by definition"},
    Substance{"air", "gas", 1.000292, 0, kKaye},
    Substance{"helium", "gas", 1.000035, 0, kKaye},
    Substance{"hydrogen", "gas", 1.000139, 0, kKaye},
    Substance{"carbon dioxide", "gas", 1.000449, 0, kKaye},

    Substance{"water", "liquid", 1.33299, 55.7, kCrc, {}, {0.9, 0.97, 0.99}},
    Substance{"ice", "solid", 1.3091, 0, kCrc, {}, {0.97, 0.99, 1}},
    Substance{"methanol", "liquid", 1.3288, 0, kCrc},
    Substance{"acetone", "liquid", 1.3588, 0, kCrc},
    Substance{"ethanol", "liquid", 1.3611, 60.6, kCrc},
    Substance{"sugar solution 30 %", "liquid", 1.3811, 0, kCrc},
    Substance{"sugar solution 80 %", "liquid", 1.4901, 0, kCrc, {}, {0.98, 0.9, 0.65}},
    Substance{"glycerol", "liquid", 1.4746, 0, kCrc},
    Substance{"turpentine", "liquid", 1.472, 0, kKaye},
    Substance{"olive oil", "liquid", 1.467, 0, kCrc, {}, {0.86, 0.82, 0.25}},
    Substance{"toluene", "liquid", 1.4961, 31.1, kCrc},
    Substance{"benzene", "liquid", 1.5011, 30.0, kCrc},
    Substance{"cinnamon oil", "liquid", 1.601, 0, kKaye, {}, {0.9, 0.7, 0.35}},
    Substance{"carbon disulfide", "liquid", 1.6276, 18.4, kCrc},
    Substance{"diiodomethane", "liquid", 1.7411, 0, kCrc, {}, {0.95, 0.85, 0.5}},

    Substance{"glass", "glass", 1.5, 60, "generic value for scenes"},
    Substance{"window glass", "glass", 1.523, 58.6, kKaye, {}, {0.93, 0.98, 0.95}},
    Substance{"bottle glass", "glass", 1.52, 58, kKaye, {}, {0.2, 0.65, 0.25}},
    Substance{"fused silica", "glass", 1.45846, 67.8, kCrc},
    Substance{"borosilicate glass", "glass", 1.474, 65.4, "Corning, Pyrex 7740"},
    Substance{"lead crystal", "glass", 1.545, 48, "24 % lead oxide; Kaye and Laby"},
    Substance{"FK51A", "glass", 1.48656, 84.47, kSchott, Disperses::fk51a},
    Substance{"BK7", "glass", 1.5168, 64.17, kSchott, Disperses::bk7},
    Substance{"BAF10", "glass", 1.67003, 47.11, kSchott, Disperses::baf10},
    Substance{"SF5", "glass", 1.6727, 32.21, kSchott, Disperses::sf5},
    Substance{"SF10", "glass", 1.72825, 28.41, kSchott, Disperses::sf10},
    Substance{"SF11", "glass", 1.78472, 25.76, kSchott, Disperses::sf11},
    Substance{"LASF9", "glass", 1.85025, 32.17, kSchott, Disperses::lasf9},

    Substance{"acrylic", "plastic", 1.4918, 57.4, kPlastics},
    Substance{"polycarbonate", "plastic", 1.5855, 29.9, kPlastics},
    Substance{"polystyrene", "plastic", 1.5905, 30.9, kPlastics},
    Substance{"CR-39", "plastic", 1.498, 58, kPlastics},

    Substance{"fluorite", "gem", 1.43385, 95.2, kCrc, {}, {0.8, 0.7, 0.95}},
    Substance{"opal", "gem", 1.45, 0, kGems, {}, {0.9, 0.92, 0.95}},
    Substance{"obsidian", "gem", 1.5, 0, kGems, {}, {0.1, 0.09, 0.08}},
    Substance{"amber", "gem", 1.54, 0, kGems, {}, {0.95, 0.6, 0.1}},
    Substance{"rock crystal", "gem", 1.5443, 69.9, kCrc},
    Substance{"amethyst", "gem", 1.5443, 69.9, kGems, {}, {0.6, 0.3, 0.85}},
    Substance{"citrine", "gem", 1.5443, 69.9, kGems, {}, {0.95, 0.75, 0.3}},
    Substance{"rock salt", "gem", 1.5443, 42.8, kCrc},
    Substance{"emerald", "gem", 1.583, 0, kGems, {}, {0.1, 0.7, 0.35}},
    Substance{"aquamarine", "gem", 1.577, 0, kGems, {}, {0.6, 0.88, 0.92}},
    Substance{"topaz", "gem", 1.62, 0, kGems, {}, {0.95, 0.8, 0.5}},
    Substance{"tourmaline", "gem", 1.644, 0, kGems, {}, {0.25, 0.6, 0.45}},
    Substance{"calcite", "gem", 1.6584, 48.8, kCrc},
    Substance{"peridot", "gem", 1.654, 0, kGems, {}, {0.6, 0.8, 0.2}},
    Substance{"spinel", "gem", 1.718, 61, kGems, {}, {0.85, 0.2, 0.35}},
    Substance{"pyrope", "gem", 1.746, 0, kGems, {}, {0.7, 0.08, 0.1}},
    Substance{"sapphire", "gem", 1.7682, 72.2, kCrc, {}, {0.12, 0.22, 0.8}},
    Substance{"ruby", "gem", 1.7682, 72.2, kCrc, {}, {0.85, 0.06, 0.15}},
    Substance{"zircon", "gem", 1.925, 0, kGems, {}, {0.8, 0.9, 0.98}},
    Substance{"cubic zirconia", "gem", 2.1588, 33.5, "Wood and Nassau 1982"},
    Substance{"diamond", "gem", 2.4175, 55.3, kCrc},
    Substance{"rutile", "gem", 2.616, 9.9, kCrc, {}, {0.98, 0.93, 0.8}},
    Substance{"moissanite", "gem", 2.648, 0, kGems},
};

constexpr std::string_view kJensen = "Jensen, Marschner, Levoy and Hanrahan, SIGGRAPH 2001, figure 5",
                           kByEye = "by eye";

constexpr std::array kTranslucents{
    Translucent{"apple", {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, 1.3, 0.4, kJensen},
    Translucent{"chicken", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, 1.3, 0.4, kJensen},
    Translucent{"cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, 1.3, 0.1, kJensen},
    Translucent{"ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, 1.3, 0.2, kJensen},
    Translucent{"marble", {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, 1.5, 0.2, kJensen},
    Translucent{"potato", {0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, 1.3, 0.5, kJensen},
    Translucent{"skim milk", {0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, 1.3, 0.1, kJensen},
    Translucent{"milk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, 1.3, 0.1, kJensen},
    Translucent{"skin", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, 1.3, 0.5, kJensen},
    Translucent{"pale skin", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, 1.3, 0.5, kJensen},
    Translucent{"spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}, 1.3, 0.6, kJensen},
    Translucent{"jade", {0.62, 0.84, 0.66}, {0.024, 0.0045, 0.017}, 1.66, 0.15, kByEye},
    Translucent{"wax", {1.1, 1.05, 0.95}, {0.0015, 0.0045, 0.016}, 1.44, 0.35, kByEye},
};

}  // namespace

std::span<const Substance> substances() { return kSubstances; }
std::span<const Translucent> translucents() { return kTranslucents; }

}  // namespace trace
