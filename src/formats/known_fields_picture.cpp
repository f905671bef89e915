// How Trace treats the fields of pictures. Sources: PNG (ISO/IEC 15948); JFIF 1.02, EXIF 2.3, ITU T.81;
// Microsoft, "Bitmap Header Types"; Truevision, TGA 2.0; Greg Ward, Radiance picture format; OpenEXR,
// "Standard Attributes"; RFC 9649, WebP; netpbm's pbm(5), pgm(5), ppm(5), pam(5) and pfm(5).
#include <array>

#include "formats/known_fields.h"

namespace trace {
namespace {

using namespace known;

constexpr std::string_view kSquares = "if they differ: pixels are shown as squares";

constexpr std::array kPngRows{
    KnownField{"IHDR: width, height", kShown, ""},
    KnownField{"IHDR: bit depth 1, 2, 4", kShown, ""},
    KnownField{"IHDR: bit depth 16", kShown, ""},
    KnownField{"IHDR: colour type 0, grey", kShown, ""},
    KnownField{"IHDR: colour type 3, PLTE", kShown, ""},
    KnownField{"IHDR: colour types 4 and 6, alpha", kShown, "holes"},
    KnownField{"IHDR: interlace", kShown, ""},
    KnownField{"tRNS", kShown, "holes"},
    KnownField{"gAMA", kReported, "if it is not 1 / 2.2 and there is no sRGB"},
    KnownField{"cHRM", kReported, "if it is not sRGB's"},
    KnownField{"sRGB", kIdle, "what is expected"},
    KnownField{"iCCP", kReported, "if it is not sRGB"},
    KnownField{"cICP", kReported, "if it is not sRGB"},
    KnownField{"eXIf: orientation", kShown, ""},
    KnownField{"pHYs", kReported, kSquares},
    KnownField{"acTL", kReported, "an animation"},
    KnownField{"bKGD", kIdle, "holes show what is behind them"},
    KnownField{"sBIT", kIdle, ""},
    KnownField{"hIST", kIdle, ""},
    KnownField{"sPLT", kIdle, ""},
    KnownField{"tIME", kIdle, ""},
    KnownField{"tEXt", kIdle, "Trace's own tell how a picture was made"},
    KnownField{"zTXt", kIdle, ""},
    KnownField{"iTXt", kIdle, ""},
};

constexpr std::array kJpegRows{
    KnownField{"pixels", kShown, "baseline and progressive"},
    KnownField{"arithmetic coding", kRefused, ""},
    KnownField{"lossless", kRefused, ""},
    KnownField{"12 bits", kRefused, ""},
    KnownField{"no end marker", kReported, "shown if the picture is whole"},
    KnownField{"JFIF: density", kReported, kSquares},
    KnownField{"EXIF: orientation", kShown, ""},
    KnownField{"ICC profile", kReported, "if it is not sRGB"},
    KnownField{"Adobe: transform", kShown, ""},
    KnownField{"comment", kIdle, "Trace's own tell how a picture was made"},
    KnownField{"other segments", kIdle, "thumbnails, XMP ..."},
};

constexpr std::array kBmpRows{
    KnownField{"width", kShown, ""},
    KnownField{"height", kShown, "below 0: rows from above"},
    KnownField{"planes", kIdle, ""},
    KnownField{"bits", kShown, "1, 2, 4, 8, 16, 24, 32"},
    KnownField{"compression 1, 2", kShown, "run lengths of 8 and 4 bits"},
    KnownField{"compression 3, 6", kShown, "masks"},
    KnownField{"compression 4, 5", kRefused, "JPEG or PNG inside"},
    KnownField{"size of the pixels", kIdle, ""},
    KnownField{"pixels per metre", kReported, kSquares},
    KnownField{"number of colours", kShown, ""},
    KnownField{"important colours", kIdle, ""},
    KnownField{"alpha mask", kShown, "holes"},
    KnownField{"calibrated primaries and gamma", kReported, ""},
    KnownField{"embedded profile", kReported, "if it is not sRGB"},
    KnownField{"intent", kIdle, ""},
};

constexpr std::array kTgaRows{
    KnownField{"identification", kIdle, ""},
    KnownField{"type 1, colour map", kShown, ""},
    KnownField{"type 2, colours", kShown, ""},
    KnownField{"type 3, grey", kShown, ""},
    KnownField{"types 9, 10, 11, run lengths", kShown, ""},
    KnownField{"first entry of the colour map", kRefused, "other than 0"},
    KnownField{"x and y of the screen", kIdle, ""},
    KnownField{"depth", kShown, "8, 16, 24, 32"},
    KnownField{"bits of alpha", kShown, "the fourth byte says nothing if it is 0 everywhere"},
    KnownField{"alpha of 16 bits", kReported, ""},
    KnownField{"origin", kShown, ""},
    KnownField{"interleaving", kRefused, ""},
    KnownField{"extension: attributes", kShown, "no alpha, or colours that are multiplied by it"},
    KnownField{"extension: pixel aspect ratio", kReported, kSquares},
    KnownField{"extension: gamma", kReported, ""},
    KnownField{"extension: colour correction", kReported, ""},
    KnownField{"extension: author and other words", kIdle, ""},
};

constexpr std::array kHdrRows{
    KnownField{"FORMAT", kShown, "rgbe or xyze"},
    KnownField{"FORMAT of another kind", kRefused, ""},
    KnownField{"EXPOSURE", kShown, "taken back"},
    KnownField{"COLORCORR", kShown, "taken back"},
    KnownField{"PRIMARIES", kReported, ""},
    KnownField{"PIXASPECT", kReported, "pixels are shown as squares"},
    KnownField{"VIEW", kIdle, ""},
    KnownField{"SOFTWARE", kIdle, ""},
    KnownField{"# comment", kIdle, "Trace's own tell how a picture was made"},
    KnownField{"orientation", kShown, "-Y +X and the seven others"},
    KnownField{"run lengths", kShown, "old and new"},
};

constexpr std::array kExrRows{
    KnownField{"R, G, B", kShown, ""},
    KnownField{"A", kShown, "holes; colours are multiplied by it"},
    KnownField{"Y", kShown, "a grey"},
    KnownField{"Y, RY, BY", kShown, "luminance and chroma, also at lower resolution"},
    KnownField{"X, Y, Z", kShown, "as red, green and blue"},
    KnownField{"U, V", kShown, "as red and green"},
    KnownField{"one channel", kShown, "a grey"},
    KnownField{"other channels", kReported, "Z ..."},
    KnownField{"layers", kReported,
               "shown is the one that the name of the file chooses, the one without a name, or the first"},
    KnownField{"types half, float, uint", kShown, ""},
    KnownField{"sampling", kRefused, "sampling of R, G, B below that of the picture"},
    KnownField{"parts", kReported, "shown is the one that the name of the file chooses, or the first"},
    KnownField{"deep data", kRefused, ""},
    KnownField{"tiles", kShown, ""},
    KnownField{"compression", kShown, ""},
    KnownField{"lineOrder", kIdle, ""},
    KnownField{"dataWindow", kShown, ""},
    KnownField{"displayWindow", kShown, "the picture; black where there are no data"},
    KnownField{"pixelAspectRatio", kReported, "if it is not 1"},
    KnownField{"screenWindowCenter", kIdle, "view of a camera"},
    KnownField{"screenWindowWidth", kIdle, "view of a camera"},
    KnownField{"chromaticities", kShown, "changed to those of Rec. 709"},
    KnownField{"whiteLuminance", kReported, ""},
    KnownField{"adoptedNeutral", kReported, ""},
    KnownField{"envmap", kReported, "a cube map; a latitude-longitude map is the usual picture"},
    KnownField{"wrapmodes", kReported, ""},
    KnownField{"other attributes", kIdle, "Trace's own tell how a picture was made"},
};

constexpr std::array kPpmRows{
    KnownField{"P1", kShown, "black and white as digits"},
    KnownField{"P2", kShown, "grey as numbers"},
    KnownField{"P3", kShown, "colours as numbers"},
    KnownField{"P4", kShown, "black and white"},
    KnownField{"P5", kShown, "grey"},
    KnownField{"P6", kShown, "colours"},
    KnownField{"maximum", kShown, "1 to 65535"},
    KnownField{"# comment", kIdle, "Trace's own tell how a picture was made"},
    KnownField{"P7: WIDTH, HEIGHT, DEPTH", kShown, ""},
    KnownField{"P7: MAXVAL", kShown, ""},
    KnownField{"P7: TUPLTYPE", kIdle, "the depth says it"},
    KnownField{"P7: TUPLTYPE of another kind", kRefused, "CMYK ..."},
    KnownField{"P7: depths 2 and 4, alpha", kShown, "holes"},
    KnownField{"several pictures", kReported, "the first is shown"},
};

constexpr std::array kPfmRows{
    KnownField{"PF", kShown, "colours"},
    KnownField{"Pf", kShown, "grey"},
    KnownField{"scale: sign", kShown, "the byte order"},
    KnownField{"scale: size", kReported, "if it is not 1"},
};

constexpr std::array kWebpRows{
    KnownField{"VP8, with loss", kShown, ""},
    KnownField{"VP8L, without loss", kShown, ""},
    KnownField{"alpha of VP8L", kShown, "holes"},
    KnownField{"ALPH", kShown, "holes"},
    KnownField{"ANIM, ANMF", kReported, "the first picture of an animation is shown"},
    KnownField{"EXIF: orientation", kShown, ""},
    KnownField{"ICCP", kReported, "if it is not sRGB"},
    KnownField{"XMP", kIdle, ""},
    KnownField{"other chunks", kIdle, ""},
};

}  // namespace

std::span<const KnownField> knownPngFields() { return kPngRows; }
std::span<const KnownField> knownJpegFields() { return kJpegRows; }
std::span<const KnownField> knownBmpFields() { return kBmpRows; }
std::span<const KnownField> knownTgaFields() { return kTgaRows; }
std::span<const KnownField> knownHdrFields() { return kHdrRows; }
std::span<const KnownField> knownExrFields() { return kExrRows; }
std::span<const KnownField> knownPpmFields() { return kPpmRows; }
std::span<const KnownField> knownPfmFields() { return kPfmRows; }
std::span<const KnownField> knownWebpFields() { return kWebpRows; }

}  // namespace trace
