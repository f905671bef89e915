// Draco's decoder, which only this file sees. It makes room for the triangles and values that its data claim
// before it looks for them: claims are compared with the number of bytes first. Source: Google, Draco
// bitstream specification, sections 2 to 4, as its decoder of version 1.5.5 reads it.
#include "formats/mesh/gltf/draco.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace trace {
namespace {

/// The start of a compressed mesh.
struct DracoHead {
  bool isEdgebreaker = false;  ///< or sequential
  std::uint32_t faces = 0, points = 0;
  std::uint8_t seams = 0;  ///< attributes with connectivity of their own
};

class DracoHeadReader {
 public:
  explicit DracoHeadReader(std::string_view bytes) { buffer_.Init(bytes.data(), bytes.size()); }

  DracoHead read() {
    constexpr std::uint8_t kMesh = 1, kEdgebreaker = 1;
    constexpr std::uint16_t kMetadata = 0x8000;
    char name[5];
    if (!buffer_.Decode(name, sizeof name) || std::memcmp(name, "DRACO", sizeof name) != 0)
      throw std::runtime_error("the data do not begin as Draco's do");
    const auto major = plain<std::uint8_t>(), minor = plain<std::uint8_t>();
    version_ = static_cast<std::uint16_t>(major << 8 | minor);
    buffer_.set_bitstream_version(version_);
    if (plain<std::uint8_t>() != kMesh) throw std::runtime_error("expected a mesh, found a cloud of points");
    const auto method = plain<std::uint8_t>();
    if ((plain<std::uint16_t>() & kMetadata) != 0 && version_ >= 0x0103) skipMetadata();
    DracoHead head;
    head.isEdgebreaker = method == kEdgebreaker;
    if (!head.isEdgebreaker) {
      head.faces = version_ < 0x0202 ? plain<std::uint32_t>() : packed();
      head.points = version_ < 0x0202 ? plain<std::uint32_t>() : packed();
      return head;
    }
    plain<std::uint8_t>();  // the kind of traversal
    const std::uint32_t added = version_ < 0x0202 ? number() : 0;
    head.points = number();
    head.faces = number();
    head.seams = plain<std::uint8_t>();
    number();  // symbols: no more than faces
    const std::uint32_t splits = number();
    head.points = std::max({head.points, added, splits});
    return head;
  }

 private:
  template <class T>
  T plain() {
    T value;
    if (!buffer_.Decode(&value)) throw std::runtime_error("the data end too early");
    return value;
  }
  std::uint32_t packed() {
    std::uint32_t value;
    if (!draco::DecodeVarint(&value, &buffer_)) throw std::runtime_error("the data end too early");
    return value;
  }
  std::uint32_t number() { return version_ < 0x0200 ? plain<std::uint32_t>() : packed(); }
  void skipMetadata() {
    draco::GeometryMetadata ignored;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer_, &ignored))
      throw std::runtime_error("the data end too early");
  }

  draco::DecoderBuffer buffer_;
  std::uint16_t version_ = 0;
};

/// The best that Draco does is ten triangles a byte, of a flat grid; an attribute with seams adds its own.
void checkClaims(std::string_view bytes, const DracoHead& head) {
  constexpr double kAny = 4096, kPerByte = 100;
  const double most = kAny + kPerByte * static_cast<double>(bytes.size());
  const double triangles = static_cast<double>(head.faces) * (1 + head.seams);
  if (triangles <= most && head.points <= most) return;
  throw std::runtime_error(std::to_string(head.faces) + " triangles of " + std::to_string(head.points) +
                           " points are not believable in " + std::to_string(bytes.size()) + " bytes");
}

template <class T>
std::vector<unsigned char> valuesAs(const draco::PointAttribute& from, std::size_t points,
                                    std::size_t components) {
  std::vector<unsigned char> bytes(points * components * sizeof(T));
  T value[4];
  for (std::size_t i = 0; i < points; ++i) {
    const draco::AttributeValueIndex at = from.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    if (at.value() >= from.size() || !from.ConvertValue<T>(at, static_cast<std::int8_t>(components), value))
      throw std::runtime_error("an attribute has a value that its accessor cannot hold");
    std::memcpy(bytes.data() + i * components * sizeof(T), value, components * sizeof(T));
  }
  return bytes;
}

