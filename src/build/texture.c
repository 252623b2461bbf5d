// SPDX-License-Identifier: Apache-2.0
/*
 * Textures: the variables that stand for files, and how nodes read them. Hosts make samplers and
 * choose files, so the reflection contains the sampling inputs of the nodes.
 *
 * An image of several tiles is a texture array with one array layer per tile (tiles.c). The whole
 * part of the texture coordinates chooses the array layer, the rest the position in it:
 *
 *     texture(file, uv) = inside the tiles
 *         ? textureGrad(file, vec3(fract(uv), layer), dFdx(uv), dFdy(uv)) : default
 */
#include "build/build_priv.h"

#include <stddef.h>

const char *build_file_of(const struct builder *b, elem_id element)
{
    const struct document *doc = build_doc(b);
    const char *file = element < doc->first_element ? NULL : doc_place(doc, element).file;
    return file ? file : "";
}

/* The file that an element stands in; 0: that of the document. */
static str_id origin_of(const struct builder *b, elem_id element)
{
    const struct document *doc = build_doc(b);
    const char *file = doc_place(doc, element).file, *own = doc_place(doc, doc->root).file;
    return file && own && strcmp(file, own) != 0
               ? str_intern(b->shader->strings, file, strlen(file))
               : 0;
}

const char *build_texture_fault(const struct builder *b, str_id file, elem_id element)
{
    if (!b->options->texture_fault || !file || element < build_doc(b)->first_element)
        return NULL;
    return b->options->texture_fault(b->options->texture_user_data, build_file_of(b, element),
                                     build_text(b, file));
}

ir_ref build_texture(struct builder *b, struct shader_variable variable, elem_id element)
{
    const char *fault = build_texture_fault(b, variable.file, element);
    if (fault)
        diag_add(b->diags, DIAG_ID_texture_refused,
                 doc_attr_place(build_doc(b), element, STR_value), build_text(b, variable.file),
                 fault);
    variable.block = BLOCK_TEXTURES;
    variable.origin = variable.file ? origin_of(b, element) : 0;
    variable.update = UPDATE_UNIFORM;
    if (build_find_tiles(b, element, &variable))
        variable.type = IR_TYPE_SAMPLER_ARRAY;
    return ir_build(b->graph, IR_TEXTURE, variable.type, shader_add_variable(b->shader, &variable),
                    NULL, 0);
}

/* ---- Sampling inputs of nodes ---- */

static const struct sampling_input {
    /* name of an input for one file, without the part of the file's name after "file" */
    const char *name;
    size_t at;
} sampling_inputs[] = {
    {"uaddressmode", offsetof(struct shader_sampling, uaddressmode)},
    {"vaddressmode", offsetof(struct shader_sampling, vaddressmode)},
    {"filtertype", offsetof(struct shader_sampling, filtertype)},
    {"layer", offsetof(struct shader_sampling, layer)},
    {"framerange", offsetof(struct shader_sampling, framerange)},
    {"frameendaction", offsetof(struct shader_sampling, frameendaction)},
};

/* True if an input belongs to a file: "layer" to "file", "layerx" to "filex". */
static bool belongs(const char *input, const char *name, const char *file)
{
    size_t len = strlen(name);
    const char *suffix = strncmp(file, "file", 4) == 0 ? file + 4 : "";
    return strncmp(input, name, len) == 0
           && (input[len] == '\0' || strcmp(input + len, suffix) == 0);
}

/*
 * The string value of an input; 0: none, or not constant. UsdUVTexture's "black" is "constant" with
 * the default.
 */
static str_id said(const struct builder *b, ir_ref arg)
{
    struct ir_value value;
    if (!arg || !ir_get_const(b->graph, arg, &value) || value.type != IR_TYPE_STRING)
        return 0;
    return strcmp(build_text(b, value.w[0].u), "black") == 0
               ? str_intern_z(b->shader->strings, "constant")
               : value.w[0].u;
}

/* True for what a texture can give in place of a missing image: a number or a colour. */
static bool is_texel(ir_type_id type)
{
    return ir_type_is_float(type) && !ir_type_is_matrix(type);
}

static void note_input(struct builder *b, const struct port *file, const struct port *port,
                       ir_ref arg, struct shader_variable *texture)
{
    const char *name = build_text(b, port->name);
    struct ir_value value;
    for (size_t i = 0; i < sizeof sampling_inputs / sizeof *sampling_inputs; i++)
        if (belongs(name, sampling_inputs[i].name, build_text(b, file->name)))
            *(str_id *)((char *)&texture->sampling + sampling_inputs[i].at) = said(b, arg);
    if (strcmp(name, "frameoffset") == 0 && arg && build_initial(b, arg, &value))
        texture->sampling.frameoffset = value.w[0].i;
    if (port->name != STR_default || !arg || !is_texel(ir_type_of(b->graph, arg)))
        return;
    texture->has_default = build_evaluate(b, arg, &texture->value);
    if (ir_get(b->graph, arg)->op == IR_UNIFORM) {
        texture->default_from = ir_get(b->graph, arg)->attr + 1;
        texture->fallback = b->options->caps & CAP_MISSING_COLORS ? texture->default_from : 0;
    }
}

