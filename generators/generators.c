// SPDX-License-Identifier: Apache-2.0
/* The list of targets. */
#include "generators/glsl/glsl.h"
#include "generators/hlsl/hlsl.h"
#include "generators/mdl/mdl.h"
#include "generators/msl/msl.h"
#include "generators/osl/osl.h"
#include "generators/slang/slang.h"
#include "generators/wgsl/wgsl.h"

const struct target *const targets[] = {&target_glsl, &target_vulkan, &target_essl, &target_essl310,
                                        &target_hlsl, &target_slang,  &target_msl,  &target_wgsl,
                                        &target_osl,  &target_mdl,    NULL};