std::vector<unsigned char> valuesOf(const draco::Mesh& mesh, const DracoAttribute& wanted) {
  const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(wanted.id);
  if (!from) throw std::runtime_error("it has no attribute of the number " + std::to_string(wanted.id));
  if (from->num_components() < static_cast<int>(wanted.components))
    throw std::runtime_error("the attribute of the number " + std::to_string(wanted.id) + " has " +
                             std::to_string(from->num_components()) + " components, and its accessor " +
                             std::to_string(wanted.components));
  switch (wanted.number) {
    case DracoNumber::int8: return valuesAs<std::int8_t>(*from, mesh.num_points(), wanted.components);
    case DracoNumber::uint8: return valuesAs<std::uint8_t>(*from, mesh.num_points(), wanted.components);
    case DracoNumber::int16: return valuesAs<std::int16_t>(*from, mesh.num_points(), wanted.components);
    case DracoNumber::uint16: return valuesAs<std::uint16_t>(*from, mesh.num_points(), wanted.components);
    case DracoNumber::uint32: return valuesAs<std::uint32_t>(*from, mesh.num_points(), wanted.components);
    case DracoNumber::float32: break;
  }
  return valuesAs<float>(*from, mesh.num_points(), wanted.components);
}

/// Stops before it makes room for more values than so many bytes can hold.
template <class MeshDecoder>
class CheckedDecoder : public MeshDecoder {
 public:
  std::unique_ptr<draco::Mesh> decode(std::string_view bytes) {
    bytes_ = static_cast<double>(bytes.size());
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    auto mesh = std::make_unique<draco::Mesh>();
    const draco::Status status = this->Decode(draco::DecoderOptions(), &buffer, mesh.get());
    if (!refused_.empty()) throw std::runtime_error(refused_);
    if (status.ok()) return mesh;
    const std::string reason = status.error_msg_string();
    throw std::runtime_error(reason.empty() ? "the data are damaged" : "the data are damaged: " + reason);
  }

 private:
  /// Five points a byte, of twenty components each, would be the best that Draco does.
  bool DecodeAllAttributes() override {
    constexpr double kAny = 1 << 20, kPerByte = 256;
    const draco::PointCloud& mesh = *this->point_cloud();
    double values = 0;
    for (int i = 0; i < mesh.num_attributes(); ++i)
      values += static_cast<double>(mesh.attribute(i)->num_components()) * mesh.num_points();
    if (values <= kAny + kPerByte * bytes_) return MeshDecoder::DecodeAllAttributes();
    refused_ = std::to_string(mesh.num_attributes()) + " attributes of " + std::to_string(mesh.num_points()) +
               " points are not believable in " + std::to_string(static_cast<std::size_t>(bytes_)) + " bytes";
    return false;
  }

  double bytes_ = 0;
  std::string refused_;
};

std::unique_ptr<draco::Mesh> decodedMesh(std::string_view bytes) {
  const DracoHead head = DracoHeadReader(bytes).read();
  checkClaims(bytes, head);
  return head.isEdgebreaker ? CheckedDecoder<draco::MeshEdgebreakerDecoder>().decode(bytes)
                            : CheckedDecoder<draco::MeshSequentialDecoder>().decode(bytes);
}

DracoMesh meshIn(std::string_view bytes, std::span<const DracoAttribute> attributes) {
  const std::unique_ptr<draco::Mesh> mesh = decodedMesh(bytes);
  DracoMesh result;
  result.points = mesh->num_points();
  result.corners.reserve(std::size_t{3} * mesh->num_faces());
  for (draco::FaceIndex i(0); i < mesh->num_faces(); ++i)
    for (const draco::PointIndex& corner : mesh->face(i)) {
      if (corner.value() >= result.points) throw std::runtime_error("the data are damaged");
      result.corners.push_back(corner.value());
    }
  for (const DracoAttribute& attribute : attributes) result.values.push_back(valuesOf(*mesh, attribute));
  return result;
}

}  // namespace

DracoMesh decodeDraco(std::string_view bytes, std::span<const DracoAttribute> attributes) {
  try {
    return meshIn(bytes, attributes);
  } catch (const std::logic_error&) {  // thrown by a vector of a damaged size
    throw std::runtime_error("the data are damaged");
  }
}

}  // namespace trace