/* The mode of a sampler whose border the shader makes: what it blends at the border is the image.
 */
static str_id without_border(const struct builder *b, str_id mode)
{
    bool is_border = mode && strcmp(build_text(b, mode), "constant") == 0;
    return is_border && b->options->texture_modes == TEXTURE_MODES_SHARED ? STR_clamp : mode;
}

/* Drops sampling values that have no effect. */
static void leave_out_defaults(const struct builder *b, struct shader_variable *texture)
{
    struct shader_sampling *s = &texture->sampling;
    s->uaddressmode = without_border(b, s->uaddressmode);
    s->vaddressmode = without_border(b, s->vaddressmode);
    if (texture->num_tiles) /* an array layer ends at its border */
        s->uaddressmode = s->vaddressmode = STR_clamp;
    if (!s->framerange)
        s->frameendaction = 0;
}

static bool reads_alike(const struct shader_variable *a, const struct shader_variable *b)
{
    bool has_literal = a->has_default && !a->default_from;
    return memcmp(&a->sampling, &b->sampling, sizeof a->sampling) == 0
           && a->has_default == b->has_default && a->default_from == b->default_from
           && (!has_literal || memcmp(&a->value, &b->value, sizeof a->value) == 0);
}

/*
 * The texture of another layer of the stack that reads this file in the same way, because targets
 * have few samplers; UINT32_MAX: there is none.
 */
static uint32_t shared_texture(const struct builder *b, const struct shader_variable *wanted)
{
    for (uint32_t i = 0; b->slot && wanted->file && i < b->shader->interface.variables.len; i++) {
        const struct shader_variable *v = &b->shader->interface.variables.items[i];
        if (v->block == BLOCK_TEXTURES && v->has_reader && v->file == wanted->file
            && v->type == wanted->type && reads_alike(v, wanted))
            return i;
    }
    return UINT32_MAX;
}

/* Two nodes that read one file in different ways have one variable each, with the same path. */
static uint32_t variable_for(struct builder *b, uint32_t index,
                             const struct shader_variable *wanted)
{
    assert(index < b->shader->interface.variables.len);
    uint32_t shared = shared_texture(b, wanted);
    if (shared != UINT32_MAX)
        return shared;
    struct shader_variable *first = &b->shader->interface.variables.items[index];
    if (!first->has_reader) {
        *first = *wanted;
        return index;
    }
    for (uint32_t i = index; i < b->shader->interface.variables.len; i++) {
        const struct shader_variable *v = &b->shader->interface.variables.items[i];
        if (v->block == BLOCK_TEXTURES && v->path == wanted->path && v->file == wanted->file
            && v->semantic == wanted->semantic && reads_alike(v, wanted))
            return i;
    }
    return shader_add_variable(b->shader, wanted);
}

static void note_reader(struct builder *b, const struct nodedef *def, const struct port *ports,
                        ir_ref *args, uint32_t file)
{
    assert(file < def->num_inputs && ir_get(b->graph, args[file])->op == IR_TEXTURE);
    uint32_t index = ir_get(b->graph, args[file])->attr;
    struct shader_variable wanted = b->shader->interface.variables.items[index];
    wanted.has_reader = true;
    wanted.has_default = false;
    wanted.fallback = wanted.default_from = 0;
    memset(&wanted.sampling, 0, sizeof wanted.sampling);
    memset(&wanted.value, 0, sizeof wanted.value);
    for (uint32_t i = 0; i < def->num_inputs; i++)
        note_input(b, &ports[file], &ports[i], args[i], &wanted);
    leave_out_defaults(b, &wanted);
    args[file] =
        ir_build(b->graph, IR_TEXTURE, wanted.type, variable_for(b, index, &wanted), NULL, 0);
}

/* ---- Reading ---- */

/* The node's default as a texel: 0 for missing channels, 1 for alpha. */
static ir_ref as_texel(struct builder *b, ir_ref value)
{
    ir_ref parts[4] = {value};
    ir_type_id type = value ? ir_type_of(b->graph, value) : IR_TYPE_VOID;
    unsigned have = is_texel(type) ? ir_type_info(type)->components : 0, n = have ? 1 : 0;
    if (have == 4)
        return value;
    for (unsigned i = have; i < 4; i++)
        parts[n++] = ir_const_float(b->graph, i == 3 ? 1.0f : 0.0f);
    return ir_construct(b->graph, IR_TYPE_VEC4, parts, n);
}

