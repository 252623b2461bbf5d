// SPDX-License-Identifier: Apache-2.0
/* mxgen render --bake-occlusion: a layer of USD with the primvar `ambientocclusion` of a stage. */
#ifndef MXG_RENDER_OCCLUSION_H
#define MXG_RENDER_OCCLUSION_H

#include "render/site.h"

/*
 * Traces how open each point of the meshes is, by `num_rays` rays, and writes an `over` layer to
 * sublayer on the stage. Instances of a mesh share its primvar, so it is their mean. What has no
 * points is told. false after reporting an error.
 */
bool occlusion_bake(struct site *site, size_t num_rays, const char *path);

#endif
