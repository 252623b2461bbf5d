// SPDX-License-Identifier: Apache-2.0
/*
 * geompropvalue, geompropvalueuniform and UsdPrimvarReader: a property of the geometry, and what
 * stands in for it.
 */
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
static bool find_value(const mxg_build *build, const char *name, ir_ref arg, struct ir_value *out)
{
    if (build_evaluate(build->b, arg, out))
        return out->type == build->type;
    if (ir_get(build->b->graph, arg)->op != IR_POISON)
        warn(build, name, "its default varies; 0 stands in where the geometry has none");
    return false;
}

/* The texture that is the default of the node; NULL: there is none. */
static const struct shader_variable *find_texture(const mxg_build *build, ir_ref arg)
{
    const struct ir_node *node = ir_get(build->b->graph, arg);
    return node->op == IR_TEXTURE ? &build->b->shader->interface.variables.items[node->attr] : NULL;
}

/*
 * Reads the property of a name. Booleans cannot be interpolated, and strings cannot be streams:
 * hosts set them per object (as in MaterialX 1.39).
 */
static bool read_property(mxg_build *build, const char *name, str_id fallback, mxg_ref *results)
{
    struct builder *b = build->b;
    bool is_string = build->type == IR_TYPE_STRING;
    ir_ref arg = dynamic_arg(build, fallback);
    if (*name && is_string)
        warn(build, name, "a shader has no strings of geometry; its default stands in");
    if (!*name || is_string) { /* the node names no property */
        results[0] = code_issue(build, arg);
        return true;
    }
    struct ir_value value;
    struct property property = {.name = str_intern_z(b->shader->strings, name),
                                .type = build->type};
    if (build->type == IR_TYPE_SAMPLER)
        property.texture = find_texture(build, arg);
    else if (find_value(build, name, arg, &value))
        property.value = &value;
    results[0] = code_issue(build, build_property(b, &property));
    return true;
}

/*
 * The <geompropdef> of a name that has a node, such as "Pworld"; NULL: the name is the geometry's.
 */
static const struct geomprop *find_computed(const mxg_build *build, const char *name)
{
    const struct library *lib = build->b->lib;
    str_id id = str_find(&lib->strings, name, strlen(name));
    const struct geomprop *prop = id ? library_geomprop(lib, id) : NULL;
    if (!prop || prop->nodedef == LIBRARY_NONE)
        return NULL;
    if (prop->type == build->ports[build->def->num_inputs].type)
        return prop;
    warn(build, name,
         "its definition has another type; data of the geometry with this name are read");
    return NULL;
}

bool dynamic_geomprop(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_value name = MXG_INIT(mxg_value);
    (void)user_data;
    if (!mxg_build_require_constant(build, "geomprop", &name))
        return false;
    const struct geomprop *computed = find_computed(build, name.text);
    if (!computed)
        return read_property(build, name.text, STR_default, results);
    results[0] = code_issue(build, build_geomprop(build->b, computed));
    return true;
}

bool dynamic_primvar(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_value name = MXG_INIT(mxg_value);
    (void)user_data;
    return mxg_build_require_constant(build, "varname", &name)
           && read_property(build, name.text, STR_fallback, results);
}