/* Address modes apply outside a single image; outside a tile lie other tiles. */
static void begin_tiles(struct builder *b, const struct nodedef *def, const struct port *ports,
                        ir_ref *args)
{
    b->missing_texel = 0;
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        const char *name = build_text(b, ports[i].name);
        if (strcmp(name, "uaddressmode") == 0 || strcmp(name, "vaddressmode") == 0)
            args[i] = ir_const_string(b->graph, STR_periodic);
        if (ports[i].name == STR_default)
            b->missing_texel = args[i];
    }
    b->missing_texel = as_texel(b, b->missing_texel);
}

bool build_note_textures(struct builder *b, const struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    ir_ref *args = frame->args;
    bool has_tiles = false;
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        if (ports[i].type != DOC_TYPE_filename || !args[i]
            || ir_get(b->graph, args[i])->op != IR_TEXTURE)
            continue;
        note_reader(b, def, ports, args, i);
        has_tiles |= ir_type_of(b->graph, args[i]) == IR_TYPE_SAMPLER_ARRAY;
    }
    if (has_tiles)
        begin_tiles(b, def, ports, args);
    return has_tiles;
}

static ir_ref gradient_at(struct builder *b, enum ir_op derivative, const ir_ref *args,
                          enum ir_op op, unsigned index)
{
    return op == IR_TEX ? ir_op1(b->graph, derivative, args[1]) : args[index];
}

/* With `texture-origin=top` coordinates come with v downwards, but tiles count upwards. */
static ir_ref upwards(struct builder *b, ir_ref uv)
{
    struct ir_graph *g = b->graph;
    if (!b->options->texture_origin)
        return uv;
    ir_ref parts[2] = {ir_component(g, uv, 0),
                       ir_op2(g, IR_SUB, ir_const_float(g, 1.0f), ir_component(g, uv, 1))};
    return ir_construct(g, IR_TYPE_VEC2, parts, 2);
}

ir_ref build_read_tiles(void *user_data, enum ir_op op, const ir_ref *args)
{
    struct builder *b = user_data;
    struct ir_graph *g = b->graph;
    assert(ir_type_of(g, args[0]) == IR_TYPE_SAMPLER_ARRAY);
    if (op == IR_TEX_SIZE)
        return 0; /* all array layers have one size */
    const struct shader_variable *texture =
        &b->shader->interface.variables.items[ir_get(g, args[0])->attr];
    if (op == IR_TEX_FETCH)
        return ir_poison(g, IR_TYPE_VEC4); /* build_check_tiles reports it */
    ir_ref inside, uv = upwards(b, args[1]), layer = build_tile_layer(b, texture, uv, &inside);
    ir_ref place = upwards(b, ir_op1(g, IR_FRACT, uv));
    ir_ref at = ir_construct(g, IR_TYPE_VEC3, (ir_ref[]){place, layer}, 2), texel;
    if (op == IR_TEX_LOD)
        texel = ir_build(g, IR_TEX_LOD, IR_TYPE_VEC4, 0, (ir_ref[]){args[0], at, args[2]}, 3);
    else
        texel = ir_build(g, IR_TEX_GRAD, IR_TYPE_VEC4, 0,
                         (ir_ref[]){args[0], at, gradient_at(b, IR_DFDX, args, op, 2),
                                    gradient_at(b, IR_DFDY, args, op, 3)},
                         4);
    return ir_build(g, IR_SELECT, IR_TYPE_VEC4, 0, (ir_ref[]){inside, texel, b->missing_texel}, 3);
}

/* Functions with loops, and verbatim functions, do not become nodes. */
void build_check_tiles(struct builder *b, const struct frame *frame, uint32_t first_node)
{
    assert(first_node <= b->graph->nodes.len);
    for (ir_ref ref = first_node; ref < b->graph->nodes.len; ref++) {
        const struct ir_node *node = ir_get(b->graph, ref);
        bool is_call = node->op == IR_CALL || node->op == IR_VERBATIM;
        for (unsigned i = 0; is_call && i < node->num_args; i++) {
            ir_ref arg = ir_arg(b->graph, ref, i);
            if (ir_type_of(b->graph, arg) != IR_TYPE_SAMPLER_ARRAY)
                continue;
            diag_add(
                b->diags, DIAG_ID_tiles_in_loop, doc_place(&b->lib->doc, frame->node.element),
                build_text(b, b->graph->callees.items[node->attr].name),
                build_text(b,
                           b->shader->interface.variables.items[ir_get(b->graph, arg)->attr].file));
            return;
        }
    }
}
