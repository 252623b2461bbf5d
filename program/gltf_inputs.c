// SPDX-License-Identifier: Apache-2.0
#include "program/gltf_inputs.h"

#include <math.h>
#include <string.h>

#define PBR "pbrMetallicRoughness"
#define COAT "KHR_materials_clearcoat"
#define SHEEN "KHR_materials_sheen"
#define VOLUME "KHR_materials_volume"
#define SPECULAR "KHR_materials_specular"
#define FILM "KHR_materials_iridescence"
#define BRUSHED "KHR_materials_anisotropy"

const struct gltf_image_kind gltf_images[GLTF_NUM_IMAGES] = {
    [GLTF_BASE] = {"baseColor", true},
    [GLTF_SURFACE] = {"occlusionRoughnessMetallic", false},
    [GLTF_NORMAL] = {"normal", false},
    [GLTF_EMISSIVE] = {"emissive", true},
    [GLTF_CLEARCOAT] = {"clearcoat", false},
    [GLTF_CLEARCOAT_NORMAL] = {"clearcoatNormal", false},
    [GLTF_SHEEN] = {"sheen", true},
    [GLTF_TRANSMISSION] = {"transmission", false},
    [GLTF_SPECULAR] = {"specular", true},
    [GLTF_IRIDESCENCE] = {"iridescence", false},
    [GLTF_ANISOTROPY] = {"anisotropy", false},
};

/* clang-format off */
const struct gltf_input gltf_inputs[] = {
    /* input, object, factor, texture; image, channel, numbers; first in the factor, array; low, high, or 0; values without */
    {"base_color", PBR, "baseColorFactor", "baseColorTexture", GLTF_BASE, 0, 3, 0, true, 0, 1, false, 1, 1, {0}},
    {"alpha", PBR, "baseColorFactor", "baseColorTexture", GLTF_BASE, 3, 1, 3, true, 0, 1, false, 1, 1, {0}},
    {"metallic", PBR, "metallicFactor", "metallicRoughnessTexture", GLTF_SURFACE, 2, 1, 0, false, 0, 1, false, 1, 1, {0}},
    {"roughness", PBR, "roughnessFactor", "metallicRoughnessTexture", GLTF_SURFACE, 1, 1, 0, false, 0, 1, false, 1, 1, {0}},
    {"occlusion", NULL, NULL, "occlusionTexture", GLTF_SURFACE, 0, 1, 0, false, 0, 1, false, 1, 1, {0}},
    {"normal", NULL, NULL, "normalTexture", GLTF_NORMAL, 0, 3, 0, false, 0, 1, false, 0, 0, {0}},
    {"emissive", NULL, "emissiveFactor", "emissiveTexture", GLTF_EMISSIVE, 0, 3, 0, true, 0, INFINITY, false, 0, 0, {0}},
    {"emissive_strength", "KHR_materials_emissive_strength", "emissiveStrength", NULL, 0, 0, 1, 0, false, 0, INFINITY, false, 1, 1, {"emissive"}},
    {"ior", "KHR_materials_ior", "ior", NULL, 0, 0, 1, 0, false, 1, INFINITY, true, 1.5f, 1.5f, {0}},
    {"specular", SPECULAR, "specularFactor", "specularTexture", GLTF_SPECULAR, 3, 1, 0, false, 0, 1, false, 1, 1, {0}},
    {"specular_color", SPECULAR, "specularColorFactor", "specularColorTexture", GLTF_SPECULAR, 0, 3, 0, true, 0, INFINITY, false, 1, 1, {0}},
    {"clearcoat", COAT, "clearcoatFactor", "clearcoatTexture", GLTF_CLEARCOAT, 0, 1, 0, false, 0, 1, false, 0, 0, {"clearcoat"}},
    {"clearcoat_roughness", COAT, "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", GLTF_CLEARCOAT, 1, 1, 0, false, 0, 1, false, 0, 0, {"clearcoat"}},
    {"clearcoat_normal", COAT, NULL, "clearcoatNormalTexture", GLTF_CLEARCOAT_NORMAL, 0, 3, 0, false, 0, 1, false, 0, 0, {"clearcoat"}},
    {"sheen_color", SHEEN, "sheenColorFactor", "sheenColorTexture", GLTF_SHEEN, 0, 3, 0, true, 0, 1, false, 0, 0, {"sheen_color"}},
    {"sheen_roughness", SHEEN, "sheenRoughnessFactor", "sheenRoughnessTexture", GLTF_SHEEN, 3, 1, 0, false, 0, 1, false, 0, 0, {"sheen_color"}},
    {"transmission", "KHR_materials_transmission", "transmissionFactor", "transmissionTexture", GLTF_TRANSMISSION, 0, 1, 0, false, 0, 1, false, 0, 0, {0}},
    {"thickness", VOLUME, "thicknessFactor", "thicknessTexture", GLTF_TRANSMISSION, 1, 1, 0, false, 0, INFINITY, false, 0, 0, {"transmission"}},
    {"attenuation_distance", VOLUME, "attenuationDistance", NULL, 0, 0, 1, 0, false, 0, INFINITY, false, 0, 0, {"transmission", "thickness"}},
    {"attenuation_color", VOLUME, "attenuationColor", NULL, 0, 0, 3, 0, true, 0, 1, false, 1, 1, {"transmission", "thickness"}},
    {"dispersion", "KHR_materials_dispersion", "dispersion", NULL, 0, 0, 1, 0, false, 0, INFINITY, false, 0, 0, {"transmission", "thickness"}},
    {"iridescence", FILM, "iridescenceFactor", "iridescenceTexture", GLTF_IRIDESCENCE, 0, 1, 0, false, 0, 1, false, 0, 0, {"iridescence"}},
    {"iridescence_ior", FILM, "iridescenceIor", NULL, 0, 0, 1, 0, false, 1, INFINITY, false, 1.3f, 1.3f, {"iridescence"}},
    {"iridescence_thickness", FILM, "iridescenceThicknessMaximum", "iridescenceThicknessTexture", GLTF_IRIDESCENCE, 1, 1, 0, false, 0, INFINITY, false, 100, 400, {"iridescence"}},
    {"anisotropy_strength", BRUSHED, "anisotropyStrength", "anisotropyTexture", GLTF_ANISOTROPY, 2, 1, 0, false, 0, 1, false, 0, 0, {"anisotropy_strength"}},
    {"anisotropy_rotation", BRUSHED, "anisotropyRotation", "anisotropyTexture", GLTF_ANISOTROPY, 0, 1, 0, false, -INFINITY, INFINITY, false, 0, 0, {"anisotropy_strength"}},
    {"alpha_cutoff", NULL, "alphaCutoff", NULL, 0, 0, 1, 0, false, 0, INFINITY, false, 0.5f, 0.5f, {0}},
};
/* clang-format on */
const size_t gltf_num_inputs = sizeof gltf_inputs / sizeof *gltf_inputs;

const struct gltf_input *gltf_find_input(const char *name)
{
    const struct gltf_input *row = gltf_inputs;
    while (strcmp(row->name, name) != 0)
        ++row;
    return row;
}
