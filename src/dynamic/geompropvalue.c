// SPDX-License-Identifier: Apache-2.0
/* geompropvalue and geompropvalueuniform: a property of the geometry, and what stands in for it. */
#include "dynamic/dynamic.h"

static void warn(const mxg_build *build, const char *name, const char *why)
{
    struct builder *b = build->b;
    diag_add(b->diags, DIAG_ID_geomprop_default,
             doc_place(&b->lib->doc, build->frame->node.element), name, why);
}

/*
 * The value where the geometry has no property; false: it has no number. A uniform has its initial
 * value, perhaps in another colour space or unit.
 */
static bool find_value(const mxg_build *build, const char *name, struct ir_value *out)
{
    ir_ref arg = dynamic_arg(build, STR_default);
    if (build_evaluate(build->b, arg, out))
        return out->type == build->type;
    if (ir_get(build->b->graph, arg)->op != IR_POISON)
        warn(build, name, "its default varies; 0 stands in where the geometry has none");
    return false;
}

/* The texture that is the default of the node; NULL: there is none. */
static const struct shader_variable *find_texture(const mxg_build *build)
{
    const struct ir_node *node = ir_get(build->b->graph, dynamic_arg(build, STR_default));
    return node->op == IR_TEXTURE ? &build->b->shader->interface.variables.items[node->attr] : NULL;
}

/*
 * Booleans cannot be interpolated, and strings cannot be streams: hosts set them per object (as in
 * MaterialX 1.39).
 */
bool dynamic_geomprop(void *user_data, mxg_build *build, mxg_ref *results)
{
    struct builder *b = build->b;
    mxg_value name = MXG_INIT(mxg_value);
    (void)user_data;
    if (!mxg_build_require_constant(build, "geomprop", &name))
        return false;
    bool is_string = build->type == IR_TYPE_STRING;
    if (name.text[0] && is_string)
        warn(build, name.text, "a shader has no strings of geometry; its default stands in");
    if (!name.text[0] || is_string) { /* the node names no property */
        results[0] = mxg_build_input(build, "default");
        return true;
    }
    struct ir_value value;
    struct property property = {.name = str_intern_z(b->shader->strings, name.text),
                                .type = build->type};
    if (build->type == IR_TYPE_SAMPLER)
        property.texture = find_texture(build);
    else if (find_value(build, name.text, &value))
        property.value = &value;
    results[0] = code_issue(build, build_property(b, &property));
    return true;
}
