// The camera and the lights of a glTF file.
#pragma once

#include "base/error.h"
#include "formats/model.h"

namespace tinygltf {
struct Camera;
struct Light;
}  // namespace tinygltf

namespace trace {

/// Takes the camera for the model's, if that has none yet.
void readCamera(const tinygltf::Camera& from, const Affine& worldFromNode, const SourcePlace& place,
                Model& model, Messages& messages);

/// Candela and lux become the courses' colours, whose matt surfaces do not divide by pi.
void readLight(const tinygltf::Light& from, const Affine& worldFromNode, const SourcePlace& place,
               Model& model, Messages& messages);

}  // namespace trace
