// SPDX-License-Identifier: Apache-2.0
/* Types of values in UsdShade networks, beside those of MaterialX. */
#ifndef MXG_BIND_SHADE_TYPE_H
#define MXG_BIND_SHADE_TYPE_H

#include "usda/usda.h"

/* The type of MaterialX for a type of USD; NULL: it has none. */
const char *shade_type(struct text_word type);

/*
 * True if a value of a type of USD may stand for one of a type of MaterialX: USD's roles (float3,
 * color3f, normal3f) are one type, and a token is what USD writes for shaders and closures.
 */
bool shade_type_agrees(struct text_word type, const char *wanted);

/* True if the value of a property is one of its declared type, or there is no value. */
bool shade_value_fits(const struct usda_property *property);

#endif
